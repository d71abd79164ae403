#include "base/memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pelage/error.h"

namespace pelage {
namespace {

/// The limit of a test ends with it.
struct Memory : testing::Test {
  ~Memory() override { limit_memory(0); }
};

TEST_F(Memory, BytesAreToldInThousands) {
  EXPECT_EQ(bytes_in_words(999), "999 bytes");
  EXPECT_EQ(bytes_in_words(1000), "1.0 kB");
  EXPECT_EQ(bytes_in_words(999.6e3), "1.0 MB");
  EXPECT_EQ(bytes_in_words(12.3e9), "12 GB");
  EXPECT_EQ(bytes_in_words(4e16), "40000 TB");
}

TEST_F(Memory, WhatIsTakenIsNoLongerLeft) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes memory of its own for each byte";
#endif
  constexpr double limit = 1e12;
  limit_memory(limit);
  const double before = memory_left();
  EXPECT_LT(before, limit);
  const std::vector<char> block(100'000'000, 'x');
  EXPECT_NEAR(memory_left(), before - 1e8, 2e7);
  EXPECT_GT(memory_used_at_most(), 1e8);
}

TEST_F(Memory, MoreThanIsLeftIsRefusedWithFigures) {
  limit_memory(3e9);
  EXPECT_NO_THROW(require_memory(1e9, "this", "do that"));
  try {
    require_memory(4e9, "this", "do that");
    FAIL() << "4 GB of 3 were given";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::numerics);
    EXPECT_STREQ(error.what(), "this needs about 4.0 GB of memory, but it may take 3.0 GB in all; do that");
  }
}

TEST_F(Memory, WithoutALimitTheMachineCounts) {
  std::string limit;
  EXPECT_GT(memory_left(&limit), 0);
  EXPECT_THROW(require_memory(1e18, "this", "do that"), Error);
  EXPECT_FALSE(limit.empty());
}

}  // namespace
}  // namespace pelage
