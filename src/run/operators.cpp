#include "run/operators.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"
#include "time/step_support.h"

namespace pelage {

namespace {

/// At least so many control vertices per wavelength: Loop elements then represent a sine to better than a percent.
constexpr double vertices_per_wavelength = 6;

/// A finer mesh would need more than the memory of common machines: about 2 kB per Loop vertex.
constexpr std::size_t max_triangles = 8'000'000;

void report(const Progress& progress, std::string_view what, double fraction) {
  if (progress && !progress(what, fraction)) throw Error(Fault::cancelled, "cancelled");
}

std::vector<const double*> pointers(const std::vector<Vector>& fields) {
  std::vector<const double*> result;
  for (const Vector& f : fields) result.push_back(f.data());
  return result;
}

}  // namespace

Operators::Operators(const Program& program, const Progress& progress)
    : model_(program.model), length_unit_(program.length_unit) {
  const bool loop = program.method == "loop";
  report(progress, "refining", 0);
  RefinedMesh mesh;
  mesh.topology = make_topology(program.shape.points.size(), program.shape.triangles);
  mesh.control = program.shape.points;
  if (program.interpolate && loop)
    mesh.control = interpolating_control(loop_discretisation(mesh.topology), program.shape.points);
  mesh = refine_to_edge(std::move(mesh), program.size / vertices_per_wavelength, loop, max_triangles);
  levels_ = mesh.levels;
  control_ = std::move(mesh.control);
  report(progress, "tabulating basis functions", 0.2);
  discretisation_ = std::make_unique<Discretisation>(make_discretisation(program.method, std::move(mesh.topology)));
  report(progress, "assembling", 0.4);
  assembler_ = std::make_unique<Assembler>(*discretisation_);
  mass_ = assembler_->mass(control_);
  stiffness_ = assembler_->stiffness(control_);
  report(progress, "sampling", 0.8);
  if (program.stepper == "paper") {  // the scheme of the paper integrates its reaction matrices by quadrature
    sampling_ = quadrature_sampling(*discretisation_, control_);
  } else {
    sampling_ = vertex_sampling(*discretisation_, control_, mass_);
    mass_ = sampled_mass(sampling_, mass_.pattern);
  }
  const VertexAttributes attributes = refined(program.shape, attributes_read(model_, program.shape), levels_);
  const PlaceFields fields = program.stepper == "paper"
                                 ? quadrature_fields(model_, *discretisation_, control_, attributes)
                                 : vertex_fields(model_, *discretisation_, control_, attributes);
  kinetics_ = std::make_unique<Kinetics>(model_, fields.places(length_unit_), program.seed);
  build_species(program, attributes);
}

bool Operators::diffusion_varies_in_time(std::size_t i) const {
  return (model_.diffusion_dependence(i) & ~static_cast<unsigned>(on_place)) != 0;
}

void Operators::build_species(const Program& program, const VertexAttributes& attributes) {
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
    if (const auto constant = model_.diffusion_constant(i)) {
      s.diffusion *= *constant;
    } else {
      if (!quadrature_kinetics_) {
        const PlaceFields fields = quadrature_fields(model_, *discretisation_, control_, attributes);
        quadrature_kinetics_ = std::make_unique<Kinetics>(model_, fields.places(length_unit_), program.seed);
        quadrature_values_ = quadrature_values(*discretisation_);
      }
      variable_[i] =
          std::make_unique<SparseMatrix>(assembler_->stiffness(control_, diffusion_at_quadrature(i, nullptr)));
      s.stiffness = variable_[i].get();
    }
    system_.species.push_back(s);
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

/// C1 of one species; the initial state stands in for a missing one.
std::vector<double> Operators::diffusion_at_quadrature(std::size_t species, const State* state) const {
  const std::size_t count = quadrature_kinetics_->size();
  std::vector<Vector> fields(model_.species_count(), Vector::Zero(static_cast<Eigen::Index>(count)));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (state)
      fields[i] = quadrature_values_ * state->now[i];
    else
      quadrature_kinetics_->initial(i, std::span<double>(fields[i].data(), count));
  }
  std::vector<std::vector<double>> c0(fields.size(), std::vector<double>(count)), c1 = c0;
  std::vector<double*> c0_out, c1_out;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    c0_out.push_back(c0[i].data());
    c1_out.push_back(c1[i].data());
  }
  quadrature_kinetics_->diffusion(pointers(fields), state ? state->time : 0, 0, count, c0_out, c1_out);
  const std::string& name = model_.species_name(species);
  if (std::any_of(c0[species].begin(), c0[species].end(), [](double c) { return c != 1; }))
    throw Error(Fault::usage, "C0 of " + name + " varies; give it as a constant, or move it into C1");
  if (!std::all_of(c1[species].begin(), c1[species].end(), [](double c) { return c >= 0; }))
    throw Error(Fault::usage, "the diffusion of " + name + " is negative somewhere; it must be at least 0");
  return std::move(c1[species]);
}

void Operators::update(const State& state) {
  for (std::size_t i = 0; i < variable_.size(); ++i)
    if (variable_[i] && diffusion_varies_in_time(i))
      *variable_[i] = assembler_->stiffness(control_, diffusion_at_quadrature(i, &state));
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

std::vector<Vector> Operators::initial() const {
  std::vector<Vector> coefficients;
  const auto count = static_cast<std::size_t>(sampling_.count());
  Vector samples(sampling_.count());
  for (std::size_t i = 0; i < model_.species_count(); ++i) {
    kinetics_->initial(i, std::span<double>(samples.data(), count));
    coefficients.push_back(coefficients_from_samples(sampling_, mass_, samples));
    coefficients.back() = coefficients.back().cwiseMax(model_.lower(i)).cwiseMin(model_.upper(i));
  }
  if (!solve_algebraic(system_, 0, coefficients, 1e-10).converged)
    throw Error(Fault::numerics,
                "the initial " + coupled_names(system_) + " cannot be found: the solve did not converge");
  return coefficients;
}

}  // namespace pelage
