#pragma once
// Progress of independent jobs that run on several threads at once.

#include <mutex>
#include <string>
#include <vector>

#include "pelage/progress.h"

namespace pelage {

/// Sums up what the jobs report and passes it on, one call at a time. Once the caller has asked to stop, every job is
/// told so.
class JobProgress {
 public:
  JobProgress(const Progress& progress, std::string task, std::size_t jobs)
      : progress_(progress), task_(std::move(task)), fraction_(jobs, 0.0) {}

  /// That `job` is done to a fraction in [0, 1]; false asks it to stop. From any thread.
  bool report(std::size_t job, double fraction) {
    const std::lock_guard lock(mutex_);
    fraction_[job] = fraction;
    double sum = 0;
    for (const double f : fraction_) sum += f;
    if (progress_ && !cancelled_) cancelled_ = !progress_(task_, sum / static_cast<double>(fraction_.size()));
    return !cancelled_;
  }
  bool cancelled() {
    const std::lock_guard lock(mutex_);
    return cancelled_;
  }

 private:
  std::mutex mutex_;
  const Progress& progress_;
  const std::string task_;
  std::vector<double> fraction_;
  bool cancelled_ = false;
};

}  // namespace pelage
