#include "base/parallel.h"

#ifdef PELAGE_HAS_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#endif
#ifdef PELAGE_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace pelage {

#ifdef PELAGE_HAS_TBB
namespace {

/// The exception of the lowest chunk that fails. It is kept from TBB, which would report any one and cut loops inside
/// the other chunks short without a word to them.
class FirstFailure {
 public:
  void run(std::size_t chunk, const std::function<void(std::size_t)>& body) {
    if (chunk > chunk_) return;
    try {
      body(chunk);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (chunk > chunk_) return;
      chunk_ = chunk;
      exception_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<std::size_t> chunk_ = std::numeric_limits<std::size_t>::max();
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// What happens before a loop happens before each of its chunks, and those before what follows the loop. TBB sees to
/// it, but not under the eyes of ThreadSanitizer, which has to be told (preset "tsan"). Chunks have no order.
class Order {
 public:
#ifdef PELAGE_TSAN
  Order() { __tsan_release(&begun_); }
  void begin_chunk() { __tsan_acquire(&begun_); }
  void end_chunk() { __tsan_release(&ended_); }
  void end() { __tsan_acquire(&ended_); }

 private:
  char begun_ = 0, ended_ = 0;
#else
  void begin_chunk() {}
  void end_chunk() {}
  void end() {}
#endif
};

}  // namespace

void on_all_threads(std::size_t count, const std::function<void(std::size_t)>& body) {
  FirstFailure failure;
  Order order;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t chunk) {
    order.begin_chunk();
    failure.run(chunk, body);
    order.end_chunk();
  });
  order.end();
  failure.rethrow();
}
int concurrency() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::max(1, std::min(tbb::info::default_concurrency(), static_cast<int>(allowed)));
}
void run_on_one_thread(const std::function<void()>& body) {
  Order order;
  tbb::task_arena(1).execute([&] {
    order.begin_chunk();
    body();
    order.end_chunk();
  });
  order.end();
}
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
