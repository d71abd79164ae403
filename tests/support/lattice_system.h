#pragma once
// Systems on a lattice whose values at the nodes are unknowns and samples, without a space.

#include <functional>

#include "support/split_reaction.h"
#include "time/stepper.h"

namespace pelage {

struct LatticeSystem {
  using Split = SplitAtSample;

  explicit LatticeSystem(const Lattice& of) : lattice(of) {
    auto sampling = std::make_shared<Sampling>();
    sampling->weight = Vector::Ones(static_cast<Eigen::Index>(lattice.nodes()));
    system.lattice = &lattice;
    system.sampling = sampling;
    set_reaction([](const std::vector<double>&, double, std::vector<double>&, std::vector<double>&) {});
  }
  LatticeSystem(const LatticeSystem&) = delete;
  LatticeSystem& operator=(const LatticeSystem&) = delete;

  /// `start`: of the node at i, j, k.
  void add_species(const Eigen::Matrix3d& tensor,
                   const std::function<double(std::size_t, std::size_t, std::size_t)>& start) {
    Species& s = system.species.emplace_back();
    s.name = "u" + std::to_string(system.species.size());
    s.tensor = tensor;
    Vector& u = state.now.emplace_back(static_cast<Eigen::Index>(lattice.nodes()));
    for (std::size_t n = 0; n < lattice.nodes(); ++n)
      u[static_cast<Eigen::Index>(n)] =
          start(n % lattice.count[0], n / lattice.count[0] % lattice.count[1], n / lattice.count[0] / lattice.count[1]);
  }

  void set_reaction(const Split& split) { pelage::set_reaction(system, split); }

  Lattice lattice;
  System system;
  State state;
};

}  // namespace pelage
