// pelage measure: what the pattern of a finished coat is like.

#include <cstdio>
#include <memory>

#include "base/suggest.h"
#include "command.h"
#include "input_unit.h"
#include "measure/pattern.h"
#include "text.h"

namespace pelage {

namespace {

struct MeasureOptions {
  std::string shape, field;
  std::optional<double> level;
  bool json = false;
};

/// What can be measured: a number at every vertex.
std::vector<const Attribute*> fields_of(const TriangleMesh& mesh) {
  std::vector<const Attribute*> fields;
  for (const Attribute& a : mesh.attributes)
    if (a.domain == Domain::vertex && a.components == 1) fields.push_back(&a);
  return fields;
}

const Attribute& chosen_field(const TriangleMesh& mesh, const MeasureOptions& options) {
  const std::vector<const Attribute*> fields = fields_of(mesh);
  if (fields.empty())
    throw Error(Fault::input, "there is no number at the vertices to measure; a coat in .vtp or .ply has its species",
                {options.shape});
  if (options.field.empty()) return *fields.front();
  std::vector<std::string> names;
  for (const Attribute* field : fields) {
    if (field->name == options.field) return *field;
    names.push_back(field->name);
  }
  throw Error(Fault::usage, "--field: " + unknown_name("field", options.field, names));
}

Json to_json(const PatternPhase& phase) {
  return {{"parts", phase.parts}, {"share", json_number(phase.share)}, {"width", json_number(phase.width)}};
}

Json to_json(const PatternMeasures& m, const std::string& shape, const std::string& field) {
  return {{"shape", shape},
          {"field", field},
          {"area", json_number(m.area)},
          {"minimum", json_number(m.minimum)},
          {"maximum", json_number(m.maximum)},
          {"mean", json_number(m.mean)},
          {"deviation", json_number(m.deviation)},
          {"level", json_number(m.level)},
          {"above", to_json(m.above)},
          {"below", to_json(m.below)},
          {"border", json_number(m.border)},
          {"wavelength", json_number(m.wavelength)},
          {"spacing", json_number(m.spacing)},
          {"coherence", json_number(m.coherence)},
          {"along", m.along}};
}

void print(const char* name, const PatternPhase& phase) {
  std::printf("%s%s of the area in %s, %s wide\n", name, (brief(100 * phase.share) + " %").c_str(),
              counted(phase.parts, "part").c_str(), brief(phase.width).c_str());
}

void print(const PatternMeasures& m, const std::string& field, std::size_t others) {
  const std::string more =
      others > 0 ? ", the first of " + counted(others + 1, "field") + "; --field names another" : "";
  std::printf("field     %s%s\n", field.c_str(), more.c_str());
  std::printf("values    %s to %s, mean %s, standard deviation %s\n", brief(m.minimum).c_str(),
              brief(m.maximum).c_str(), brief(m.mean).c_str(), brief(m.deviation).c_str());
  std::printf("level     %s; the lines there are %s long\n", brief(m.level).c_str(), brief(m.border).c_str());
  print("above     ", m.above);
  print("below     ", m.below);
  if (!(m.wavelength > 0)) {
    std::puts("pattern   none: the field is the same everywhere");
    return;
  }
  std::printf("pattern   wavelength %s, spacing of parts %s\n", brief(m.wavelength).c_str(), brief(m.spacing).c_str());
  std::printf("stripes   %s of 1 (0: spots), along x %s, y %s, z %s\n", brief(m.coherence).c_str(),
              brief(m.along[0]).c_str(), brief(m.along[1]).c_str(), brief(m.along[2]).c_str());
}

void run_measure(const MeasureOptions& options) {
  const ShapeFile file = read_surface(options.shape);
  if (as<TetMesh>(file.nodes))
    throw Error(Fault::usage, "patterns are measured on surfaces, and the shape is a volume", {options.shape});
  const Attribute& field = chosen_field(file.mesh, options);
  const PatternMeasures measures = measure_pattern(file.mesh, field.values, options.level);
  if (options.json) return print_json(to_json(measures, options.shape, field.name));
  print(measures, field.name, fields_of(file.mesh).size() - 1);
}

}  // namespace

Command add_measure(CLI::App& parent) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* app = parent.add_subcommand(
      "measure",
      "Say in numbers what the pattern of a coat is like\n"
      "How many parts lie above and below a level, how much of the area they cover and how wide they are, the "
      "wavelength, and whether they are spots or stripes. Lengths are in units of the file.");
  app->add_option("SHAPE", options->shape, "A coat with its species, as .vtp and .ply have them")
      ->required()
      ->type_name("");
  app->add_option("--field", options->field, "What to measure: a number at each vertex (default: the first)")
      ->type_name("NAME");
  app->add_option("--level", options->level,
                  "Where parts end (default: halfway between the lowest and the highest half percent of the values)")
      ->type_name("X");
  app->add_flag("--json", options->json, "Print the result as JSON");
  app->footer("Example:\n  pelage grow builtin:animal --model turing -o coat.vtp\n  pelage measure coat.vtp --field b");
  return {app, [options] { run_measure(*options); }};
}

}  // namespace pelage
