// Texts that the fuzzer found worth keeping, and hand-made monsters: each is a model or a fault with a message.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fuzz/read_model.h"

namespace pelage {
namespace {

TEST(ModelCorpus, EveryTextIsReadOrRefused) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PELAGE_SOURCE_DIR "/tests/fuzz/corpus")) {
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_NO_THROW(read_and_use_model(text.str())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace pelage
