#include "run/checkpoint.h"

#include <algorithm>

#include "base/fingerprint.h"
#include "base/number.h"

namespace pelage {

namespace {

/// Begins values that stand for others.
constexpr char hash_mark = '#';

/// Of eight bytes at a time, little-endian on every machine.
std::uint64_t checksum(std::string_view bytes) {
  Fingerprint f;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(8, bytes.size() - at); ++k)
      word |= std::uint64_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    f.add(word);
  }
  return f.add(std::uint64_t{bytes.size()}).value();
}

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

void add_fairing(Fingerprint& f, const FairOptions& o) {
  f.add(o.method).add(o.motion).add(o.mu).add(std::uint64_t{o.slide});
  for (const auto& value : {o.noise, o.tau, o.sigma, o.angle}) add_optional(f, value);
  add_optional(f, o.steps);
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

/// Of what cannot be told in a word.
template <class Add>
std::string hashed(Add&& add) {
  Fingerprint f;
  add(f);
  return hash_mark + std::to_string(f.value());
}

std::string yes_or_no(bool yes) { return yes ? "yes" : "no"; }

std::string number_or_none(const std::optional<double>& value) { return value ? exact_number(*value) : "none"; }

void add_shape_traits(Traits& t, const Program& program) {
  t.push_back({"shape", hashed([&](Fingerprint& f) {
                 if (const Grid* grid = as<Grid>(program.nodes)) add_grid(f, *grid);
                 if (const TetMesh* volume = as<TetMesh>(program.nodes)) add_tets(f, *volume);
                 if (program.shape) add_shape(f, *program.shape);
               })});
  t.push_back({"images", hashed([&](Fingerprint& f) {
                 for (const Texture& texture : program.textures) add_texture(f, texture);
               })});
  if (program.creases.any())
    t.push_back({"creases", hashed([&](Fingerprint& f) {
                   for (const char sharp : program.creases.edge) f.add(std::uint64_t{sharp != 0});
                 })});
}

void add_stage_traits(Traits& t, const StageProgram& s, const std::string& of) {
  t.push_back({"model" + of, s.model_name});
  for (const ParameterSource& p : s.model.parameters()) t.push_back({p.name + of, exact_number(p.value)});
  t.push_back({"size" + of, exact_number(s.size)});
  t.push_back({"length unit" + of, exact_number(s.length_unit)});
  t.push_back({"seed" + of, std::to_string(s.seed)});
  t.push_back({"stepper" + of, std::string(s.stepper->name)});
  t.push_back({"solver" + of, std::string(s.solver->name)});
  t.push_back({"refresh" + of, std::to_string(s.refresh)});
  t.push_back({"step" + of, number_or_none(s.step)});
  t.push_back({"equations" + of, hashed([&](Fingerprint& f) {
                 f.add(s.name).add(s.model.fingerprint()).add(s.suggested_step).add(std::uint64_t{s.excluded});
               })});
  t.push_back({"random points" + of, number_or_none(s.points) + " " + number_or_none(s.jitter)});
  t.push_back({"borders" + of, hashed([&](Fingerprint& f) {
                 for (const BorderCondition& c : s.borders) add_border(f, c);
               })});
  t.push_back({"directions" + of, hashed([&](Fingerprint& f) {
                 if (s.directions) add_directions(f, *s.directions);
               })});
}

void add_motion_traits(Traits& t, const SurfaceMotion& m) {
  t.push_back({"fairing", hashed([&](Fingerprint& f) {
                 if (m.fair) add_fairing(f, *m.fair);
               })});
  t.push_back({"growth", exact_number(m.growth)});
  t.push_back({"motion of amounts", yes_or_no(m.physical)});
  t.push_back({"steps between moves", std::to_string(m.every)});
}

bool is_hash(const std::string& value) { return value.starts_with(hash_mark); }

}  // namespace

Traits traits_of(const Program& program) {
  Traits t;
  add_shape_traits(t, program);
  t.push_back({"method", std::string(program.method->name)});
  t.push_back({"interpolation", yes_or_no(program.interpolate)});
  for (const StageProgram& s : program.stages)
    add_stage_traits(t, s, program.stages.size() > 1 ? " of stage " + s.name : "");
  t.push_back({"length of edges", exact_number(program.edge)});
  t.push_back({"accuracy of steps", exact_number(program.step_error)});
  add_motion_traits(t, program.motion);
  return t;
}

Traits told(Traits traits) {
  std::erase_if(traits, [](const Trait& t) { return is_hash(t.value) || t.value.find("none") != std::string::npos; });
  return traits;
}

std::string difference(const Traits& checkpoint, const Traits& run) {
  for (std::size_t k = 0; k < std::min(checkpoint.size(), run.size()); ++k) {
    const Trait &there = checkpoint[k], &here = run[k];
    if (there.name != here.name) return there.name + " instead of " + here.name;
    if (there.value == here.value) continue;
    if (is_hash(there.value)) return "another " + there.name;
    return there.name + " " + there.value + " instead of " + here.value;
  }
  return checkpoint.size() == run.size() ? "" : "other stages";
}

std::string seal(std::string bytes) {
  CheckpointWriter(bytes).number(checksum(bytes));
  return bytes;
}

bool is_sealed(std::string_view bytes) {
  if (bytes.size() < seal_length) return false;
  std::string sum;
  CheckpointWriter(sum).number(checksum(bytes.substr(0, bytes.size() - seal_length)));
  return bytes.ends_with(sum);
}

}  // namespace pelage
