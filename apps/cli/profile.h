#pragma once
// Where the time of a command went: measured between reports of progress.

#include <chrono>
#include <string>
#include <vector>

#include "command.h"
#include "pelage/progress.h"

namespace pelage {

/// Bytes per second of a = b + 3 c on all threads, over arrays that no cache holds.
double triad_speed();

class Profile {
 public:
  struct Phase {
    std::string name;  ///< the task without the file it is about
    double seconds = 0;
  };

  /// Passes reports on and measures. The profile has to outlive it.
  Progress measured(Progress progress);
  /// In the order in which they began; the last one ends now.
  const std::vector<Phase>& phases();

 private:
  using Clock = std::chrono::steady_clock;
  void begin(std::string_view task);

  std::vector<Phase> phases_;
  std::size_t now_ = 0;
  Clock::time_point began_;
};

}  // namespace pelage
