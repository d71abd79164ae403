#include "run/world.h"

#include "base/report.h"
#include "pelage/error.h"
#include "run/forecast.h"
#include "shape/tet_mesh.h"

namespace pelage {

namespace {

/// Where memory is no limit: what isotropic_mesh makes at most.
constexpr std::size_t max_triangles = 100'000'000;

std::shared_ptr<const TetMesh> volume_of(const Program& program) {
  const auto* volume = as<TetMesh>(program.nodes);
  return volume ? std::shared_ptr<const TetMesh>(program.nodes, volume) : nullptr;
}

/// What is faired.
std::shared_ptr<const TriangleMesh> surface_of(const Program& program) {
  const auto volume = volume_of(program);
  if (!volume) return program.shape;
  return volume->surface ? volume->surface : std::make_shared<const TriangleMesh>(skin_mesh(*volume));
}

}  // namespace

World::World(std::shared_ptr<const Program> program, const Progress& progress) : program_(std::move(program)) {
  require_memory(*program_);
  const TriangleMesh& shape = *program_->shape;
  surface_ = unmoved_surface();
  report(progress, "refining", 0);
  if (program_->nodes) {
    space_ = program_->method->make_node_space(*program_->nodes);
    if (program_->motion.fair)
      inside_ =
          std::make_shared<const HarmonicVolume>(volume_of(*program_), surface_of(*program_), space_->stiffness());
    return;
  }
  Topology base = make_topology(shape.points.size(), shape.triangles);
  base.creases = program_->creases;
  auto hierarchy = std::make_shared<Hierarchy>(std::move(base), program_->method->refine);
  hierarchy_ = hierarchy;
  std::vector<Point> control = coarse_control(shape.points);
  const Method& method = *program_->method;
  if (method.own_mesh) {
    const auto meshing = [&](std::string_view what, double fraction) {
      return !progress || progress(what, 0.1 + 0.2 * fraction);
    };
    mesh_ = std::make_shared<const SimulationMesh>(
        *hierarchy, control, SimulationMesh::Edge{program_->edge, program_->edges}, max_triangles, meshing);
    report(progress, "measuring", 0.3);
    space_ = method.make_space(mesh_->shared_topology(), mesh_->points(control));
    control_ = std::move(control);
    return;
  }
  refine_to_edge(*hierarchy, control, program_->edge, max_triangles);
  report(progress, "tabulating basis functions", 0.2);
  space_ = method.make_space(hierarchy_->shared_topology(levels()), std::move(control));
}

std::vector<double> World::at_nodes(std::vector<double> given, std::size_t components) const {
  if (!hierarchy_) return given;
  return mesh_ ? mesh_->values(given, components)
               : hierarchy_->interpolated(std::move(given), components, 0, hierarchy_->finest());
}

std::vector<Tensor> World::at_nodes(const std::vector<Tensor>& given) const {
  constexpr std::size_t components = 6;
  std::vector<double> values;
  for (const Tensor& t : given) values.insert(values.end(), t.begin(), t.end());
  values = at_nodes(std::move(values), components);
  std::vector<Tensor> result(values.size() / components);
  for (std::size_t v = 0; v < result.size(); ++v)
    for (std::size_t k = 0; k < components; ++k) result[v][k] = values[components * v + k];
  return result;
}

VertexAttributes World::at_nodes(const Texture& texture) const {
  const Attribute& given = *program_->shape->find("uv");
  Attribute uv = given;
  if (mesh_)
    uv = mesh_->values(given);
  else if (hierarchy_)
    hierarchy_->interpolate(uv, 0, levels());
  return texture_attributes(texture, hierarchy_ ? topology().triangles : program_->shape->triangles,
                            static_cast<std::size_t>(space_->unknowns()), uv);
}

std::vector<Point> World::coarse_control(std::vector<Point> points) const {
  if (!program_->interpolate || !program_->method->interpolate) return points;
  return program_->method->interpolate(hierarchy_->topology(0), points);
}

World World::unmoved() const {
  World copy(initial_control_.empty() ? space_ : space_->moved(space_control(initial_control_)));
  copy.program_ = program_;
  copy.hierarchy_ = hierarchy_;
  copy.mesh_ = mesh_;
  copy.control_ = initial_control_.empty() || !mesh_ ? control_ : initial_control_;
  copy.surface_ = copy.unmoved_surface();
  copy.inside_ = inside_;
  return copy;
}

std::unique_ptr<MovingSurface> World::unmoved_surface() const {
  if (!program_ || !program_->motion.any()) return nullptr;
  // Growth alone takes all vertices along.
  return std::make_unique<MovingSurface>(program_->motion.fair ? *surface_of(*program_) : *program_->shape,
                                         program_->motion);
}

std::vector<Point> World::moved_points() const {
  return inside_ ? surface_->grown(inside_->points(surface_->faired())) : surface_->points();
}

const std::vector<Point>& World::points() const {
  return points_.empty() && program_ ? program_->shape->points : points_;
}

std::vector<Point> World::filled_surface() const {
  const auto volume = program_ ? volume_of(*program_) : nullptr;
  if (!volume || !volume->surface || initial_control_.empty()) return {};
  return surface_->grown(inside_ ? surface_->faired() : volume->surface->points);
}

std::vector<Point> World::initial_positions(SampleRule rule) const {
  const auto space = initial_control_.empty() ? space_ : space_->moved(space_control(initial_control_));
  return space->geometry(rule, false).position;
}

bool World::follow(std::int64_t steps, double time) {
  if (!surface_ || !surface_->advance(steps, time)) return false;
  place(moved_points());
  return true;
}

void World::place(std::vector<Point> points) {
  if (initial_control_.empty()) initial_control_ = control();
  points_ = std::move(points);
  std::vector<Point> control = hierarchy_ ? hierarchy_->refined(coarse_control(points_), 0, levels()) : points_;
  space_ = space_->moved(space_control(control));
  if (mesh_) control_ = std::move(control);
}

void World::restore(MovingSurface::State state) {
  surface_->restore(std::move(state));
  place(moved_points());
}

}  // namespace pelage
