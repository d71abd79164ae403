#pragma once
// Exponential time differencing on any space, with functions of the diffusion by Chebyshev series.

#include "time/chebyshev_series.h"
#include "time/lattice_step.h"

namespace pelage {

/// The scheme of time/etd.cpp for systems with matrices. With f = du/dt = L u + N(u), e^(hL) u + h phi_1 N(u) is
/// u + h phi_1 f, so that three sums over the powers of an operator make a step:
///   a  = u + h/2 phi_1(hL/2) f                                   b = e + 2 h phi_1 (N(a) - N(u))
///   e  = u + h phi_1 f           u' = e + 4h (phi_2 - 2 phi_3) (N(a) - N(u)) + h (4 phi_3 - phi_2) (N(b) - N(u))
/// Fluxes are part of N. Series are as exact as linear solves are asked to be.
class EtdBySeries {
 public:
  StepReport step(const System& system, State& state, const StepRequest& request);

 private:
  /// Functions of the linear part L = c - B in a step, as series in B.
  struct Functions {
    double dt = 0, c = 0, end = -1;
    ChebyshevSeries half_phi1, phi1, twice_phi1, second, third;

    void update(double step, double linear, double radius);
  };
  struct SpeciesWork {
    DiffusionOperator diffusion;
    Functions functions;
    Vector rest, end, error;  ///< N(u), what becomes u', and its error
    double tolerance = 0;     ///< of series
  };
  bool take_step(const System& system, const State& state, const StepRequest& request, StepReport& report);
  void find_rest(const System& system, const std::vector<Vector>& stage, double t);
  bool add(SpeciesWork& work, const Vector& v, std::initializer_list<SeriesSum> sums, StepReport& report);

  LinearParts parts_;
  std::vector<std::size_t> evolving_;
  std::vector<SpeciesWork> work_;
  std::vector<Vector> rest_, next_;  ///< N at a stage, as coefficients; the stages
  Vector slope_, rate_;
};

}  // namespace pelage
