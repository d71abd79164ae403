#include "base/parallel.h"

#ifdef PELAGE_HAS_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#endif

namespace pelage {

#ifdef PELAGE_HAS_TBB
int concurrency() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::max(1, std::min(tbb::info::default_concurrency(), static_cast<int>(allowed)));
}
ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}
ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }
#else
int concurrency() { return 1; }
ThreadLimit::ThreadLimit(int) {}
ThreadLimit::~ThreadLimit() = default;
#endif

}  // namespace pelage
