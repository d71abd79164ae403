#include "run/stage_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "base/number.h"
#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "pelage/error.h"
#include "react/diffusion_tensor.h"
#include "run/constant_diffusion.h"
#include "time/step_support.h"

namespace pelage {

namespace {

std::vector<const double*> pointers(const std::vector<Vector>& fields) {
  std::vector<const double*> result;
  for (const Vector& f : fields) result.push_back(f.data());
  return result;
}

bool diffusion_reads_species(const Model& model) {
  for (std::size_t i = 0; i < model.species_count(); ++i)
    if (!model.anisotropic(i) && (model.diffusion_dependence(i) & static_cast<unsigned>(on_species)) != 0) return true;
  return false;
}

bool diffusion_varies_in_time(const Model& model, std::size_t i) {
  return !model.anisotropic(i) && (model.diffusion_dependence(i) & ~static_cast<unsigned>(on_place)) != 0;
}

}  // namespace

StageSystem::StageSystem(const StageProgram& stage, std::shared_ptr<const Space> space,
                         std::shared_ptr<const Material> material)
    : stage_(&stage), space_(std::move(space)), material_(std::move(material)) {
  system_.lattice = space_->lattice();
  system_.held = material_->held;
  const std::vector<Eigen::Matrix3d> tensors = constant_tensors(stage, *space_, *material_);
  matrix_free_ = needs_no_matrices(stage, *space_, *material_, tensors);
  if (matrix_free_)
    system_.sampling = std::make_shared<const Sampling>(lattice_sampling(*system_.lattice));
  else
    sample_space();
  kinetics_ = kinetics_at(stage.stepper->samples, Kinetics::Parts::all);
  if (acts_at_quadrature_points(stage.model) && !matrix_free_) {
    quadrature_kinetics_ = kinetics_at(SampleRule::quadrature, Kinetics::Parts::diffusion);
    quadrature_values_ = space_->quadrature_values();
  }
  for (std::size_t i = 0; i < stage.model.species_count(); ++i) {
    add_species(i);
    if (!tensors.empty()) system_.species[i].tensor = tensors[i];
  }
  couple_species();
  add_reaction();
  add_gradients();
  if (!stage.borders.empty()) add_borders();
}

void StageSystem::sample_space() {
  const SampledMass sampled = space_->sampled(stage_->stepper->samples);
  system_.mass = sampled.mass;
  system_.sampling = sampled.sampling;
}

std::shared_ptr<const Kinetics> StageSystem::kinetics_at(SampleRule rule, Kinetics::Parts parts) const {
  const PlaceFields fields = place_fields(stage_->model, *space_, rule, material_->attributes);
  return std::make_shared<const Kinetics>(stage_->model, fields.places(material_->at(rule), *stage_), stage_->seed,
                                          parts);
}

void StageSystem::add_species(std::size_t i) {
  const Model& model = stage_->model;
  Species s;
  s.name = model.species_name(i);
  s.lower = model.lower(i);
  s.upper = model.upper(i);
  if (!matrix_free_) s.stiffness = space_->stiffness();
  s.diffusion = stage_->length_unit * stage_->length_unit;  // model length^2 to world length^2
  s.algebraic = model.algebraic(i);
  s.follows = model.follows(i);
  if (const auto constant = model.diffusion_constant(i)) s.diffusion *= *constant;
  system_.species.push_back(std::move(s));
  if (has_own_stiffness(model, i) && !matrix_free_) fill_own_stiffness(i);
}

double StageSystem::anisotropy(std::size_t i) const {
  if (stage_->model.has_tensor(i)) {
    if (matrix_free_) return largest_ratio(*system_.lattice, *system_.species[i].tensor);
    return largest_ratio(tensors_at_quadrature(i, nullptr), space_->geometry(SampleRule::quadrature, false).normal);
  }
  if (!matrix_free_) return largest_ratio(quadrature_kinetics_->anisotropy(i));
  return largest_ratio(even_anisotropy(*stage_, i));
}

void StageSystem::couple_species() {
  const Model& model = stage_->model;
  const double scale = stage_->length_unit * stage_->length_unit;
  CoupledSpecies& c = system_.coupled;
  c.index = model.coupled();
  if (!c.index.empty()) c.stiffness = space_->stiffness();
  const auto n = std::ssize(c.index);
  c.diffusion.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = c.index[static_cast<std::size_t>(k)];
    system_.species[i].coupled = true;
    for (Eigen::Index l = 0; l < n; ++l)
      c.diffusion(k, l) = scale * model.cross_diffusion(i, c.index[static_cast<std::size_t>(l)]);
    c.diffusion(k, k) = system_.species[i].diffusion;
  }
}

void StageSystem::add_reaction() {
  system_.weighted_mass = [space = space_](const Vector& factor) {
    return space->weighted_mass(std::vector<double>(factor.begin(), factor.end()));
  };
  if (stage_->own_rates) return add_own_reaction();
  system_.reaction.rates = [kinetics = kinetics_](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                                  const MutableFieldPointers& rate) {
    kinetics->rates(u, t, begin, end, rate);
  };
  system_.reaction.float_rates = [kinetics = kinetics_](double t) { return kinetics->float_rates(t); };
  system_.reaction.float_jacobian = [kinetics = kinetics_](double t) { return kinetics->float_jacobian(t); };
  system_.reaction.split = [kinetics = kinetics_](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                                  const MutableFieldPointers& c2, const MutableFieldPointers& c3) {
    kinetics->split(u, t, begin, end, c2, c3);
  };
}

/// Whose rates depend on anything that a program likes: there is nothing to split.
void StageSystem::add_own_reaction() {
  if (stage_->stepper->splits)
    throw Error(Fault::usage, "the stepper " + std::string(stage_->stepper->name) +
                                  " splits formulas into C2 u + C3, and rates of your own are none; take another");
  system_.reaction.rates = [rates = stage_->own_rates](const FieldPointers& u, double t, std::size_t begin,
                                                       std::size_t end, const MutableFieldPointers& rate) {
    FieldPointers in = u;
    MutableFieldPointers out = rate;
    for (const double*& field : in) field += begin;
    for (double*& field : out) field += begin;
    rates(in, t, begin, end, out);
  };
}

namespace {

/// -K(c) u of every flux, with c at the quadrature points.
struct FluxLoads {
  std::shared_ptr<const Space> space;
  std::shared_ptr<const Kinetics> kinetics;  ///< at the quadrature points
  SparseMatrix values;                       ///< quadrature points x unknowns
  std::vector<Flux> fluxes;
  double scale;  ///< model length^2 to world length^2

  std::vector<std::vector<double>> coefficients(const std::vector<Vector>& u, double t) const {
    std::vector<Vector> fields;
    for (const Vector& field : u)  // those of species that follow may be missing: no coefficient reads them
      fields.push_back(field.size() > 0 ? values * field : Vector(Vector::Zero(values.rows())));
    std::vector<std::vector<double>> c(fluxes.size(), std::vector<double>(kinetics->size()));
    std::vector<double*> out;
    for (std::vector<double>& list : c) out.push_back(list.data());
    const std::vector<const double*> in = pointers(fields);
    parallel_for(kinetics->size(),
                 [&](std::size_t begin, std::size_t end) { kinetics->fluxes(in, t, begin, end, out); });
    return c;
  }

  std::vector<Vector> operator()(const std::vector<Vector>& u, double t) const {
    const std::vector<std::vector<double>> c = coefficients(u, t);
    std::vector<Vector> loads(u.size());
    for (std::size_t k = 0; k < fluxes.size(); ++k) {
      Vector& load = loads[fluxes[k].species];
      if (load.size() == 0) load = Vector::Zero(space->unknowns());
      axpby(-scale, space->stiffness(c[k]) * u[fluxes[k].of], 1, load);
    }
    return loads;
  }
};

}  // namespace

void StageSystem::add_gradients() {
  const Equations& equations = stage_->model.equations();
  const double scale = stage_->length_unit * stage_->length_unit;
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const NodeId id : equations.gradients) {
    const Symbol& symbol = equations.graph.symbol_of(id);
    pairs.push_back({static_cast<std::size_t>(symbol.index), static_cast<std::size_t>(symbol.other)});
  }
  if (!pairs.empty())
    system_.add_gradients = [space = space_, rule = stage_->stepper->samples, pairs, scale](
                                const std::vector<Vector>& u, std::vector<Vector>& samples) {
      for (const auto& [i, j] : pairs) samples.push_back(scale * space->gradient_product(rule, u[i], u[j]));
    };
  if (!equations.fluxes.empty())
    system_.fluxes = FluxLoads{space_, quadrature_kinetics_, quadrature_values_, equations.fluxes, scale};
}

void StageSystem::add_borders() {
  borders_ = std::make_shared<const Borders>(*stage_, *space_);
  for (std::size_t i = 0; i < system_.species.size(); ++i) {
    if (!borders_->gives_values(i)) continue;
    system_.species[i].held = borders_->held(i, system_.held.get());
    system_.set_values = [borders = borders_](std::size_t species, double t, Vector& u) {
      borders->set_values(species, t, u);
    };
  }
  if (borders_->any_inflow())
    system_.fluxes = [borders = borders_, others = system_.fluxes](const std::vector<Vector>& u, double t) {
      std::vector<Vector> loads = others ? others(u, t) : std::vector<Vector>(u.size());
      borders->add_inflows(u, t, loads);
      return loads;
    };
}

/// Takes the matrices of an earlier species with the same diffusion, if there is one: components of vectors have it.
bool StageSystem::share_diffusion(std::size_t i) {
  for (std::size_t j = 0; j < i; ++j) {
    if (!stage_->model.same_diffusion(i, j)) continue;
    const Species& other = system_.species[j];
    Species& s = system_.species[i];
    s.stiffness = other.stiffness;
    s.diffusion = other.diffusion;
    s.mass = other.mass;
    s.weight = other.weight;
    return true;
  }
  return false;
}

/// The stiffness of a species whose diffusion varies (with the initial state) or has directions.
void StageSystem::fill_own_stiffness(std::size_t i) {
  if (share_diffusion(i)) return;
  if (!stage_->model.anisotropic(i)) return fill_variable(i, nullptr);
  const Kinetics::TensorField rates = quadrature_kinetics_->anisotropy(i);
  Species& s = system_.species[i];
  s.stiffness = std::make_shared<const SparseMatrix>(space_->stiffness(space_->tensors(material_->lines, rates)));
  s.diffusion = stage_->length_unit * stage_->length_unit;
}

/// The variable coefficients of one species at its initial state, or at `state`.
void StageSystem::fill_variable(std::size_t i, const State* state) {
  Species& s = system_.species[i];
  s.stiffness = std::make_shared<const SparseMatrix>(stage_->model.has_tensor(i)
                                                         ? space_->stiffness(tensors_at_quadrature(i, state))
                                                         : space_->stiffness(c1_at_quadrature(i, state)));
  if (!stage_->model.varying_prefactor(i)) return;
  s.weight = std::make_shared<const Vector>(system_.sampling->weight.cwiseQuotient(c0_at_samples(i, state)));
  s.mass = std::make_shared<const SparseMatrix>(sampled_mass(*system_.sampling, *s.weight, system_.mass->pattern));
}

/// C0 and C1 of all species at the places of `kinetics`, for fields given there.
StageSystem::Coefficients StageSystem::evaluate_diffusion(const Kinetics& kinetics, const std::vector<Vector>& fields,
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

namespace {

Vector as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), std::ssize(values));
}

}  // namespace

/// The fields at the samples of `rule`, to which `values` leads, for diffusions that read them; initial ones stand in
/// for a missing state.
std::vector<Vector> StageSystem::fields_at(SampleRule rule, const SparseMatrix& values, const State* state) const {
  const Model& model = stage_->model;
  std::vector<Vector> fields(model.species_count());
  if (state) {
    for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = values * state->now[i];
    return fields;
  }
  if (!diffusion_reads_species(model)) {
    for (Vector& field : fields) field = Vector::Zero(values.rows());
    return fields;
  }
  const PlaceFields of_places = place_fields(model, *space_, rule, material_->attributes);
  const Places places = of_places.places(material_->at(rule), *stage_);
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = as_vector(initial_values(model, i, places, stage_->seed));
  return fields;
}

std::vector<double> StageSystem::c1_at_quadrature(std::size_t species, const State* state) const {
  const Kinetics& kinetics = *quadrature_kinetics_;
  const std::vector<Vector> fields = fields_at(SampleRule::quadrature, quadrature_values_, state);
  const Vector c1 = evaluate_diffusion(kinetics, fields, state ? state->time : 0).c1[species];
  if (!std::ranges::all_of(c1, [](double c) { return c >= 0; }))
    throw Error(Fault::usage, "the diffusion of " + stage_->model.species_name(species) +
                                  " is negative somewhere; it must be at least 0");
  return {c1.begin(), c1.end()};
}

std::vector<Tensor> StageSystem::tensors_at_quadrature(std::size_t species, const State* state) const {
  const Kinetics& kinetics = *quadrature_kinetics_;
  const std::vector<Vector> fields = fields_at(SampleRule::quadrature, quadrature_values_, state);
  std::vector<Tensor> tensors = tensors_of(stage_->model, species, kinetics, pointers(fields), state ? state->time : 0);
  const auto bad = std::ranges::find_if_not(tensors, positive_semidefinite);
  if (bad == tensors.end()) return tensors;
  const Point place =
      space_->geometry(SampleRule::quadrature, false).position[static_cast<std::size_t>(bad - tensors.begin())];
  throw Error(Fault::usage, "the tensor of " + stage_->model.species_name(species) + " at (" + number(place[0]) + ", " +
                                number(place[1]) + ", " + number(place[2]) +
                                ") would gather instead of spread in some direction; it must be positive semidefinite");
}

/// The matrices are divided by C0: where it is 0, a thousandth of its largest value stands in.
constexpr double smallest_share_of_c0 = 1e-3;

Vector StageSystem::c0_at_samples(std::size_t species, const State* state) const {
  const std::vector<Vector> fields = fields_at(stage_->stepper->samples, system_.sampling->values, state);
  const Vector c0 = evaluate_diffusion(*kinetics_, fields, state ? state->time : 0).c0[species];
  const double largest = maximum(c0);
  if (!std::ranges::all_of(c0, [](double c) { return c >= 0; }) || !(largest > 0))
    throw Error(Fault::usage, "C0 of " + stage_->model.species_name(species) +
                                  " is negative somewhere, or 0 everywhere; where it varies it must be at least 0");
  return c0.cwiseMax(smallest_share_of_c0 * largest);
}

void StageSystem::update(const State& state) {
  for (std::size_t i = 0; i < system_.species.size(); ++i)
    if (diffusion_varies_in_time(stage_->model, i) && !share_diffusion(i)) fill_variable(i, &state);
}

namespace {

Vector finite(const Model& model, std::size_t i, const std::vector<double>& values) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    throw Error(Fault::usage, "model \"" + model.name() + "\": the initial values of " + model.species_name(i) +
                                  " are not finite everywhere");
  return as_vector(values);
}

/// Fields that begin the same are solved for once.
class SolvedOnce {
 public:
  template <class Solve>
  const Vector& coefficients(const Vector& samples, Solve&& solve) {
    for (const auto& [known, result] : solved_)
      if (known == samples) return result;
    return solved_.emplace_back(samples, solve(samples)).second;
  }

 private:
  std::deque<std::pair<Vector, Vector>> solved_;
};

}  // namespace

/// Pinned and other values are two smooth fields; a jump between their samples would make the coefficients overshoot.
std::vector<Vector> StageSystem::initial() const {
  const Model& model = stage_->model;
  const SampleRule rule = stage_->stepper->samples;
  const PlaceFields of_places = place_fields(model, *space_, rule, material_->attributes);
  const Places places = of_places.places(material_->at(rule), *stage_);
  std::vector<Vector> coefficients;
  SolvedOnce solved;
  const auto solve = [&](const Vector& samples) {
    return matrix_free_ ? samples : coefficients_from_samples(*system_.sampling, *system_.mass, samples);
  };
  for (std::size_t i = 0; i < model.species_count(); ++i) {
    Vector& u = coefficients.emplace_back(
        solved.coefficients(finite(model, i, initial_values(model, i, places, stage_->seed)), solve));
    if (!material_->inside.empty() && model.pinned(i)) {
      const Vector& pin = solved.coefficients(finite(model, i, pinned_values(model, i, places, stage_->seed)), solve);
      for (Eigen::Index k = 0; k < u.size(); ++k)
        if (material_->inside[static_cast<std::size_t>(k)]) u[k] = pin[k];
    }
    u = u.cwiseMax(model.lower(i)).cwiseMin(model.upper(i));
    if (system_.set_values) system_.set_values(i, 0, u);
  }
  if (!solve_algebraic(system_, 0, coefficients, 1e-10).converged)
    throw Error(Fault::numerics,
                "the initial " + coupled_names(system_) + " cannot be found: the solve did not converge");
  follow(system_, 0, coefficients);
  return coefficients;
}

}  // namespace pelage
