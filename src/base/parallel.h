#pragma once
// Loops over index ranges whose results do not depend on the number of threads: the range is cut into
// chunks of fixed size, and sums are formed per chunk and then added in the order of the chunks.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace pelage {

/// Number of indices per chunk unless the caller knows better. Large enough that the dispatch
/// (about 1 microsecond) disappears, small enough that a chunk of doubles stays in the L1 cache.
inline constexpr std::size_t default_chunk = 2048;

inline std::size_t chunk_count(std::size_t n, std::size_t chunk = default_chunk) { return (n + chunk - 1) / chunk; }

/// Calls body(chunk_index) for every chunk index below `count`, in any order, from several threads. When chunks throw,
/// the exception of the lowest one comes out, for any number of threads; chunks that have begun are finished first. All
/// that knows of threads is in parallel.cpp.
void on_all_threads(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same; a single chunk is spared the call through a pointer.
template <class Body>
void parallel_chunks(std::size_t count, Body&& body) {
  if (count > 1)
    on_all_threads(count, std::ref(body));  // by reference: no copy, no allocation
  else if (count == 1)
    body(std::size_t{0});
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
void run_on_one_thread(const std::function<void()>& body);

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
