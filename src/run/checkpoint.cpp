#include "run/checkpoint.h"

#include "base/fingerprint.h"

namespace pelage {

namespace {

template <class T>
void add_optional(Fingerprint& f, const std::optional<T>& value) {
  f.add(std::uint64_t{value.has_value()});
  if (value) f.add(static_cast<double>(*value));
}

void add_points(Fingerprint& f, const std::vector<Point>& points) {
  for (const Point& p : points) f.add_all(p);
  f.add(std::uint64_t{points.size()});
}

void add_shape(Fingerprint& f, const TriangleMesh& shape) {
  add_points(f, shape.points);
  for (const Triangle& t : shape.triangles)
    for (const std::int32_t v : t) f.add(static_cast<std::uint64_t>(v));
  for (const Attribute& a : shape.attributes)
    f.add(a.name)
        .add(static_cast<std::uint64_t>(a.components))
        .add(static_cast<std::uint64_t>(a.domain))
        .add_all(a.values);
}

/// What its mesh does not show.
void add_tets(Fingerprint& f, const TetMesh& volume) {
  f.add(static_cast<std::uint64_t>(volume.tets.size()));
  for (const Tetrahedron& t : volume.tets)
    for (const std::int32_t node : t) f.add(static_cast<std::uint64_t>(node));
  if (volume.surface) add_shape(f, *volume.surface);
}

void add_grid(Fingerprint& f, const Grid& grid) {
  for (std::size_t d = 0; d < 3; ++d)
    f.add(static_cast<std::uint64_t>(grid.count[d])).add(std::uint64_t{grid.periodic[d]}).add_all(grid.period[d]);
}

void add_texture(Fingerprint& f, const Texture& t) {
  f.add(t.name).add(static_cast<std::uint64_t>(t.width)).add(static_cast<std::uint64_t>(t.height));
  for (const std::uint16_t value : *t.rgb) f.add(std::uint64_t{value});
}

void add_motion(Fingerprint& f, const SurfaceMotion& m) {
  f.add(m.fair ? m.fair->method : "")
      .add(m.growth)
      .add(std::uint64_t{m.physical})
      .add(static_cast<std::uint64_t>(m.every));
}

void add_directions(Fingerprint& f, const FieldWish& wish) {
  if (wish.axis) f.add_all(*wish.axis);
  if (wish.centre) f.add_all(*wish.centre);
  f.add(std::uint64_t{wish.curvature}).add(std::uint64_t{wish.across}).add(wish.smooth);
  for (const auto* marks : {&wish.from, &wish.to})
    for (const Index v : *marks) f.add(static_cast<std::uint64_t>(v));
  for (const auto& stroke : wish.strokes) add_points(f, stroke);
}

void add_border(Fingerprint& f, const BorderCondition& c) {
  f.add(c.side).add(std::uint64_t{c.species});
  for (const auto* formula : {&c.value, &c.flux, &c.loss}) f.add(*formula ? (*formula)->text : "");
}

void add_stage(Fingerprint& f, const StageProgram& s) {
  f.add(s.name).add(s.model.fingerprint()).add(s.stepper->name).add(s.solver->name).add(s.size).add(s.length_unit);
  add_optional(f, s.step);
  f.add(s.suggested_step).add(std::uint64_t{s.excluded}).add(s.seed);
  add_optional(f, s.points);
  if (s.jitter) f.add(*s.jitter);
  for (const BorderCondition& c : s.borders) add_border(f, c);
  if (s.directions) add_directions(f, *s.directions);
}

}  // namespace

std::uint64_t fingerprint(const Program& program) {
  Fingerprint f;
  if (const Grid* grid = as<Grid>(program.nodes)) add_grid(f, *grid);
  if (const TetMesh* volume = as<TetMesh>(program.nodes)) add_tets(f, *volume);
  if (program.shape) add_shape(f, *program.shape);
  for (const Texture& t : program.textures) add_texture(f, t);
  f.add(program.method->name).add(std::uint64_t{program.interpolate}).add(program.edge);
  add_motion(f, program.motion);
  for (const StageProgram& s : program.stages) add_stage(f, s);
  return f.value();
}

}  // namespace pelage
