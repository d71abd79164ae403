#pragma once
// Loops over index ranges whose results do not depend on the number of threads: the range is cut into
// chunks of fixed size, and sums are formed per chunk and then added in the order of the chunks.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#ifdef PELAGE_HAS_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace pelage {

/// Number of indices per chunk unless the caller knows better. Large enough that the dispatch
/// (about 1 microsecond) disappears, small enough that a chunk of doubles stays in the L1 cache.
inline constexpr std::size_t default_chunk = 2048;

inline std::size_t chunk_count(std::size_t n, std::size_t chunk = default_chunk) { return (n + chunk - 1) / chunk; }

/// Calls body(chunk_index) for every chunk index below `count`, in any order, from several threads.
template <class Body>
void parallel_chunks(std::size_t count, Body&& body) {
#ifdef PELAGE_HAS_TBB
  if (count > 1) {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t c) { body(c); });
    return;
  }
#endif
  for (std::size_t c = 0; c < count; ++c) body(c);
}

/// Calls body(begin, end) for consecutive sub-ranges that cover [0, n). Iterations must be independent.
template <class Body>
void parallel_for(std::size_t n, Body&& body, std::size_t chunk = default_chunk) {
  parallel_chunks(chunk_count(n, chunk), [&](std::size_t c) { body(c * chunk, std::min(n, (c + 1) * chunk)); });
}

/// Sum of partial(begin, end) over the chunks of [0, n), added in order: the same bits for any thread count.
template <class T, class Partial>
T ordered_sum(std::size_t n, T zero, Partial&& partial, std::size_t chunk = default_chunk) {
  const std::size_t chunks = chunk_count(n, chunk);
  std::vector<T> parts(chunks, zero);
  parallel_chunks(chunks, [&](std::size_t c) { parts[c] = partial(c * chunk, std::min(n, (c + 1) * chunk)); });
  T sum = std::move(zero);
  for (const T& part : parts) sum += part;
  return sum;
}

/// Number of threads that loops may use. Results must not depend on it.
int concurrency();

/// Calls body() so that all parallel work inside runs on one thread: for libraries whose results depend on the
/// number of threads.
template <class Body>
void run_on_one_thread(Body&& body) {
#ifdef PELAGE_HAS_TBB
  tbb::task_arena(1).execute([&] { body(); });
#else
  body();
#endif
}

/// Limits the number of threads for as long as it lives (0: all cores).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_ = nullptr;
};

}  // namespace pelage
