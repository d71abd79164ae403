#include "time/generalised_step.h"

#include <algorithm>

#include "pelage/error.h"
#include "time/step_support.h"

namespace pelage {

namespace {

void require_positive(const std::vector<double>& c0) {
  if (!std::all_of(c0.begin(), c0.end(), [](double c) { return c > 0; }))
    throw Error(Fault::usage, "C0 must be positive where it varies; a constant C0 may be 0");
}

/// c / C0 at every point; `c` empty stands for 1.
std::vector<double> over_c0(const std::vector<double>& c, const std::vector<double>& c0) {
  if (c0.empty()) return c;
  std::vector<double> result(c0.size());
  for (std::size_t q = 0; q < c0.size(); ++q) result[q] = (c.empty() ? 1 : c[q]) / c0[q];
  return result;
}

}  // namespace

StepReport generalised_step(const Assembler& assembler, const std::vector<Point>& control, const Sampling& sampling,
                            const GeneralisedPde& pde, double dt, Eigen::MatrixXd& u, double solver_tolerance) {
  require_positive(pde.c0);
  const SparseMatrix mass = assembler.mass(control, over_c0({}, pde.c0));
  const SparseMatrix stiffness =
      pde.c1_tensor.empty() ? assembler.stiffness(control, pde.c1) : assembler.stiffness(control, pde.c1_tensor);
  SparseMatrix matrix;
  combine(1, mass, dt * (pde.c0.empty() ? pde.c0_constant : 1), stiffness, matrix);
  if (!pde.c2.empty()) combine(1, matrix, -dt, assembler.mass(control, over_c0(pde.c2, pde.c0)), matrix);
  const std::unique_ptr<LinearSolver> solver = jacobi_gradients.make();
  solver->update(matrix);
  StepReport report;
  Eigen::MatrixXd result = u;
  for (Eigen::Index k = 0; k < u.cols() && report.failure.empty(); ++k) {
    Vector b = mass * Vector(u.col(k));
    if (pde.c3.size() > 0) {
      Vector source = pde.c3.col(k);
      if (!pde.c0.empty()) source.array() /= Eigen::Map<const Vector>(pde.c0.data(), source.size()).array();
      b += dt * load(sampling, source);
    }
    Vector x = result.col(k);
    solve_noted("component " + std::to_string(k), report,
                [&] { return solver->solve(b, x, nullptr, solver_tolerance); });
    result.col(k) = x;
  }
  if (!report.failure.empty()) return report;
  u = result;
  report.accepted = true;
  return report;
}

}  // namespace pelage
