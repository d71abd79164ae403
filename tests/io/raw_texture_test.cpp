#include "io/raw_texture.h"

#include <gtest/gtest.h>

#include "base/srgb.h"
#include "pelage/error.h"

namespace pelage {
namespace {

TEST(RawTexture, IsFourBytesForEachNode) {
  Grid block;
  block.count = {2, 3, 2};
  Attribute color{"color", 3, Domain::vertex, {}};
  for (int i = 0; i < 36; ++i) color.values.push_back(linear_from_srgb(i * 7 / 255.0));
  block.set(color);
  block.set({"inside", 1, Domain::vertex, {1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1}, NumberType::uint8});
  const std::string bytes = raw_texture_bytes(block);
  ASSERT_EQ(bytes.size(), 48U);
  for (std::size_t v = 0; v < 12; ++v) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(static_cast<unsigned char>(bytes[4 * v + k]), 7 * (3 * v + k));
    EXPECT_EQ(static_cast<unsigned char>(bytes[4 * v + 3]), v == 5 ? 0 : 255);
  }
  EXPECT_EQ(raw_texture_form(block).substr(0, 16), "2 x 3 x 2 texels");
  block.attributes.clear();
  EXPECT_THROW(raw_texture_bytes(block), Error);
  Grid sheet;
  sheet.count = {2, 2, 1};
  sheet.set({"color", 3, Domain::vertex, std::vector<double>(12)});
  EXPECT_THROW(raw_texture_bytes(sheet), Error);
}

}  // namespace
}  // namespace pelage
