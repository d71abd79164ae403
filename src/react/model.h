#pragma once
// Reaction models as data: what a model file says (ModelSource), and that compiled to expressions (Model).
//
// Each species u obeys the generalised PDE (eq. 2 of Bajaj, Zhang, Xu 2008)
//     du/dt = C0 div(C1 grad u) + R,   R = C2 u + C3,
// given either by a diffusion (C0 = 1, C1 = diffusion) and a rate R, or by C0, C1, C2, C3 one by one. A rate may
// contain Laplacians of this and other species with constant coefficients; and a species w may be algebraic, w = f +
// sum_j E_j lap(u_j) at every time, which makes equations of fourth order out of two of second order:
//     du_i/dt = C0 div(C1 grad u_i) + sum_j D_ij lap(u_j) + sum_j div(c_ij grad u_j) + R_i
// Rates may also contain products of gradients of species (react/gradient_terms.h). C1 may be a tensor. A vector is
// three species, its components, that share C0 and C1.

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "react/expression.h"
#include "react/gradient_terms.h"
#include "react/lexer.h"

namespace pelage {

/// Diffusion that differs along and across a direction field on the surface (Witkin, Kass 1991):
/// tensor = a1^2 d d' + a2^2 n n' with d at the angle theta, counter-clockwise, from the field and n across d. Formulas
/// of the place and of parameters.
struct AnisotropySource {
  Formula theta;   ///< radians
  Formula a1, a2;  ///< rates: model length unit / square root of the model time unit
};

/// C1 as a symmetric tensor along the axes of space, of which on surfaces the part along them acts: formulas of all
/// that a diffusion may depend on, xx, xy, xz, yy, yz, zz [model length unit^2 / model time unit].
using TensorSource = std::array<Formula, 6>;
constexpr std::array<const char*, 6> tensor_entries = {"xx", "xy", "xz", "yy", "yz", "zz"};

struct SpeciesSource {
  std::string name;
  Location where;
  std::optional<Formula> diffusion;            ///< model length unit^2 / model time unit; "0" if it does not diffuse
  std::optional<AnisotropySource> anisotropy;  ///< instead of `diffusion`
  std::optional<TensorSource> tensor;          ///< instead of `diffusion` or C1
  std::optional<Formula> rate;                 ///< R: concentration / model time unit; may contain D lap(v),
                                               ///< grad2(v), dot(grad u, grad v), div(c grad v)
  std::optional<Formula> equals;  ///< makes it algebraic, instead of all else: a formula in the evolving species and
                                  ///< in the Laplacians of all
  std::optional<Formula> c0, c1, c2,
      c3;                               ///< instead of `diffusion` (C0, C1) or of `rate` (C2, C3); C0, C1 default to 1
  std::optional<Formula> initial;       ///< at time 0; defaults to 0
  std::optional<Formula> lower, upper;  ///< bounds to which the concentration is clamped; numbers or parameters
  std::string vector;                   ///< of which it is a component, by its name; empty: of none
};

struct ParameterSource {
  std::string name;
  double value = 0;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::string unit;  ///< "1" or "" for a pure number
  std::string help;  ///< one line
  Location where;
  std::optional<double> reference = {};  ///< that of the file or variant, where `value` was set to another
};

/// A named sub-expression. It may use parameters, species and definitions above it.
struct DefinitionSource {
  std::string name;
  Formula formula;
};

/// A value for a parameter, and where it was given.
struct Override {
  double value = 0;
  Location where;
  Override() = default;
  Override(double number, Location place = {}) : value(number), where(std::move(place)) {}  // NOLINT: implicit
};
using Overrides = std::map<std::string, Override>;

/// What the steppers start from; none of it is part of the equations.
struct Suggestions {
  std::optional<double> step;  ///< time step, model time units
  std::optional<double> end;   ///< time after which the pattern is finished
  std::optional<double>
      tolerance;  ///< stationary when the pattern changes by less than this share of its amplitude per unit time
  /// Control vertices per wavelength at least. With 6, Loop elements represent a sine to better than a percent;
  /// patterns with fronts much thinner than their spacing ask for more.
  std::optional<double> resolution;
  /// Stages or solver iterations of the default stepper up to the end, as measured; only the time that a run will take
  /// is estimated by it.
  std::optional<double> iterations = {};
  double resolution_or_default() const { return resolution.value_or(6); }
};

/// A named set of parameter values under the same equations.
struct VariantSource {
  std::string name;
  std::string title;
  Overrides parameters;
  std::optional<double> wavelength;       ///< as in ModelSource
  std::optional<Formula> wavelength_law;  ///< instead of the model's
  std::optional<Formula> period = {};     ///< likewise
  Suggestions suggestions;
  Location where;
};

struct ModelSource {
  std::string name;
  std::string title;
  std::string cite;
  std::string summary;
  Location where;
  std::vector<SpeciesSource> species;
  std::vector<ParameterSource> parameters;
  std::vector<DefinitionSource> definitions;
  std::vector<VariantSource> variants;
  std::optional<double> wavelength;       ///< measured spacing of the finished pattern at the values of the file or the
                                          ///< variant, model length units
  std::optional<Formula> wavelength_law;  ///< the spacing as a formula of the parameters. Beside a number, which then
                                          ///< is that of a variant, only its ratios count. See model_wavelength().
  std::optional<Formula> period = {};     ///< after which the finished pattern comes back, a formula of the parameters
                                          ///< [model time]
  Suggestions suggestions;
};

/// What a stage of a recipe changes in a model. Its formulas know what those of the model know.
struct ModelChanges {
  struct OfSpecies {
    std::string species;
    Formula formula;
  };
  std::vector<DefinitionSource> maps;   ///< parameters that differ from place to place
  std::optional<Location> points;       ///< the name `points` stands for the attribute of that name
  std::optional<Formula> mask;          ///< where it is not 0 the concentrations stay what they are initially
  bool excluded = false;                ///< and neither react nor diffuse
  std::vector<OfSpecies> carried;       ///< initial concentrations from an attribute, whose name is the text
  std::vector<OfSpecies> initial, pin;  ///< initial concentrations, everywhere and inside of the mask
  std::optional<Formula> size;          ///< factor on all lengths
};

/// The model with the values of one of its variants. Error(usage) for an unknown variant.
ModelSource with_variant(ModelSource source, const std::string& variant);

/// A diffusion tensor as expressions of the place; see AnisotropySource.
struct Anisotropy {
  NodeId theta, a1, a2;
  bool operator==(const Anisotropy&) const = default;
};

/// The equations of a model; expressions in terms of `graph`, one per species unless said otherwise.
struct Equations {
  Graph graph;
  std::vector<NodeId> species;    ///< the symbols
  std::vector<char> algebraic;    ///< u = R + Laplacians instead of du/dt = R + Laplacians
  std::vector<char> follows;      ///< algebraic, without Laplacians, and no equation of another species reads it
  std::vector<NodeId> rate;       ///< R, without Laplacians and fluxes; of algebraic species depends on evolving ones
                                  ///< only
  std::vector<NodeId> gradients;  ///< the products of gradients that rates use: symbols
  std::vector<Flux> fluxes;       ///< what else drives species, explicit in time; a species' own flux is here only
                                  ///< where it is coupled, else in `diffusion`
  std::vector<NodeId> c2, c3;     ///< R = C2 u + C3
  std::vector<NodeId> prefactor;  ///< C0, 1 when it is constant (then it is part of `diffusion`)
  std::vector<NodeId> diffusion;  ///< C1, with the coefficient of the species' own Laplacian in its rate; where it is
                                  ///< anisotropic a2^2, that across the stripes which the field draws out; of a tensor
                                  ///< the mean of xx, yy and zz
  std::vector<std::optional<Anisotropy>> anisotropy;
  std::vector<std::optional<std::array<NodeId, 6>>> tensor;  ///< C1 where it is one: as TensorSource
  std::vector<double> cross;               ///< coefficient of lap(u_j) in equation i at [i * species + j], 0 for j = i
  std::vector<NodeId> initial;             ///< depends on the place only
  std::vector<std::optional<NodeId>> pin;  ///< likewise, where concentrations are held
  std::optional<NodeId> mask;              ///< likewise; not 0 where they are; rates and diffusions know it as a symbol
  std::vector<NodeId> jacobian;            ///< dR_i / du_j at [i * species + j]
  std::vector<double> lower, upper;        ///< bounds of the concentrations, infinite where there is none
  std::optional<NodeId> wavelength_law;    ///< a number, unless a stage maps a parameter that is in it
  std::optional<NodeId> period;            ///< likewise
};

/// A compiled model: an immutable value, cheap to copy.
class Model {
 public:
  const ModelSource& source() const { return *source_; }  ///< parameters carry the values in use
  const Equations& equations() const { return *equations_; }
  const std::string& name() const { return source_->name; }
  std::size_t species_count() const { return source_->species.size(); }
  const std::string& species_name(std::size_t i) const { return source_->species[i].name; }
  const std::vector<ParameterSource>& parameters() const { return source_->parameters; }

  /// After which the pattern comes back [model time], where the file says so and no stage maps what it is made of.
  std::optional<double> period() const;

  /// Not advanced in time but determined by the others at every time.
  bool algebraic(std::size_t i) const { return equations_->algebraic[i] != 0; }
  /// Algebraic, and only shown: nothing has to be solved for it, and steps do without it.
  bool follows(std::size_t i) const { return equations_->follows[i] != 0; }
  /// Species that are linked by Laplacians and have to be solved for together; their diffusions are numbers.
  std::vector<std::size_t> coupled() const;
  /// Coefficient of lap(u_j) in the equation of species i, j != i.
  double cross_diffusion(std::size_t i, std::size_t j) const { return equations_->cross[i * species_count() + j]; }

  /// Whether rates know gradients of species: products of two, or fluxes.
  bool has_gradients() const { return !equations_->gradients.empty() || !equations_->fluxes.empty(); }

  /// Whether species i diffuses differently along and across a direction field.
  bool anisotropic(std::size_t i) const { return equations_->anisotropy[i].has_value(); }
  /// Whether any does.
  bool anisotropic() const;
  /// Whether the diffusion of species i is a tensor given by formulas, and whether that of any is.
  bool has_tensor(std::size_t i) const { return equations_->tensor[i].has_value(); }
  bool has_tensor() const;
  /// Whether C0 and C1 of two species are the same expressions.
  bool same_diffusion(std::size_t i, std::size_t j) const;

  /// Whether a rate may jump with the concentrations: it has if(), comparisons or floor() of them.
  bool jumps() const;

  /// Whether concentrations are held somewhere, and whether those of species i then start from other values.
  bool held() const { return equations_->mask.has_value(); }
  bool pinned(std::size_t i) const { return equations_->pin[i].has_value(); }

  /// C0 * C1 of species i where both are numbers; otherwise see Kinetics. Not negative unless coupled.
  std::optional<double> diffusion_constant(std::size_t i) const;
  /// Whether C0 of species i is not a number.
  bool varying_prefactor(std::size_t i) const;
  /// What C0 and C1 of species i vary with: bits of Dependence.
  unsigned diffusion_dependence(std::size_t i) const;
  double lower(std::size_t i) const { return equations_->lower[i]; }
  double upper(std::size_t i) const { return equations_->upper[i]; }

  /// The same for the same equations; see base/fingerprint.h.
  std::uint64_t fingerprint() const;

 private:
  friend Model compile(const ModelSource& source, const Overrides& overrides, const ModelChanges& changes);
  std::shared_ptr<const ModelSource> source_;
  std::shared_ptr<const Equations> equations_;
};

/// Compiles a model with some of its parameters changed. Error(usage), located, for faults in the formulas,
/// names that are unknown, reserved or given twice, and parameters outside of their range. The names in `changes` are
/// those of parameters and species of the model.
Model compile(const ModelSource& source, const Overrides& overrides = {}, const ModelChanges& changes = {});

}  // namespace pelage
