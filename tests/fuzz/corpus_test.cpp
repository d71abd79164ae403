// What the fuzzers found worth keeping, and hand-made monsters: each is read, or is a fault with a message.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>

#include "fuzz/read_input.h"
#include "io/gltf_document.h"

// An input that claims more than it holds shows here: memory is refused as the fuzzer's limit refuses it.
void* operator new(std::size_t size) {
  void* memory = size <= pelage::most_memory ? std::malloc(size > 0 ? size : 1) : nullptr;
  if (!memory) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size > 0 ? size : 1); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace pelage {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

class Corpus : public testing::TestWithParam<InputReader> {};
INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::ValuesIn(input_readers()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Corpus, EveryInputIsReadOrRefused) {
  const std::filesystem::path folder = std::filesystem::path(PELAGE_SOURCE_DIR "/tests/fuzz/corpus") / GetParam().name;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_NO_THROW(GetParam().read(bytes_of(entry.path()))) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0) << "no inputs in " << folder;
}

/// Calls try_with(document) with other things in the place of every value of the document.
template <class Try>
void exchange_values(GltfJson& document, GltfJson& value, Try&& try_with) {
  const GltfJson own = value;
  for (const char* other :
       {"null", "-1", "0.5", "1e300", "4294967295", "18446744073709551615", "[]", "{}", "\"x\"", "true"}) {
    value = GltfJson::parse(other);
    try_with(document);
  }
  value = own;
  if (value.is_structured())
    for (GltfJson& inner : value) exchange_values(document, inner, try_with);
}

TEST(Corpus, EveryValueOfAGltfFileMayBeAnything) {
  GltfJson document = GltfJson::parse(bytes_of(PELAGE_SOURCE_DIR "/tests/fuzz/corpus/gltf/everything.gltf"));
  int count = 0;
  exchange_values(document, document, [&](const GltfJson& changed) {
    EXPECT_NO_THROW(input_reader("gltf").read(changed.dump())) << changed;
    ++count;
  });
  EXPECT_GT(count, 1000);
}

TEST(InputReaders, AreKnownByTheirNames) {
  EXPECT_STREQ(input_reader("ply").name, "ply");
  EXPECT_THROW(input_reader("doc"), std::invalid_argument);
}

}  // namespace
}  // namespace pelage
