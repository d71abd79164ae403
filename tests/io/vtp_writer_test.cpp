#include "io/vtp_writer.h"

#include <cstring>

#include "base/srgb.h"
#include "io/vtk_xml.h"
#include "io/written_meshes.h"

namespace pelage {
namespace {

/// Written from RFC 4648 with a table look-up by search, unlike the encoder.
std::string decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (char c : text) {
    if (c == '=') break;
    buffer = buffer << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(buffer >> (bits -= 8) & 0xff);
  }
  return bytes;
}

/// The numbers of a DataArray, after a check of its length in the header.
template <class T>
std::vector<T> array(const std::string& vtp, const std::string& name) {
  const std::size_t tag = vtp.find("Name=\"" + name + "\"");
  if (tag == std::string::npos) return {};
  const std::size_t begin = vtp.find('>', tag) + 1, end = vtp.find('<', begin);
  const std::string bytes = decode_base64(vtp.substr(begin, end - begin));
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  EXPECT_EQ(length, bytes.size() - 8) << name;
  std::vector<T> values((bytes.size() - 8) / sizeof(T));
  std::memcpy(values.data(), bytes.data() + 8, values.size() * sizeof(T));
  return values;
}

TEST(VtpWriter, Base64OfTheStandard) {  // RFC 4648, section 10
  const std::string plain[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
  const std::string coded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (int i = 0; i < 7; ++i) {
    std::string text;
    append_base64(text, plain[i]);
    EXPECT_EQ(text, coded[i]);
  }
}

TEST(VtpWriter, ArraysHoldTheMesh) {
  const TriangleMesh mesh = test::closed_mesh();
  const std::string vtp = encode_vtp(polygons_of(mesh));
  const auto points = array<float>(vtp, "Points"), a = array<float>(vtp, "a");
  const auto corners = array<std::int32_t>(vtp, "connectivity"), ends = array<std::int32_t>(vtp, "offsets");
  const auto rgb = array<std::uint8_t>(vtp, "RGB");
  ASSERT_EQ(points.size(), 3 * mesh.points.size());
  ASSERT_EQ(corners.size(), 3 * mesh.triangles.size());
  ASSERT_EQ(ends.size(), mesh.triangles.size());
  ASSERT_EQ(rgb.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i], mesh.points[i / 3][i % 3]);
    EXPECT_EQ(rgb[i], srgb_byte(mesh.find("color")->values[i]));
  }
  for (std::size_t c = 0; c < corners.size(); ++c) EXPECT_EQ(corners[c], mesh.triangles[c / 3][c % 3]);
  for (std::size_t f = 0; f < ends.size(); ++f) EXPECT_EQ(ends[f], static_cast<std::int32_t>(3 * f + 3));
  EXPECT_EQ(std::vector<double>(a.begin(), a.end()), mesh.find("a")->values);
}

TEST(VtpWriter, SeamsAreSplitAndNamesEscaped) {
  TriangleMesh mesh = test::seamed_mesh();
  mesh.find("a")->name = "a<b>&\"c\"";
  const std::string vtp = encode_vtp(polygons_of(mesh));
  EXPECT_EQ(array<float>(vtp, "TextureCoordinates").size(), 2 * (mesh.points.size() + 5));
  EXPECT_NE(vtp.find("Name=\"a&#60;b&#62;&#38;&#34;c&#34;\""), std::string::npos);
}

}  // namespace
}  // namespace pelage
