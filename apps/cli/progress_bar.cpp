#include "progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "interrupt.h"
#include "text.h"

namespace pelage {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds between_drawings(0.1);
/// The speed is measured over about this time: steps grow while a pattern settles, and the estimate must follow.
constexpr double memory = 4;
/// Earlier than this after its begin the time left of a task is a guess.
constexpr Seconds before_first_estimate(1);
constexpr int bar_length = 30;

std::size_t terminal_width() {
  winsize size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string percent(double fraction) { return std::to_string(static_cast<int>(std::floor(100 * fraction))) + " %"; }

}  // namespace

ProgressBar::Style ProgressBar::style_of_stderr() {
  const char* terminal = std::getenv("TERM");
  const bool redraws = isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
  return redraws ? Style::bar : Style::lines;
}

Progress ProgressBar::progress() {
  return [this](std::string_view task, double fraction) {
    show(task, fraction);
    return interrupt_signal() == 0;
  };
}

void ProgressBar::begin(std::string_view task, double fraction) {
  task_ = task;
  began_ = measured_ = Clock::now();
  drawn_ = {};
  measured_fraction_ = fraction;
  speed_ = 0;
  tenths_ = static_cast<int>(10 * fraction);
  if (style_ == Style::lines) std::fprintf(stderr, "pelage: %s\n", task_.c_str());
}

void ProgressBar::show(std::string_view task, double fraction) {
  if (style_ == Style::none) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (task != task_) begin(task, fraction);
  measure(fraction);
  if (style_ == Style::lines)
    print_line(fraction);
  else if (Clock::now() - drawn_ >= between_drawings)
    draw(fraction);
}

void ProgressBar::measure(double fraction) {
  const auto now = Clock::now();
  const double passed = Seconds(now - measured_).count(), advanced = fraction - measured_fraction_;
  if (passed < between_drawings.count() || advanced <= 0) return;
  const double weight = speed_ > 0 ? 1 - std::exp(-passed / memory) : 1;
  speed_ += weight * (advanced / passed - speed_);
  measured_ = now;
  measured_fraction_ = fraction;
}

std::string ProgressBar::time_left(double fraction) const {
  if (speed_ <= 0 || Clock::now() - began_ < before_first_estimate) return "";
  return duration((1 - fraction) / speed_) + " left";
}

void ProgressBar::draw(double fraction) {
  const auto full = static_cast<std::size_t>(fraction * bar_length);
  std::string line = task_ + " [" + std::string(full, '#') + std::string(bar_length - full, '-') + "] " +
                     percent(fraction) + "  " + time_left(fraction);
  line.resize(std::min(line.size(), terminal_width() - 1));
  std::fprintf(stderr, "\r%s\033[K", line.c_str());
  std::fflush(stderr);
  drawn_ = Clock::now();
  visible_ = true;
}

void ProgressBar::print_line(double fraction) {
  const int tenths = static_cast<int>(10 * fraction);
  if (tenths <= tenths_ || tenths >= 10) return;
  tenths_ = tenths;
  const std::string left = time_left(fraction);
  std::fprintf(stderr, "pelage: %s %s%s%s\n", task_.c_str(), percent(fraction).c_str(), left.empty() ? "" : ", ",
               left.c_str());
}

void ProgressBar::clear() {
  if (visible_) std::fprintf(stderr, "\r\033[K");
  visible_ = false;
}

}  // namespace pelage
