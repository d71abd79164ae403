#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

namespace pelage {
namespace {

/// The first chunk to fail comes last in time.
TEST(Parallel, TheFailureOfTheLowestChunkComesOut) {
  for (int repetition = 0; repetition < 20; ++repetition) try {
      parallel_chunks(64, [](std::size_t c) {
        if (c == 3) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (c >= 3) throw std::runtime_error(std::to_string(c));
      });
      FAIL() << "no exception came out";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
}

/// One that had begun before and fails afterwards; as far as there are two threads.
TEST(Parallel, AHigherChunkThatFailsLaterDoesNot) {
  using std::chrono::milliseconds;
  const auto wait_for = [](const std::atomic<bool>& what) {
    for (int k = 0; k < 20 && !what; ++k) std::this_thread::sleep_for(milliseconds(1));
  };
  for (int repetition = 0; repetition < 5; ++repetition) {
    std::atomic<bool> begun = false, failed = false;
    try {
      parallel_chunks(2, [&](std::size_t c) {
        if (c == 0) {
          wait_for(begun);
          failed = true;
        } else {
          begun = true;
          wait_for(failed);
          std::this_thread::sleep_for(milliseconds(2));
        }
        throw std::runtime_error(std::to_string(c));
      });
      FAIL() << "no exception came out";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "0");
    }
  }
}

/// A loop inside a chunk is whole or not begun, even if another chunk fails meanwhile.
TEST(Parallel, AFailureCutsNoOtherChunkShort) {
  std::atomic<int> begun = 0, whole = 0;
  EXPECT_THROW(parallel_chunks(64,
                               [&](std::size_t c) {
                                 if (c % 8 == 7) throw std::runtime_error("fails");
                                 ++begun;
                                 std::atomic<std::size_t> sum = 0;
                                 const auto slowly = [&](std::size_t from, std::size_t to) {
                                   std::this_thread::sleep_for(std::chrono::microseconds(20));
                                   sum += to - from;
                                 };
                                 parallel_for(100, slowly, 1);
                                 whole += sum == 100;
                               }),
               std::runtime_error);
  EXPECT_GT(begun, 0);
  EXPECT_EQ(whole, begun);
}

}  // namespace
}  // namespace pelage
