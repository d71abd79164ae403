#include "grow_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "base/box.h"
#include "base/length_unit.h"
#include "base/memory.h"
#include "io/output_set.h"
#include "shape/builtin_grids.h"
#include "shape/generators.h"
#include "shape/grid.h"
#include "shape/refine.h"
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

std::string meshing(const Method& method, int levels) {
  if (method.own_mesh) return "even triangles on the surface";
  const bool smooth = method.smooth;
  if (levels == 0) return "as it is";
  return "every triangle split into " + std::to_string(1L << (2 * levels)) +
         (smooth ? " by Loop's rules" : " at midpoints");
}

/// "512 x 512 grid, periodic along x and y".
std::string grid_in_words(const Grid& grid) {
  std::string counts, periodic;
  for (std::size_t d = 0; d < static_cast<std::size_t>(grid.dimension()); ++d) {
    counts += (d ? " x " : "") + std::to_string(grid.count[d]);
    if (grid.periodic[d]) periodic += (periodic.empty() ? "" : " and ") + std::string(1, "xyz"[d]);
  }
  return counts + " grid" + (periodic.empty() ? "" : ", periodic along " + periodic);
}

/// "6 patches".
std::string nodes_in_words(const NodeShape& nodes) {
  struct Words {
    std::string operator()(const Grid& grid) const { return grid_in_words(grid); }
    std::string operator()(const Atlas& atlas) const { return counted(atlas.patches.size(), "patch"); }
    std::string operator()(const Cells& cells) const { return counted(cells.nodes(), "cell"); }
    std::string operator()(const TetMesh& volume) const { return std::to_string(volume.tets.size()) + " tetrahedra"; }
  };
  return std::visit(Words{}, nodes);
}

/// "60 x 40 x 10 mm".
std::string extents(const TriangleMesh& mesh) {
  const Box box = box_of(mesh.points);
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) text += (k ? " x " : "") + number(box.high[k] - box.low[k]);
  return text + " " + unit_name(*mesh.metres_per_unit);
}

/// "4 world units", with what they are where that is known.
std::string world_length_in_words(double length, const TriangleMesh& shape) {
  const std::optional<double>& unit = shape.metres_per_unit;
  return number(length) + " world units" + (unit ? " = " + length_in_words(length * *unit) : "");
}

/// A model whose wavelength nobody knows is sized by its unit.
std::string size_in_words(const StageProgram& p, const TriangleMesh& shape) {
  return p.size_known ? " at a wavelength of " + world_length_in_words(p.size, shape)
                      : " of unknown wavelength, its unit " + world_length_in_words(p.length_unit, shape);
}

}  // namespace

std::shared_ptr<const TriangleMesh> shape_of(const Program& program) {
  if (const Cells* cells = as<Cells>(program.nodes)) return cells->on;
  const TetMesh* volume = as<TetMesh>(program.nodes);
  return volume && volume->surface ? volume->surface : program.shape;
}

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

void GrowReport::warnings(const Run& run) {
  while (warnings_of_run_ < run.warnings().size()) warning(run.warnings()[warnings_of_run_++]);
}

void GrowReport::shape(const std::string& name, const ShapeFile& file) {
  line("shape", name + ": " + counted(file.mesh.points.size(), "vertex") + ", " +
                    counted(file.mesh.triangles.size(), "triangle"));
  const std::optional<double>& unit = file.mesh.metres_per_unit;
  if (unit && !is_builtin_shape(name)) line("unit", unit_name(*unit) + ": the shape is " + extents(file.mesh));
  for (const Finding& f : file.findings) line(f.repaired ? "repaired" : "noted", f.text);
  json_["shape"] = {{"name", name},
                    {"vertices", file.mesh.points.size()},
                    {"triangles", file.mesh.triangles.size()},
                    {"metres_per_unit", unit ? json_number(*unit) : Json(nullptr)},
                    {"findings", json_findings(file.findings)}};
}

void GrowReport::onto(const std::string& name, const ShapeFile& file) {
  line("onto", name + ": " + counted(file.mesh.points.size(), "vertex") + ", " +
                   counted(file.mesh.triangles.size(), "triangle"));
  for (const Finding& f : file.findings) line(f.repaired ? "repaired" : "noted", f.text);
  json_["onto"] = {{"name", name},
                   {"vertices", file.mesh.points.size()},
                   {"triangles", file.mesh.triangles.size()},
                   {"findings", json_findings(file.findings)}};
}

void GrowReport::pattern(const Run& run) {
  const double diagonal = box_of(run.world().points()).diagonal();
  double finest = std::numeric_limits<double>::infinity();
  bool finest_known = true;
  json_["stages"] = Json::array();
  for (const StageProgram& p : run.program().stages) {
    if (p.size < finest) finest_known = p.size_known;
    finest = std::min(finest, p.size);
    const std::string name = run.program().stages.size() > 1 ? p.name + ": " : "";
    line("pattern", name + p.model_name + size_in_words(p, *run.program().shape) + " (" +
                        brief((p.size_known ? p.size : p.length_unit) / diagonal) + " of the diagonal)");
    if (!p.follows.empty()) line("following", name + p.follows);
    Json parameters = Json::object();
    for (const ParameterSource& parameter : p.model.parameters()) parameters[parameter.name] = parameter.value;
    json_["stages"].push_back({{"name", p.name},
                               {"model", p.model_name},
                               {"parameters", parameters},
                               {"size", p.size},
                               {"size_of_diagonal", p.size / diagonal},
                               {"size_known", p.size_known},
                               {"length_unit", p.length_unit},
                               {"stepper", p.stepper->name},
                               {"seed", p.seed}});
    if (!p.follows.empty()) json_["stages"].back()["follows"] = p.follows;
  }
  nodes(run, finest, finest_known ? "wavelength" : brief(finest) + " world units");
}

void GrowReport::nodes(const Run& run, double finest, const std::string& per) {
  const World& world = run.world();
  const Method& method = *run.program().method;
  const Program& program = run.program();
  const auto count = static_cast<std::size_t>(world.space().unknowns());
  const bool split = world.hierarchy() != nullptr;
  const double edge = split ? prevailing_edge(world.topology().triangles, world.space().control()) : program.edge;
  const double density = finest / edge;
  line("mesh", (split ? meshing(method, world.levels()) : nodes_in_words(*program.nodes)) + ": " +
                   counted(count, split ? "vertex" : "node") + ", " + brief(density) + " per " + per);
  json_["method"] = method.name;
  json_["refinements"] = world.levels();
  json_["control_vertices"] = count;
  json_["vertices_per_wavelength"] = density;
}

void GrowReport::coarseness(const Run& run) {
  constexpr double fewest = 4;  // edges per wavelength below which spots lose their form
  const TriangleMesh& shape = *shape_of(run.program());
  if (shape.triangles.empty()) return;
  const double edge = prevailing_edge(shape.triangles, shape.points);
  for (const StageProgram& p : run.program().stages) {
    if (p.size >= fewest * edge) continue;
    return warning("the shape's edges of " + brief(edge) + " are too long to show a pattern of " + brief(p.size) +
                   " at its vertices; --flat instead of --keep-shape splits its triangles");
  }
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

void GrowReport::need(const Forecast& forecast, double bytes) {
  constexpr double much = 1e9;
  json_["estimated_nodes"] = std::round(forecast.nodes);
  json_["estimated_bytes"] = std::round(bytes);
  if (bytes < much) return;
  line("needs", "about " + bytes_in_words(bytes) + " of memory for " + brief(forecast.nodes) + " nodes");
}

void GrowReport::estimate(const Run& run, double seconds) {
  line("growing", "takes about " + duration(seconds) + " for " +
                      counted(static_cast<std::size_t>(run.world().space().unknowns()), "vertex"));
  json_["estimated_growth_seconds"] = seconds;
}

void GrowReport::saving(const std::string& path, double minutes) {
  line("saving", "the state every " + number(minutes) + " minutes; should the run be cut off: pelage resume " + path);
  json_["checkpoint"] = path;
}

void GrowReport::growth(const Run& run, double seconds) {
  for (std::size_t k = 0; k < run.finished().size(); ++k) grown(run, k, run.finished()[k].summary);
  grown(run, run.stage(), run.summary());
  line("growth", "in " + duration(seconds));
  json_["uniform"] = run.uniform();
  if (run.uniform()) warning("the result is uniform, there is no pattern: " + run.why_uniform());
  json_["growth_seconds"] = seconds;
}

void GrowReport::grown(const Run& run, std::size_t stage, const RunSummary& s) {
  bytes_ += s.bytes;
  const StageProgram& p = run.program().stages[stage];
  if (s.solves > 0)
    solved_.push_back(std::string(p.stepper->name) + " solved " +
                      counted(static_cast<std::size_t>(s.solves), "system") + " by " + std::string(p.solver->name) +
                      " in " + counted(static_cast<std::size_t>(s.iterations), "iteration") + ", " +
                      duration(s.solve_seconds));
  if (s.indefinite > 0)
    warning(
        counted(static_cast<std::size_t>(s.indefinite), "system") + " of " +
        counted(static_cast<std::size_t>(s.solves), "system") +
        " had a matrix that is not positive definite: such steps are too large to follow the equations; lower --step");
  line("grown", (run.program().stages.size() > 1 ? p.name + ": " : "") +
                    counted(static_cast<std::size_t>(s.steps), "step") + " of " + std::string(p.stepper->name) +
                    " to time " + number(s.time) + "; " + stop_reason(s.status));
  json_["stages"][stage]["growth"] = {{"status", name_of(s.status)},
                                      {"steps", s.steps},
                                      {"time", s.time},
                                      {"last_step", s.step},
                                      {"change", s.change},
                                      {"solver_iterations", s.iterations},
                                      {"solves", s.solves},
                                      {"indefinite", s.indefinite},
                                      {"solve_seconds", s.solve_seconds},
                                      {"rejected_steps", s.rejected},
                                      {"minimum", json_number(s.minimum)},
                                      {"maximum", json_number(s.maximum)}};
}

void GrowReport::solid(const std::string& about) {
  line("solid", about);
  json_["solid"] = about;
}

void GrowReport::file(const std::string& path, const std::string& about) { files_.emplace_back(path, about); }

void GrowReport::tell(const std::string& path, const std::string& about) {
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(path, ignored);
  line("wrote", path + " (" + file_size(bytes) + ")" + (about.empty() ? "" : ": " + about));
  json_["files"].push_back({{"path", path}, {"bytes", bytes}});
  if (!about.empty()) json_["files"].back()["form"] = about;
}

void GrowReport::profile(Profile& profile) {
  double total = 0, growing = 0;
  for (const Profile::Phase& p : profile.phases()) {
    total += p.seconds;
    if (p.name == "growing") growing = p.seconds;
  }
  for (const Profile::Phase& p : profile.phases()) {
    line("profile", p.name + ": " + duration(p.seconds) + ", " + brief(100 * p.seconds / total) + " %");
    json_["profile"]["seconds"][p.name] = p.seconds;
  }
  for (const std::string& text : solved_) line("profile", text);
  if (!(bytes_ > 0) || !(growing > 0)) return;
  const double speed = bytes_ / growing, triad = triad_speed();
  line("profile", "growing moved " + brief(bytes_ / 1e9) + " GB, " + brief(speed / 1e9) +
                      " GB/s; a stream of floats goes at " + brief(triad / 1e9) + " GB/s");
  json_["profile"]["kernel_bytes_per_second"] = speed;
  json_["profile"]["triad_bytes_per_second"] = triad;
}

void GrowReport::end(double seconds) {
  publish_outputs();
  for (const auto& [path, about] : files_) tell(path, about);
  line("done", "in " + duration(seconds));
  json_["seconds"] = seconds;
  bar_.clear();
  if (form_ == Form::json) print_json(json_);
}

}  // namespace pelage
