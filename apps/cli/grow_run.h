#pragma once
// A run on its way to the end, with a bar, Ctrl-C and checkpoints.

#include <chrono>
#include <functional>
#include <string>

#include "checkpoint_file.h"
#include "grow_options.h"
#include "grow_report.h"
#include "interrupt.h"
#include "pelage/error.h"
#include "run/run.h"

namespace pelage {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// work(), with a message for people when it is cancelled.
template <class Work>
auto interruptible(const std::string& when, Work&& work) {
  try {
    if (interrupt_signal()) throw Error(Fault::cancelled, "");
    return work();
  } catch (const Error& error) {
    if (error.fault() != Fault::cancelled) throw;
    throw Error(Fault::cancelled, "interrupted " + when);
  }
}

/// Is told of a run.
using Observer = std::function<void(const Run&)>;

/// To the state of that file, unless the name is empty. Errors of Run::restore and read_checkpoint, with the file.
void restore(Run& run, const std::string& path, GrowReport& report);

/// From the state of options.resume, where one is given, and with --nested from coarser grids.
void set_out(Run& run, const GrowOptions& options, const Progress& progress, GrowReport& report);

/// `each_step` is told of every step, or is empty. Writes checkpoints on the way and at the end. Error(Fault::numerics)
/// when the run fails, Error(Fault::cancelled) after Ctrl-C.
void grow_to_the_end(Run& run, const GrowOptions& options, const Observer& each_step, CheckpointFile& saved,
                     const Progress& progress, GrowReport& report);

}  // namespace pelage
