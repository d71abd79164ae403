#pragma once
// Systems on a lattice whose values at the nodes are unknowns and samples, without a space.

#include <functional>

#include "time/stepper.h"

namespace pelage {

struct LatticeSystem {
  /// R = c2 u + c3 of all species at one node, from their values there and the time.
  using Split =
      std::function<void(const std::vector<double>& u, double t, std::vector<double>& c2, std::vector<double>& c3)>;

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

  void set_reaction(const Split& split) {
    const auto at_nodes = [split](const FieldPointers& u, double t, std::size_t begin, std::size_t end, auto&& take) {
      std::vector<double> value(u.size()), c2(u.size()), c3(u.size());
      for (std::size_t n = begin; n < end; ++n) {
        for (std::size_t i = 0; i < u.size(); ++i) value[i] = u[i][n];
        std::ranges::fill(c2, 0);
        std::ranges::fill(c3, 0);
        split(value, t, c2, c3);
        for (std::size_t i = 0; i < u.size(); ++i) take(i, n, value[i], c2[i], c3[i]);
      }
    };
    system.reaction.split = [at_nodes](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                       const MutableFieldPointers& c2, const MutableFieldPointers& c3) {
      at_nodes(u, t, begin, end, [&](std::size_t i, std::size_t n, double, double a, double b) {
        c2[i][n] = a;
        c3[i][n] = b;
      });
    };
    system.reaction.rates = [at_nodes](const FieldPointers& u, double t, std::size_t begin, std::size_t end,
                                       const MutableFieldPointers& rate) {
      at_nodes(u, t, begin, end,
               [&](std::size_t i, std::size_t n, double value, double a, double b) { rate[i][n] = a * value + b; });
    };
  }

  Lattice lattice;
  System system;
  State state;
};

}  // namespace pelage
