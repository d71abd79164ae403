#include "io/exr_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "base/random.h"
#include "io/written_meshes.h"
#include "io/zlib.h"
#include "pelage/error.h"

namespace pelage {
namespace {

/// A reader of what the format's description says of single parts of scan lines with ZIP and floats.
class ExrFile {
 public:
  explicit ExrFile(std::string bytes) : bytes_(std::move(bytes)) {
    EXPECT_EQ(number<std::int32_t>(), 20000630);
    version = number<std::int32_t>();
    while (bytes_[at_] != 0) {
      const std::string name = text(), type = text();
      const auto size = static_cast<std::size_t>(number<std::int32_t>());
      attributes[name] = {type, bytes_.substr(at_, size)};
      at_ += size;
    }
    ++at_;
    read_channels(attributes.at("channels").second);
    std::memcpy(window, attributes.at("dataWindow").second.data(), sizeof window);
    read_blocks();
  }

  std::map<std::string, std::pair<std::string, std::string>> attributes;
  std::map<std::string, std::vector<float>> planes;
  std::int32_t version = 0, window[4] = {};
  int stored = 0;  ///< blocks that are not packed

 private:
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string text() {
    const std::string value = bytes_.c_str() + at_;
    at_ += value.size() + 1;
    return value;
  }

  void read_channels(const std::string& list) {
    for (std::size_t at = 0; list[at] != 0;) {
      names_.emplace_back(list.c_str() + at);
      at += names_.back().size() + 1;
      EXPECT_EQ(list.substr(at, 16), std::string("\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 16));
      at += 16;
    }
  }

  void read_blocks() {
    const std::size_t width = window[2] + 1, rows = window[3] + 1, blocks = (rows + 15) / 16;
    std::vector<std::uint64_t> places;
    for (std::size_t b = 0; b < blocks; ++b) places.push_back(number<std::uint64_t>());
    for (std::size_t b = 0; b < blocks; ++b) {
      EXPECT_EQ(at_, places[b]);
      EXPECT_EQ(number<std::int32_t>(), static_cast<std::int32_t>(16 * b));
      const auto size = static_cast<std::size_t>(number<std::int32_t>());
      const std::size_t lines = std::min<std::size_t>(16, rows - 16 * b), raw = lines * names_.size() * width * 4;
      const std::string block = unpacked(bytes_.substr(at_, size), raw);
      at_ += size;
      std::size_t from = 0;
      for (std::size_t y = 0; y < lines; ++y)
        for (const std::string& name : names_)
          for (std::size_t x = 0; x < width; ++x, from += 4) {
            float value = 0;
            std::memcpy(&value, block.data() + from, 4);
            planes[name].push_back(value);
          }
    }
    EXPECT_EQ(at_, bytes_.size());
  }

  std::string unpacked(const std::string& block, std::size_t size) {
    if (block.size() == size) {
      ++stored;
      return block;
    }
    std::string t = zlib_unpacked(block, size).value(), out;
    for (std::size_t i = 1; i < size; ++i) t[i] = static_cast<char>(t[i - 1] + t[i] - 128);
    for (std::size_t i = 0; i < size; ++i) out += t[i % 2 == 0 ? i / 2 : (size + 1) / 2 + i / 2];
    return out;
  }

  std::string bytes_;
  std::size_t at_ = 0;
  std::vector<std::string> names_;
};

TEST(ExrWriter, EveryBitComesBack) {
  constexpr int width = 37, height = 35;
  const std::vector<std::string> names = {"v", "R", "a", "stage.u", "G", "B"};
  std::vector<std::vector<float>> planes(names.size(), std::vector<float>(width * height));
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (std::size_t i = 0; i < planes[k].size(); ++i)
      planes[k][i] = k % 2 == 0 ? std::sin(0.01F * static_cast<float>(i)) : static_cast<float>(uniform(k, i) * 1e30);
  const ExrFile file(exr_bytes(names, planes, width, height));
  EXPECT_EQ(file.version, 2);
  EXPECT_EQ(file.window[2], width - 1);
  EXPECT_EQ(file.window[3], height - 1);
  EXPECT_EQ(file.planes.size(), names.size());
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(file.planes.at(names[k]), planes[k]) << names[k];
  for (const char* needed : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "pixelAspectRatio",
                             "screenWindowCenter", "screenWindowWidth"})
    EXPECT_EQ(file.attributes.count(needed), 1U) << needed;
}

TEST(ExrWriter, BlocksThatDoNotShrinkAreStored) {
  std::vector<float> plane;
  for (std::uint64_t i = 0; i < 8 * 20; ++i) {
    const auto bits = static_cast<std::uint32_t>(uniform(3, i) * 0x7f000000);
    plane.push_back(std::bit_cast<float>(bits));
  }
  const ExrFile file(exr_bytes({std::string(40, 'n')}, {plane}, 8, 20));
  EXPECT_EQ(file.version, 0x402);  // long names
  EXPECT_EQ(file.planes.at(std::string(40, 'n')), plane);
  EXPECT_GT(file.stored, 0);
}

TEST(ExrWriter, RefusesWhatReadersCouldNotTake) {
  const std::string path = (test::fresh_folder() / "a.exr").string();
  EXPECT_THROW(write_exr(path, {"u"}, {{NAN}}, 1, 1), Error);
  EXPECT_THROW(write_exr(path, {""}, {{1}}, 1, 1), Error);
  EXPECT_THROW(write_exr(path, {"u", "u"}, {{1}, {1}}, 1, 1), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
  write_exr(path, {"u"}, {{1}}, 1, 1);
  EXPECT_TRUE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace pelage
