#include "profile.h"

#include <algorithm>

#include "base/parallel.h"

namespace pelage {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

double triad_speed() {
  constexpr std::size_t size = 1 << 24;
  constexpr int rounds = 4;
  std::vector<float> a(size), b(size, 1), c(size, 2);
  double best = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    parallel_for(size, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) a[i] = b[i] + 3 * c[i];
    });
    best = std::max(best, 3.0 * sizeof(float) * size / seconds_since(begin));
  }
  return best;
}

Progress Profile::measured(Progress progress) {
  return [this, progress = std::move(progress)](std::string_view task, double fraction) {
    begin(task);
    return progress(task, fraction);
  };
}

void Profile::begin(std::string_view task) {
  const std::string name(task.substr(0, task.find(' ')));
  if (!phases_.empty() && phases_[now_].name == name) return;
  if (!phases_.empty()) phases_[now_].seconds += seconds_since(began_);
  now_ = static_cast<std::size_t>(std::ranges::find(phases_, name, &Phase::name) - phases_.begin());
  if (now_ == phases_.size()) phases_.push_back({name});
  began_ = Clock::now();
}

const std::vector<Profile::Phase>& Profile::phases() {
  if (!phases_.empty()) phases_[now_].seconds += seconds_since(began_);
  began_ = Clock::now();
  return phases_;
}

}  // namespace pelage
