#include "base/parallel.h"

#ifdef PELAGE_HAS_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace pelage {

#ifdef PELAGE_HAS_TBB
void on_all_threads(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t chunk) { body(chunk); });
}
int concurrency() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::max(1, std::min(tbb::info::default_concurrency(), static_cast<int>(allowed)));
}
void run_on_one_thread(const std::function<void()>& body) { tbb::task_arena(1).execute(body); }
ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}
ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }
#else
void on_all_threads(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t chunk = 0; chunk < count; ++chunk) body(chunk);
}
int concurrency() { return 1; }
void run_on_one_thread(const std::function<void()>& body) { body(); }
ThreadLimit::ThreadLimit(int) {}
ThreadLimit::~ThreadLimit() = default;
#endif

}  // namespace pelage
