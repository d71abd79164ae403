#include "grow_report.h"

#include <cstdio>
#include <filesystem>

#include "text.h"

namespace pelage {

namespace {

std::string stop_reason(RunStatus status) {
  switch (status) {
    case RunStatus::time_reached:
      return "the end time is reached";
    case RunStatus::steps_reached:
      return "the number of steps is reached";
    case RunStatus::stationary:
      return "the pattern has come to rest";
    case RunStatus::failed:
      return "the computation failed";
    case RunStatus::running:
      break;
  }
  return "still running";
}

std::string status_name(RunStatus status) {
  switch (status) {
    case RunStatus::time_reached:
      return "time_reached";
    case RunStatus::steps_reached:
      return "steps_reached";
    case RunStatus::stationary:
      return "stationary";
    case RunStatus::failed:
      return "failed";
    case RunStatus::running:
      break;
  }
  return "running";
}

std::string refinement(int levels, bool loop) {
  if (levels == 0) return "as it is";
  return "every triangle split into " + std::to_string(1L << (2 * levels)) +
         (loop ? " by Loop's rules" : " at midpoints");
}

}  // namespace

void GrowReport::line(const std::string& label, const std::string& text) {
  if (form_ != Form::lines) return;
  bar_.clear();
  std::printf("%-9s %s\n", label.c_str(), text.c_str());
  std::fflush(stdout);
}

void GrowReport::warning(const std::string& text) {
  bar_.clear();
  std::fprintf(stderr, "pelage: warning: %s\n", one_line(text).c_str());
  json_["warnings"].push_back(text);
}

void GrowReport::shape(const std::string& name, const ShapeFile& file) {
  line("shape", name + ": " + counted(file.mesh.points.size(), "vertex") + ", " +
                    counted(file.mesh.triangles.size(), "triangle"));
  for (const Finding& f : file.findings) line(f.repaired ? "repaired" : "noted", f.text);
  json_["shape"] = {{"name", name},
                    {"vertices", file.mesh.points.size()},
                    {"triangles", file.mesh.triangles.size()},
                    {"findings", json_findings(file.findings)}};
}

void GrowReport::pattern(const std::string& model, const Run& run) {
  const Program& p = run.program();
  const Topology& topology = run.operators().discretisation().topology;
  const double density = p.size / prevailing_edge(topology.triangles, run.operators().control());
  const double relative = p.size / bounding_diagonal(p.shape);
  line("pattern",
       model + " at a wavelength of " + number(p.size) + " world units (" + brief(relative) + " of the diagonal)");
  line("mesh", refinement(run.operators().levels(), p.method == "loop") + ": " +
                   counted(topology.vertex_count, "vertex") + ", " + brief(density) + " per wavelength");
  json_["model"] = model;
  Json parameters = Json::object();
  for (const ParameterSource& parameter : p.model.parameters()) parameters[parameter.name] = parameter.value;
  json_["parameters"] = parameters;
  json_["size"] = p.size;
  json_["size_of_diagonal"] = relative;
  json_["length_unit"] = p.length_unit;
  json_["method"] = p.method;
  json_["stepper"] = p.stepper;
  json_["seed"] = p.seed;
  json_["refinements"] = run.operators().levels();
  json_["control_vertices"] = topology.vertex_count;
  json_["vertices_per_wavelength"] = density;
}

void GrowReport::surface(const MovingSurface& surface) {
  const Fairing* fairing = surface.fairing();
  if (!fairing) return;
  const FairReport& r = fairing->report();
  line("surface", counted(static_cast<std::size_t>(r.steps), "step") + " of fairing; noise " + brief(r.noise) +
                      " mean edges, moved " + brief(r.moved));
  if (!fairing->done()) warning("the growth ended before the noise was off the surface; lower --every or grow longer");
  json_["fairing"] = {
      {"noise_edges", r.noise}, {"steps", r.steps}, {"moved_edges", r.moved}, {"done", fairing->done()}};
}

void GrowReport::growth(const Run& run, double seconds) {
  const RunSummary& s = run.summary();
  line("growth", counted(static_cast<std::size_t>(s.steps), "step") + " of " + run.program().stepper + " to time " +
                     number(s.time) + " in " + duration(seconds) + "; " + stop_reason(s.status));
  json_["growth"] = {{"status", status_name(s.status)},
                     {"steps", s.steps},
                     {"time", s.time},
                     {"last_step", s.step},
                     {"change", s.change},
                     {"solver_iterations", s.iterations},
                     {"rejected_steps", s.rejected},
                     {"seconds", seconds},
                     {"minimum", json_number(s.minimum)},
                     {"maximum", json_number(s.maximum)}};
}

void GrowReport::file(const std::string& path) {
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(path, ignored);
  line("wrote", path + " (" + file_size(bytes) + ")");
  json_["files"].push_back({{"path", path}, {"bytes", bytes}});
}

void GrowReport::end(double seconds) {
  line("done", "in " + duration(seconds));
  json_["seconds"] = seconds;
  bar_.clear();
  if (form_ == Form::json) print_json(json_);
}

}  // namespace pelage
