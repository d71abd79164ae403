#include "line_outputs.h"

#include <algorithm>
#include <map>

#include "base/number.h"
#include "base/suggest.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/line_files.h"
#include "pelage/error.h"
#include "text.h"

namespace pelage {

namespace {

const std::map<std::string, LineView>& line_views() {
  static const std::map<std::string, LineView> all = {{"front", LineView::front}, {"back", LineView::back},
                                                      {"right", LineView::right}, {"left", LineView::left},
                                                      {"top", LineView::top},     {"bottom", LineView::bottom}};
  return all;
}

std::vector<std::string> view_names() {
  std::vector<std::string> names{"uv"};
  for (const auto& [name, view] : line_views()) names.push_back(name);
  return names;
}

std::vector<std::string> line_extensions() {
  std::vector<std::string> all = drawing_extensions();
  for (const std::string& more : space_line_extensions()) all.push_back(more);
  return all;
}

bool is_drawing(const std::string& path) { return std::ranges::count(drawing_extensions(), lower_extension(path)) > 0; }

std::vector<Isoline> isolines_of(const LineOptions& options, const std::vector<std::string>& species) {
  std::vector<Isoline> isolines;
  for (const std::string& text : options.isolines) isolines.push_back(parse_isoline(text, species));
  return isolines;
}

/// "14 closed lines and 2 open ones".
template <class Kinds>
std::string count_of(const Kinds& kinds) {
  std::size_t closed = 0, open = 0;
  for (const auto& kind : kinds)
    for (const auto& line : kind.lines) ++(line.closed ? closed : open);
  if (open == 0) return counted(closed, "closed line");
  return counted(closed, "closed line") + " and " + counted(open, "open one");
}

std::string count_of(LineDrawing drawing) {
  drawing.parts.erase(drawing.parts.begin());  // the outline
  return count_of(drawing.parts);
}

std::string about(const LineDrawing& d) {
  if (!d.millimetres) return count_of(d) + " on uv";
  return count_of(d) + ", " + brief(d.high[0] - d.low[0]) + " x " + brief(d.high[1] - d.low[1]) + " mm";
}

}  // namespace

void add_line_options(CLI::App& app, LineOptions& o, const std::string& group) {
  app.add_option("--lines", o.files,
                 "Files for isolines, to cut, engrave or stitch along: .svg and .dxf are drawings in millimetres, .obj "
                 "and .vtp lines on the surface in space")
      ->type_name("FILE[,FILE]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(group);
  app.add_option(
         "--isoline", o.isolines,
         "Which ones: \"b = 4\", \"b < 4\" or \"a > b\", with formulas as in layers of recipes; \"b\": halfway "
         "(default: the borders of the look's layers, or halfway between the shown colours). May be given several "
         "times")
      ->type_name("FORMULA[=LEVEL]")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--lines-view", o.view,
                 "From where drawings are seen, without what is hidden: front (default; +z, or -y where z points up), "
                 "back, right (+x), left, top or bottom; or uv, the shape's texture coordinates")
      ->type_name("NAME")
      ->group(group);
}

void check_lines(const LineOptions& options, const std::vector<std::string>& species) {
  if (options.files.empty() && !options.isolines.empty())
    throw Error(Fault::usage, "--isoline says what --lines writes; give that, too");
  if (options.view != "uv" && !line_views().contains(options.view))
    throw Error(Fault::usage, "--lines-view: " + unknown_name("view", options.view, view_names()));
  for (const std::string& path : options.files) {
    if (std::ranges::count(line_extensions(), lower_extension(path)) == 0)
      throw Error(Fault::usage, "--lines " + path + ": lines are written as " + join_names(line_extensions()));
    expect_output(path);
  }
  isolines_of(options, species);
}

LineFiles write_lines(const LineOptions& options, const CoatFields& fields, const Look& look, UpAxis up) {
  LineFiles files;
  const std::vector<Isoline> isolines = isolines_of(options, fields.species);
  const Paint paint = with_isolines(resolve_paint(look, fields.species), isolines);
  const Tessellation t = tessellate(fields, tessellation_request(look, paint));
  if (t.triangles.empty()) throw Error(Fault::usage, "--lines are those of surfaces, and the shape has no triangles");
  const std::vector<CoatLines> lines = coat_lines(isolines, paint, t, fields.uniform);
  for (const CoatLines& l : lines)
    if (!crosses(l)) files.warnings.push_back("there is no line \"" + l.name + "\" on the shape");
  const bool drawn = std::ranges::any_of(options.files, is_drawing);
  std::optional<LineDrawing> drawing;
  if (drawn && options.view == "uv") {
    drawing = lines_on_uv(t, lines);
  } else if (drawn) {
    if (!t.metres_per_unit)
      files.warnings.push_back(
          "the shape does not say its unit, which drawings take for 1 mm; give it with --input-unit");
    constexpr double millimetres = 1000;
    const double scale = t.metres_per_unit ? millimetres * *t.metres_per_unit : 1;
    drawing = lines_in_view(t, lines, line_views().at(options.view), up, scale);
  }
  for (const std::string& path : options.files) {
    if (is_drawing(path)) {
      write_lines(*drawing, path);
      files.about.push_back(about(*drawing));
    } else {
      const std::vector<SpaceLines> in_space = lines_in_space(t, lines);
      write_lines(in_space, path);
      files.about.push_back(count_of(in_space));
    }
  }
  return files;
}

}  // namespace pelage
