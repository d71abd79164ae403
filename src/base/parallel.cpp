#include "base/parallel.h"

#ifdef PELAGE_HAS_TBB
#include <tbb/global_control.h>
#endif

namespace pelage {

#ifdef PELAGE_HAS_TBB
ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}
ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }
#else
ThreadLimit::ThreadLimit(int) {}
ThreadLimit::~ThreadLimit() = default;
#endif

}  // namespace pelage
