#include "io/png_writer.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "pelage/io.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop

#include "base/parallel.h"
#include "base/srgb.h"
#include "io/written_meshes.h"
#include "pelage/error.h"

namespace pelage {
namespace {

TEST(PngWriter, ReadsBackAsSrgbTopRowFirst) {
  Image image{7, 5, {}};
  for (int i = 0; i < 3 * 7 * 5; ++i) image.rgb.push_back(static_cast<float>(i) / 100 - 0.02F);
  const std::string path = (test::fresh_folder() / "a.png").string();
  write_png(image, path);
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load(path.c_str(), &width, &height, &channels, 0);
  ASSERT_NE(pixels, nullptr);
  EXPECT_EQ(width, 7);
  EXPECT_EQ(height, 5);
  ASSERT_EQ(channels, 3);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) EXPECT_EQ(pixels[i], srgb_byte(image.rgb[i])) << i;
  stbi_image_free(pixels);
}

TEST(PngWriter, RowsAndBitsAreTheSameForAnyNumberOfThreads) {
  Image image{300, 200, std::vector<float>(3 * 300 * 200)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<float>(i * 7919 % 1009) / 1009;  // hard to compress, no row like another
  std::string one;
  {
    const ThreadLimit limit(1);
    one = png_bytes(image);
  }
  EXPECT_EQ(one, png_bytes(image));
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(one.data()), static_cast<int>(one.size()),
                                          &width, &height, &channels, 0);
  ASSERT_NE(pixels, nullptr);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) ASSERT_EQ(pixels[i], srgb_byte(image.rgb[i])) << i;
  stbi_image_free(pixels);
}

/// All values of 16 bits, read by stb as they are stored.
TEST(PngWriter, SixteenBitsComeBack) {
  std::vector<std::uint16_t> grey;
  Image image{256, 256, {}};
  for (std::size_t i = 0; i < 65536; ++i) {
    grey.push_back(static_cast<std::uint16_t>(i));
    for (const std::size_t k : {i, 65535 - i, i * 40503 % 65536})
      image.rgb.push_back(static_cast<float>(linear_from_srgb(static_cast<double>(k) / 65535)));
  }
  const auto read = [](const std::string& png, int wanted) {
    int width = 0, height = 0, channels = 0;
    const auto* data = reinterpret_cast<const stbi_uc*>(png.data());
    EXPECT_TRUE(stbi_is_16_bit_from_memory(data, static_cast<int>(png.size())));
    const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
        stbi_load_16_from_memory(data, static_cast<int>(png.size()), &width, &height, &channels, 0), stbi_image_free);
    EXPECT_EQ(channels, wanted);
    return std::vector<std::uint16_t>(pixels.get(), pixels.get() + std::size_t{65536} * channels);
  };
  EXPECT_EQ(read(grey_png_bytes(256, 256, grey), 1), grey);
  const std::vector<std::uint16_t> rgb = read(deep_png_bytes(image), 3);
  for (std::size_t i = 0; i < 65536; ++i) {
    ASSERT_EQ(rgb[3 * i], i);
    ASSERT_EQ(rgb[3 * i + 1], 65535 - i);
    ASSERT_EQ(rgb[3 * i + 2], i * 40503 % 65536);
  }
}

TEST(PngWriter, RefusesWhatIsNotANumber) {
  const std::string path = (test::fresh_folder() / "a.png").string();
  EXPECT_THROW(write_png({1, 1, {0, NAN, 0}}, path), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
}

/// A picture of the largest size is not written here; the limit is the length of a chunk.
TEST(PngWriter, SizesAreCheckedFirst) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1024, 1024}, {16384, 16384}, {21000, 21000}, {65536, 7000}})
    EXPECT_NO_THROW(check_picture_size(width, height, "a.png")) << width;
  for (const auto& [width, height] : {std::pair{32768, 32768}, {26754, 26754}, {131096, 32768}, {65536, 8000}}) try {
      check_picture_size(width, height, "a.png");
      FAIL() << "no error for " << width;
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::usage);
      EXPECT_NE(std::string(error.what()).find("at most 466 million pixels"), std::string::npos) << error.what();
    }
  EXPECT_THROW(write_png(Image{40000, 40000, {}}, "a.png"), Error);
}

TEST(PngWriter, PathIsCheckedFirst) {
  EXPECT_NO_THROW(check_picture_path("a.PNG"));
  EXPECT_THROW(check_picture_path("a.jpg"), Error);
  EXPECT_THROW(check_picture_path("no/such/folder/a.png"), Error);
}

}  // namespace
}  // namespace pelage
