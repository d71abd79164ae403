#include "run/operators.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/random.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "react/place_values.h"
#include "run/anisotropy.h"
#include "run/random_points.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// A finer mesh would need more than the memory of common machines: about 2 kB per Loop vertex.
constexpr std::size_t max_triangles = 8'000'000;

/// Ratio of the rates along and across up to which waves across a field that is oblique to an even mesh decay, at
/// `vertices_per_wavelength`, no faster than they do without anisotropy but for a percent of their rate (Loop) or for a
/// few (linear, whose error is 17 % to begin with): tests/run/anisotropy_test.cpp measures it.
double safe_ratio(const std::string& method) { return method == "loop" ? 32 : 2; }

void report(const Progress& progress, std::string_view what, double fraction) {
  if (progress && !progress(what, fraction)) throw Error(Fault::cancelled, "cancelled");
}

std::vector<const double*> pointers(const std::vector<Vector>& fields) {
  std::vector<const double*> result;
  for (const Vector& f : fields) result.push_back(f.data());
  return result;
}

/// Basis functions of Loop elements end in the triangles about the neighbours of their vertex: those of vertices
/// further inside an excluded region do not reach out of it.
constexpr int rings_of_a_basis_function = 2;

/// What is left of a set of vertices without those that have a neighbour outside, so many times.
std::vector<char> eroded(const Topology& topology, std::vector<char> set, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<char> inner = set;
    for (const Triangle& t : topology.triangles)
      for (const Index v : t)
        for (const Index neighbour : t)
          if (!set[static_cast<std::size_t>(neighbour)]) inner[static_cast<std::size_t>(v)] = 0;
    set = std::move(inner);
  }
  return set;
}

RefinedMesh coarse_mesh(const Program& program, const std::vector<Point>& points) {
  RefinedMesh mesh{make_topology(points.size(), program.shape.triangles), points, 0};
  if (program.interpolate && program.method == "loop")
    mesh.control = interpolating_control(loop_discretisation(mesh.topology), points);
  return mesh;
}

/// So fine that it does when the surface is at its largest.
double wanted_edge(const Program& program) {
  const double largest = std::exp(std::max(0.0, program.motion.growth * program.until));
  return program.edge.value_or(program.size / program.resolution) / largest;
}

}  // namespace

Operators::Operators(const Program& program, const Progress& progress)
    : model_(program.model), length_unit_(program.length_unit) {
  report(progress, "refining", 0);
  RefinedMesh mesh = refined_mesh(program);
  levels_ = mesh.levels;
  control_ = std::move(mesh.control);
  report(progress, "tabulating basis functions", 0.2);
  discretisation_ = std::make_unique<Discretisation>(make_discretisation(program.method, std::move(mesh.topology)));
  report(progress, "assembling", 0.4);
  assembler_ = std::make_unique<Assembler>(*discretisation_);
  fill_matrices(program);
  report(progress, "sampling", 0.8);
  attributes_ = vertex_attributes(program);
  evaluate_places(program);
  hold_samples(program);
  if (model_.anisotropic()) find_directions(program);
  build_species();
}

RefinedMesh Operators::refined_mesh(const Program& program) const {
  RefinedMesh mesh = coarse_mesh(program, program.shape.points);
  const bool loop = program.method == "loop";
  if (!program.levels) return refine_to_edge(std::move(mesh), wanted_edge(program), loop, max_triangles);
  for (int level = 0; level < *program.levels; ++level) mesh = refine_once(mesh, loop);
  return mesh;
}

VertexAttributes Operators::vertex_attributes(const Program& program) const {
  VertexAttributes attributes = refined(program.shape, attributes_read(model_, program.shape), levels_);
  attributes.merge(refined_textures(model_, program.textures, program.shape, levels_));
  for (const Symbol& s : place_symbols(model_)) {
    if (s.kind != Symbol::Kind::attribute) continue;
    if (const auto field = program.fields.find(s.name); field != program.fields.end()) attributes.insert(*field);
    if (program.points && s.name == points_attribute)
      attributes[s.name] =
          distance_to_random_points(limit_positions(*discretisation_, control_), *program.points, program.seed);
  }
  return attributes;
}

/// Samples of the steppers that hold any are limit positions of the vertices: there coefficients are held instead, so
/// that the field is exactly what it was wherever all that make it up are.
void Operators::hold_samples(const Program& program) {
  if (!model_.held()) return;
  held_ = inside_ = kinetics_->held();
  if (program.excluded) held_ = eroded(discretisation_->topology, std::move(held_), rings_of_a_basis_function);
  system_.held = &held_;
}

void Operators::place(const Program& program, const std::vector<Point>& points) {
  RefinedMesh mesh = coarse_mesh(program, points);
  for (int level = 0; level < levels_; ++level) mesh = refine_once(mesh, program.method == "loop");
  control_ = std::move(mesh.control);
  fill_matrices(program);
  evaluate_places(program);
  for (std::size_t i = 0; i < variable_.size(); ++i)
    if (variable_[i]) fill_own_stiffness(i);
}

void Operators::fill_matrices(const Program& program) {
  mass_ = assembler_->mass(control_);
  stiffness_ = assembler_->stiffness(control_);
  if (program.stepper == "paper") {  // the scheme of the paper integrates its reaction matrices by quadrature
    sampling_ = quadrature_sampling(*discretisation_, control_);
    return;
  }
  sampling_ = vertex_sampling(*discretisation_, control_, mass_);
  mass_ = sampled_mass(sampling_, sampling_.weight, mass_.pattern);
}

/// What the formulas read from the places of the samples, and of the quadrature points where a diffusion varies.
void Operators::evaluate_places(const Program& program) {
  const auto at_quadrature = [&] { return quadrature_fields(model_, *discretisation_, control_, attributes_); };
  const auto kinetics = [&](const PlaceFields& fields) {
    return std::make_unique<Kinetics>(model_, fields.places(length_unit_), program.seed);
  };
  kinetics_ = kinetics(program.stepper == "paper" ? at_quadrature()
                                                  : vertex_fields(model_, *discretisation_, control_, attributes_));
  bool varies = false;
  for (std::size_t i = 0; i < model_.species_count(); ++i) varies = varies || has_own_stiffness(i);
  if (!varies) return;
  quadrature_kinetics_ = kinetics(at_quadrature());
  quadrature_values_ = quadrature_values(*discretisation_);
}

/// The variable coefficients of one species at its initial state, or at `state`.
void Operators::fill_variable(std::size_t i, const State* state) {
  Variable& v = *variable_[i];
  v.stiffness = assembler_->stiffness(control_, c1_at_quadrature(i, state));
  if (model_.varying_prefactor(i)) {
    v.weight = sampling_.weight.cwiseQuotient(c0_at_samples(i, state));
    v.mass = sampled_mass(sampling_, v.weight, mass_.pattern);
    system_.species[i].mass = &v.mass;
    system_.species[i].weight = &v.weight;
  }
  system_.species[i].stiffness = &v.stiffness;
  ++system_.species[i].revision;
}

bool Operators::diffusion_varies_in_time(std::size_t i) const {
  return (model_.diffusion_dependence(i) & ~static_cast<unsigned>(on_place)) != 0;
}

void Operators::build_species() {
  const double scale = length_unit_ * length_unit_;  // model length^2 to world length^2
  system_.mass = &mass_;
  system_.sampling = &sampling_;
  variable_.resize(model_.species_count());
  for (std::size_t i = 0; i < model_.species_count(); ++i) {
    Species s;
    s.name = model_.species_name(i);
    s.lower = model_.lower(i);
    s.upper = model_.upper(i);
    s.stiffness = &stiffness_;
    s.diffusion = scale;
    s.algebraic = model_.algebraic(i);
    const auto constant = model_.diffusion_constant(i);
    if (constant) s.diffusion *= *constant;
    system_.species.push_back(s);
    if (!has_own_stiffness(i)) continue;
    variable_[i] = std::make_unique<Variable>();
    fill_own_stiffness(i);
  }
  couple_species(scale);
  system_.reaction.rates = [this](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                  const MutableFieldPointers& rate) { kinetics_->rates(u, t, begin, end, rate); };
  system_.reaction.split = [this](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                  const MutableFieldPointers& c2,
                                  const MutableFieldPointers& c3) { kinetics_->split(u, t, begin, end, c2, c3); };
  system_.weighted_mass = [this](const Vector& factor) {
    return assembler_->mass(control_, std::vector<double>(factor.begin(), factor.end()));
  };
}

/// The direction field of anisotropic species; it stays with the vertices when the surface moves.
void Operators::find_directions(const Program& program) {
  lines_ = vertex_lines(program.shape, program.directions, levels_);
  const double safe = safe_ratio(program.method);
  for (std::size_t i = 0; i < model_.species_count(); ++i) {
    if (!model_.anisotropic(i)) continue;
    if (const double ratio = largest_ratio(quadrature_kinetics_->anisotropy(i)); ratio > safe)
      warnings_.push_back("the rates of " + model_.species_name(i) + " along and across differ " + number(ratio) +
                          " times; above " + number(safe) + " times, with --method " + program.method +
                          ", the mesh itself begins to show in the stripes");
  }
}

bool Operators::has_own_stiffness(std::size_t i) const {
  return model_.anisotropic(i) || !model_.diffusion_constant(i);
}

/// The stiffness of a species whose diffusion varies (with the initial state) or has directions.
void Operators::fill_own_stiffness(std::size_t i) {
  if (!model_.anisotropic(i)) return fill_variable(i, nullptr);
  Species& s = system_.species[i];
  SparseMatrix& stiffness = variable_[i]->stiffness;
  const Kinetics::TensorField rates = quadrature_kinetics_->anisotropy(i);
  stiffness = assembler_->stiffness(control_, quadrature_tensors(*discretisation_, control_, lines_, rates));
  s.stiffness = &stiffness;
  s.diffusion = length_unit_ * length_unit_;
  ++s.revision;
}

void Operators::couple_species(double scale) {
  CoupledSpecies& c = system_.coupled;
  c.index = model_.coupled();
  c.stiffness = &stiffness_;
  const auto n = std::ssize(c.index);
  c.diffusion.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = c.index[static_cast<std::size_t>(k)];
    system_.species[i].coupled = true;
    for (Eigen::Index l = 0; l < n; ++l)
      c.diffusion(k, l) = scale * model_.cross_diffusion(i, c.index[static_cast<std::size_t>(l)]);
    c.diffusion(k, k) = system_.species[i].diffusion;
  }
}

/// C0 and C1 of all species at the places of `kinetics`, for fields given there.
Operators::Coefficients Operators::evaluate_diffusion(const Kinetics& kinetics, const std::vector<Vector>& fields,
                                                      double time) {
  const std::size_t count = kinetics.size();
  Coefficients c;
  std::vector<double*> c0_out, c1_out;
  for (auto* list : {&c.c0, &c.c1}) list->assign(fields.size(), Vector(static_cast<Eigen::Index>(count)));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    c0_out.push_back(c.c0[i].data());
    c1_out.push_back(c.c1[i].data());
  }
  kinetics.diffusion(pointers(fields), time, 0, count, c0_out, c1_out);
  return c;
}

/// The fields at the places of `kinetics`; initial ones stand in for a missing state.
std::vector<Vector> Operators::fields_at(const Kinetics& kinetics, const SparseMatrix& values,
                                         const State* state) const {
  std::vector<Vector> fields(model_.species_count());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (state) {
      fields[i] = values * state->now[i];
    } else {
      fields[i].resize(static_cast<Eigen::Index>(kinetics.size()));
      kinetics.initial(i, std::span<double>(fields[i].data(), kinetics.size()));
    }
  }
  return fields;
}

std::vector<double> Operators::c1_at_quadrature(std::size_t species, const State* state) const {
  const Kinetics& kinetics = *quadrature_kinetics_;
  const Vector c1 =
      evaluate_diffusion(kinetics, fields_at(kinetics, quadrature_values_, state), state ? state->time : 0).c1[species];
  if (!(c1.minCoeff() >= 0))
    throw Error(Fault::usage,
                "the diffusion of " + model_.species_name(species) + " is negative somewhere; it must be at least 0");
  return {c1.begin(), c1.end()};
}

/// The matrices are divided by C0: where it is 0, a thousandth of its largest value stands in.
constexpr double smallest_share_of_c0 = 1e-3;

Vector Operators::c0_at_samples(std::size_t species, const State* state) const {
  const Vector c0 =
      evaluate_diffusion(*kinetics_, fields_at(*kinetics_, sampling_.values, state), state ? state->time : 0)
          .c0[species];
  const double largest = c0.maxCoeff();
  if (!(c0.minCoeff() >= 0 && largest > 0))
    throw Error(Fault::usage, "C0 of " + model_.species_name(species) +
                                  " is negative somewhere, or 0 everywhere; where it varies it must be at least 0");
  return c0.cwiseMax(smallest_share_of_c0 * largest);
}

void Operators::update(const State& state) {
  for (std::size_t i = 0; i < variable_.size(); ++i)
    if (variable_[i] && !model_.anisotropic(i) && diffusion_varies_in_time(i)) fill_variable(i, &state);
}

double Operators::largest_k2() const {
  Vector x(stiffness_.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 2 * uniform(0, static_cast<std::uint64_t>(i)) - 1;
  double k2 = 0;
  for (int iteration = 0; iteration < 25; ++iteration) {
    const Vector y = solve_spd(mass_, stiffness_ * x, {.tolerance = 1e-4});
    k2 = std::sqrt(dot(y, y) / dot(x, x));
    x = y / std::sqrt(dot(y, y));
  }
  return 1.1 * k2;  // power iteration comes from below
}

Vector Operators::sampled_coefficients(const std::function<void(std::span<double>)>& fill) const {
  Vector samples(sampling_.count());
  fill(std::span<double>(samples.data(), static_cast<std::size_t>(samples.size())));
  return coefficients_from_samples(sampling_, mass_, samples);
}

/// Pinned and other values are two smooth fields; a jump between their samples would make the coefficients overshoot.
std::vector<Vector> Operators::initial() const {
  std::vector<Vector> coefficients;
  for (std::size_t i = 0; i < model_.species_count(); ++i) {
    Vector& u = coefficients.emplace_back(sampled_coefficients([&](auto out) { kinetics_->initial(i, out); }));
    if (!inside_.empty() && model_.pinned(i)) {
      const Vector pin = sampled_coefficients([&](auto out) { kinetics_->pin(i, out); });
      for (Eigen::Index k = 0; k < u.size(); ++k)
        if (inside_[static_cast<std::size_t>(k)]) u[k] = pin[k];
    }
    u = u.cwiseMax(model_.lower(i)).cwiseMin(model_.upper(i));
  }
  if (!solve_algebraic(system_, 0, coefficients, 1e-10).converged)
    throw Error(Fault::numerics,
                "the initial " + coupled_names(system_) + " cannot be found: the solve did not converge");
  return coefficients;
}

}  // namespace pelage
