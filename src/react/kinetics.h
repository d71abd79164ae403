#pragma once
// A model bound to places on a surface: rates, coefficients and initial values, evaluated in blocks.

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/box.h"
#include "pelage/point.h"
#include "react/model.h"
#include "react/tape.h"

namespace pelage {

/// A random field that has been drawn: one value per place.
struct DrawnField {
  Symbol symbol;
  std::vector<double> values;
};

/// Where the samples lie. All arrays have one entry per sample; those that the model does not use may be empty.
struct Places {
  std::span<const Point> positions = {};                           ///< world units; always needed
  std::span<const Point> normals = {};                             ///< unit length
  std::span<const double> k1 = {}, k2 = {};                        ///< principal curvatures, 1 / world unit
  std::map<std::string, std::span<const double>> attributes = {};  ///< vertex attributes of the mesh by name
  double length_unit = 1;                                          ///< world length of one model length unit
  Point origin{};  ///< from where random fields count: a shape takes them along when it is moved
  Point period{};  ///< after which smooth random fields repeat along x, y and z; 0: never
  std::span<const DrawnField> drawn = {};  ///< random fields that places which move carry along; others are drawn where
                                           ///< the places are
  std::span<const double> mask = {};       ///< of the stage
  std::optional<Box> box = {};             ///< of the shape, where the places are only a part of it
};

/// Species values: u[s][i] is the concentration of species s at sample i.
using SpeciesValues = std::span<const double* const>;
using SpeciesOutput = std::span<double* const>;

/// Sub-expressions that depend on the place alone are evaluated once, here. The methods are thread-safe; they
/// read u[s][i] and write out[s][i] for begin <= i < end, which must not overlap. The reaction sees
/// concentrations clamped to the bounds of the model: with b >= 0, rates use max(b, 0).
class Kinetics {
 public:
  /// What is known: everything, or diffusion(), tensors(), fluxes() and anisotropy() alone.
  enum class Parts { all, diffusion };

  /// Copies what it needs from `places`. Error(usage), located in the model, if the model uses normals,
  /// curvatures or an attribute that the places do not have.
  Kinetics(const Model& model, const Places& places, std::uint64_t seed, Parts parts = Parts::all);

  std::size_t size() const { return size_; }
  std::size_t species_count() const { return species_count_; }
  /// What rates(), split() and jacobian() read at every sample: the species, then Equations::gradients [1 / model
  /// length unit^2].
  std::size_t input_count() const { return species_count_ + gradient_count_; }

  /// R of every species.
  void rates(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const;
  /// A function of the species in single precision, for `count` samples from number `first` on, to which u[s][0] and
  /// out[s][0] belong. Lives no longer than the kinetics.
  using FloatFunction = std::function<void(std::span<const float* const> u, std::size_t first, std::size_t count,
                                           std::span<float* const> out)>;
  /// rates() and jacobian() at a time.
  FloatFunction float_rates(double t) const { return float_function(rates_, t); }
  FloatFunction float_jacobian(double t) const { return float_function(jacobian_, t); }
  /// C2 and C3 of every species: R = C2 u + C3 with u clamped.
  void split(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput c2, SpeciesOutput c3) const;
  /// dR_i / du_j at out[i * species_count() + j], at the clamped concentrations.
  void jacobian(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const;
  /// C0 and C1 of every species (C0 = 1 where C0 is constant: then C1 holds the product).
  void diffusion(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput c0,
                 SpeciesOutput c1) const;
  /// C1 of the species where it is a tensor: six outputs for each of these, as TensorSource.
  void tensors(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const;
  /// The coefficients of Equations::fluxes.
  void fluxes(SpeciesValues u, double t, std::size_t begin, std::size_t end, SpeciesOutput out) const;
  /// Diffusion tensor of an anisotropic species (react/model.h), one value per sample.
  struct TensorField {
    std::vector<double> theta, a1, a2;
  };
  TensorField anisotropy(std::size_t i) const;

 private:
  friend class KineticsBuilder;
  /// Made when they are first asked for.
  struct FloatFields {
    std::once_flag once;
    std::vector<std::vector<float>> fields;
  };
  /// A tape whose inputs are the species, gradients where it reads them, and then some of `fields_`.
  struct Program {
    Tape tape;
    std::vector<std::size_t> fields;       ///< which of fields_
    std::vector<NodeId> time_expressions;  ///< the tape's scalars: evaluated once per call
    std::shared_ptr<FloatFields> single = std::make_shared<FloatFields>();  ///< the fields in single precision
  };
  void run(const Program& program, SpeciesValues u, double t, std::size_t begin, std::size_t end,
           SpeciesOutput out) const;

  const std::vector<std::vector<float>>& float_fields(const Program& program) const;
  FloatFunction float_function(const Program& program, double t) const;
  void run(const Program& program, std::span<const float> scalars, std::span<const float* const> u, std::size_t first,
           std::size_t count, std::span<float* const> out) const;
  std::vector<double> scalars(const Program& program, double t) const;

  std::size_t size_ = 0, species_count_ = 0, gradient_count_ = 0;
  Graph graph_;
  std::vector<std::vector<double>> fields_;  ///< expressions of the place alone, one value per sample
  std::vector<std::array<std::vector<double>, 3>>
      anisotropy_;  ///< theta, a1, a2: one value per sample, or one for all; empty where isotropic
  Program rates_, split_, jacobian_, diffusion_, tensors_, fluxes_;
};

/// The concentrations of species i at time 0, one value per place, clamped to its bounds.
std::vector<double> initial_values(const Model& model, std::size_t i, const Places& places, std::uint64_t seed);

/// Those that it starts from where concentrations are held; only of species with a pin.
std::vector<double> pinned_values(const Model& model, std::size_t i, const Places& places, std::uint64_t seed);

/// The mask of a model that holds concentrations, one value per place: not 0 where they are held.
std::vector<double> mask_values(const Model& model, const Places& places, std::uint64_t seed);

}  // namespace pelage
