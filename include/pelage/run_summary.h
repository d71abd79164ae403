#pragma once
// How a run stands.

#include <cstdint>
#include <string>

namespace pelage {

enum class RunStatus {
  running,
  time_reached,
  steps_reached,
  stationary,
  failed  ///< the fields blew up or a solve did not converge; see RunSummary::message
};

/// "running", "time_reached", ...: for programs.
const char* name_of(RunStatus status);

/// What has happened so far in a stage.
struct RunSummary {
  RunStatus status = RunStatus::running;
  std::string message;  ///< of a failure: what, where, and what to do
  double time = 0;      ///< model time
  std::int64_t steps = 0;
  double step = 0;                  ///< size of the next step
  double change = 0;                ///< of the pattern per unit of time, relative to its amplitude
  std::int64_t iterations = 0;      ///< stages, or iterations of the linear solver, since the start or resumption
  double bytes = 0;                 ///< that went between memory and processor in them, at least; 0 where not counted
  std::int64_t rejected = 0;        ///< steps repeated with a smaller size
  std::int64_t solves = 0;          ///< linear systems of these steps
  std::int64_t indefinite = 0;      ///< of these, matrices that were not positive definite, as of steps too large
  double solve_seconds = 0;         ///< that they took
  double minimum = 0, maximum = 0;  ///< of the coefficients of all species
};

}  // namespace pelage
