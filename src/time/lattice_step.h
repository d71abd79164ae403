#pragma once
// What steppers share that take the linear part of their equations apart,
//   du_i/dt = div T_i grad u_i + c_i u_i + N_i(u, t),   c_i constant,
// most of them on even grids, where every wave spreads and decays exactly.

#include "base/parallel.h"
#include "discretise/lattice_stencil.h"
#include "time/lattice_transform.h"
#include "time/step_support.h"

namespace pelage {

/// Why these steppers cannot grow a system; empty if they can.
std::string why_no_waves(const System& system);

/// The numbers of the species that evolve.
std::vector<std::size_t> evolving_species(const System& system);

/// c_i: where C2 of the split R_i = C2 u_i + C3 is the same at all samples that C2, else 0. N_i = R_i - c_i u_i, at
/// the samples.
class LinearParts {
 public:
  /// Finds c at a state, and N there.
  void split(const System& system, const std::vector<Vector>& now, double t);
  /// N of a later stage with the c found last.
  void evaluate(const System& system, const std::vector<Vector>& stage, double t);
  /// Gives the memory of all back.
  void clear() { *this = {}; }
  double c(std::size_t species) const { return c_[species]; }
  const Vector& rest(std::size_t species) const { return rest_[species]; }

 private:
  const std::vector<Vector>& at_samples(const System& system, const std::vector<Vector>& fields);

  std::vector<double> c_;
  std::vector<Vector> rest_, c2_, samples_;
  std::shared_ptr<const Sampling> sampling_;
  bool nodal_ = false;
};

/// body(wave, number) for all numbers of all waves, from several threads.
template <class Body>
void for_waves(const LatticeTransform<double>& transform, Body&& body) {
  const std::size_t width = transform.width();
  parallel_for(transform.waves(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w)
      for (std::size_t n = w * width; n < (w + 1) * width; ++n) body(w, n);
  });
}

}  // namespace pelage
