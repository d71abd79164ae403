#include "io/texture_reader.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

#include <fstream>

#include "base/srgb.h"
#include "io/glb_builder.h"
#include "io/written_meshes.h"
#include "pelage/error.h"
#include "pelage/io.h"

namespace pelage {
namespace {

using namespace std::string_literals;

/// The path of a new file.
std::string file_of(const std::string& bytes, const std::string& name = "image.png") {
  const std::string path = (test::fresh_folder() / name).string();
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string error_of(const std::string& path, void (*read)(const std::string&)) {
  try {
    read(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_EQ(error.where().file, path);
    return error.what();
  }
  return "";
}

std::string error_of(const std::string& path) {
  return error_of(path, [](const std::string& p) { read_texture(p); });
}

std::string picture() {
  Image image{7, 5, {}};
  for (int i = 0; i < 3 * 7 * 5; ++i) image.rgb.push_back(static_cast<float>(i) / 105);
  const std::string path = (test::fresh_folder() / "a.png").string();
  write_png(image, path);
  return path;
}

/// A glTF file whose materials have so many images, all of these bytes and inside of it.
std::string gltf_with(const std::string& image, int count) {
  test::GlbBuilder file;
  file.array("VEC3", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string view = std::to_string(file.view(image));
  std::string images, textures, materials;
  for (int i = 0; i < count; ++i) {
    const std::string comma = i ? "," : "", number = std::to_string(i);
    images += comma + R"({"mimeType":"image/png","bufferView":)" + view + "}";
    textures += comma + R"({"source":)" + number + "}";
    materials += comma + R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + number + "}}}";
  }
  const std::string members =
      count ? R"(,"images":[)" + images + R"(],"textures":[)" + textures + R"(],"materials":[)" + materials + "]" : "";
  return file_of(
      file.file(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])" + members),
      "a.glb");
}

TEST(TextureReader, TakesTheBaseColourOfAGltfFile) {
  const std::string path = picture();
  const Texture texture = read_texture(path), inside = read_texture(gltf_with(bytes_of(path), 1));
  EXPECT_EQ(inside.width, 7);
  EXPECT_EQ(*inside.rgb, *texture.rgb);
  EXPECT_NE(error_of(gltf_with(bytes_of(path), 0)).find("has no image of a base colour"), std::string::npos);
  EXPECT_NE(error_of(gltf_with(bytes_of(path), 2)).find("has 2 images of base colours"), std::string::npos);
  EXPECT_NE(error_of(gltf_with("nonsense", 1)).find("is no PNG or JPEG image"), std::string::npos);
}

TEST(TextureReader, ReadsStoredValuesTopRowFirst) {
  const std::string path = picture();
  const Texture texture = read_texture(path);
  EXPECT_EQ(texture.width, 7);
  EXPECT_EQ(texture.height, 5);
  ASSERT_EQ(texture.rgb->size(), 105);
  for (std::size_t i = 0; i < 105; ++i)
    EXPECT_EQ((*texture.rgb)[i], 257 * srgb_byte(static_cast<float>(i) / 105)) << i;  // 255 * 257 is 65535
  EXPECT_EQ(error_of(path, check_texture), "");
}

TEST(TextureReader, KeepsSixteenBitsOfGrey) {
  const std::string path = file_of(
      "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x10\0\0\0\0\x81\xd9\xfc\x15\0\0\0\x0dIDAT"
      "\x78\x9c\x63\x10\x32\xf9\x77\x07\x00\x03\xc1\x02\x21\x0d\xe3\x47\x32\0\0\0\0IEND\xae\x42\x60\x82"s);
  const Texture texture = read_texture(path);
  EXPECT_EQ(texture.width, 2);
  EXPECT_EQ(*texture.rgb, (std::vector<std::uint16_t>{0x1234, 0x1234, 0x1234, 0xfedc, 0xfedc, 0xfedc}));
}

TEST(TextureReader, ReadsJpeg) {
  const std::vector<std::uint8_t> pixels(3 * 16 * 16, 100);
  const std::string path = (test::fresh_folder() / "a.jpg").string();
  ASSERT_TRUE(stbi_write_jpg(path.c_str(), 16, 16, 3, pixels.data(), 95));
  const Texture texture = read_texture(path);
  EXPECT_EQ(texture.width, 16);
  for (const std::uint16_t v : *texture.rgb) EXPECT_NEAR(v / 257.0, 100, 2);
  const std::string whole = bytes_of(path);
  for (const std::size_t size : {whole.size() - 2, whole.size() - 20, whole.size() / 2, std::size_t{30}})
    EXPECT_NE(error_of(file_of(whole.substr(0, size))), "") << size;
}

TEST(TextureReader, RefusesTablesWithTooManySymbols) {
  const std::vector<std::uint8_t> pixels(3 * 16 * 16, 100);
  const std::string path = (test::fresh_folder() / "a.jpg").string();
  ASSERT_TRUE(stbi_write_jpg(path.c_str(), 16, 16, 3, pixels.data(), 95));
  std::string bytes = bytes_of(path);
  const std::size_t table = bytes.find("\xff\xc4") + 4;
  bytes[table + 15] = bytes[table + 16] = '\xff';
  EXPECT_NE(error_of(file_of(bytes, "b.jpg")).find("Huffman"), std::string::npos);
}

TEST(TextureReader, RefusesWhatEndsEarly) {
  const std::string whole = bytes_of(picture());
  for (std::size_t size = 1; size < whole.size() - 4; size += 3)  // the check sum of the end
    EXPECT_NE(error_of(file_of(whole.substr(0, size))), "") << size;
}

TEST(TextureReader, RefusesPartsThatReachBeyondTheFile) {
  std::string bytes = bytes_of(picture());
  bytes[bytes.find("IDAT") - 4] = '\x40';  // the highest byte of its length: a gigabyte
  EXPECT_NE(error_of(file_of(bytes)).find("cut short"), std::string::npos);
}

TEST(TextureReader, EverythingThatPacksWellIsRead) {
  const int side = 1500;
  for (const int channels : {1, 3, 4}) {
    const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(channels) * side * side, 200);
    const std::string path = (test::fresh_folder() / "even.png").string();
    ASSERT_TRUE(stbi_write_png(path.c_str(), side, side, channels, pixels.data(), channels * side));
    EXPECT_EQ(read_texture(path).width, side);
  }
  const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(side) * side, 200);
  const std::string path = (test::fresh_folder() / "even.jpg").string();
  ASSERT_TRUE(stbi_write_jpg(path.c_str(), side, side, 1, pixels.data(), 5));
  EXPECT_EQ(read_texture(path).width, side);
}

TEST(TextureReader, RefusesWhatIsNoImage) {
  EXPECT_NE(error_of("no-such-image.png").find("cannot be opened"), std::string::npos);
  EXPECT_NE(error_of(file_of("GIF89a\1\0\1\0\0\0\0;"s)).find("no PNG or JPEG image"), std::string::npos);
  EXPECT_NE(error_of(file_of("v 0 0 0\n"), check_texture).find("no PNG or JPEG image"), std::string::npos);
}

TEST(TextureReader, TheHeaderAloneReservesNoMemory) {
  const auto read = [](const std::string& path) { read_texture(path); };
  std::string bytes = bytes_of(picture());
  bytes.replace(16, 8, "\0\0\x40\0\0\0\x40\0"s);
  EXPECT_NE(error_of(file_of(bytes), check_texture).find("cannot hold its 16384 x 16384 pixels"), std::string::npos);
  bytes.replace(16, 8, "\0\0\x42\x68\0\0\x42\x68"s);
  EXPECT_NE(error_of(file_of(bytes), read).find("17000 x 17000 pixels"), std::string::npos);
  EXPECT_NE(error_of(file_of(bytes), check_texture).find("17000 x 17000 pixels"), std::string::npos);
  bytes.replace(16, 8, "\0\xff\xff\xff\0\xff\xff\xff"s);
  EXPECT_NE(error_of(file_of(bytes), read).find("16777215 x 16777215 pixels"), std::string::npos);
}

}  // namespace
}  // namespace pelage
