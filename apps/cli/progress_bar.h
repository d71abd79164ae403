#pragma once
// Progress of long work on stderr: a bar on a terminal, plain lines in a pipe.

#include <chrono>
#include <string>
#include <string_view>

#include "pelage/progress.h"

namespace pelage {

class ProgressBar {
 public:
  enum class Style {
    none,
    bar,   ///< one line, redrawn in place
    lines  ///< a line for every new task and every tenth of it
  };

  explicit ProgressBar(Style style) : style_(style) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `bar` if stderr is a terminal that can redraw a line, else `lines`.
  static Style style_of_stderr();

  /// For the library's long work: reports here, and asks to stop after Ctrl-C.
  Progress progress();

  void show(std::string_view task, double fraction);
  /// Takes the bar off the screen; to be called before anything else is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void begin(std::string_view task, double fraction);
  void measure(double fraction);
  std::string time_left(double fraction) const;
  void draw(double fraction);
  void print_line(double fraction);

  Style style_;
  std::string task_;
  Clock::time_point began_, measured_, drawn_;
  double measured_fraction_ = 0;
  double speed_ = 0;  ///< fraction per second, smoothed
  int tenths_ = 0;    ///< that were printed
  bool visible_ = false;
};

}  // namespace pelage
