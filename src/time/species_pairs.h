#pragma once
// Which species are worked on together, two at a time (time/paired_nodes.h), and the operators of their diffusion.

#include <array>
#include <vector>

#include "time/paired_nodes.h"
#include "time/system.h"

namespace pelage {

/// One species, or two that share a mass and what is held.
struct SpeciesPair {
  std::array<std::size_t, 2> species{};
  std::size_t count = 0;
  std::array<float, 2> diffusion{};     ///< D / a: as the operator has it, a number, so that no unit is in the rounding
  std::vector<SharedMatrix> stiffness;  ///< none where nothing diffuses, one for both species, or one for each
  SharedMatrix mass;
  std::shared_ptr<const Held> held;               ///< null: nothing
  std::array<std::vector<std::size_t>, 2> given;  ///< nodes of either species that System::set_values knows
  bool diffuses = false;                          ///< whether either does
  std::size_t matrix = 0;                         ///< which of the operators, where something diffuses
};

/// The species of a system that do not follow, and what diffuses them:
///   (I + E + ... + E^m) (-L^-1 D K u),   E = I - L^-1 M
/// with m sweeps, or none where M is diagonal. Operators are kept while what they are made of stays.
class SpeciesPairs {
 public:
  /// The loops are of this set.
  SpeciesPairs(InstructionSet instructions, int sweeps);

  /// Whether anything has changed since the last call.
  bool update(const System& system);

  const std::vector<std::size_t>& evolving() const { return evolving_; }  ///< numbers of species
  std::size_t size() const { return pairs_.size(); }
  const SpeciesPair& operator[](std::size_t p) const { return pairs_[p]; }
  std::size_t place(std::size_t species) const { return place_[species]; }  ///< 2 pair + lane
  /// Null where nothing diffuses.
  const SlicedMatrix* matrix(std::size_t p) const {
    return pairs_[p].diffuses ? &operators_[pairs_[p].matrix].sliced : nullptr;
  }
  int sweeps(std::size_t p) const { return matrix(p) && matrix(p)->corrects() ? sweeps_ : 0; }
  /// What the passes of one evaluation of all pairs read and write at least, without the reaction.
  double bytes() const;
  /// The largest eigenvalue of the diffusion of a species, from below [1/time].
  double radius(std::size_t species) const;

 private:
  struct Operator {
    std::vector<SharedMatrix> stiffness;
    SharedMatrix mass;
    std::shared_ptr<const Held> held;
    SlicedMatrix sliced;
    std::array<double, 2> radius{};  ///< of either species, with D = a
  };
  bool unchanged(const System& system) const;
  bool update_lattice(const System& system);
  void note_given(const System& system, SpeciesPair& pair) const;
  void pair_alike(const System& system);
  void pair_rest();
  std::size_t keep_operator(const System& system, const SpeciesPair& pair, std::vector<Operator>& before);
  std::array<double, 2> radius_of(const SlicedMatrix& matrix) const;

  const NodeLoops* loops_;
  int sweeps_;
  std::vector<std::size_t> evolving_;
  std::vector<SpeciesPair> pairs_;
  std::vector<std::size_t> place_;
  std::vector<Operator> operators_;
  std::shared_ptr<const Held> held_;
  std::size_t species_ = 0;
  double area_ = 1;  ///< a: the mean of a node
  Lattice lattice_;  ///< without matrices, and the tensors of all species there
  std::vector<Eigen::Matrix3d> tensors_;
};

}  // namespace pelage
