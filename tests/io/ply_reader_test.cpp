#include "io/ply_reader.h"

#include <algorithm>
#include <cstring>

#include "base/srgb.h"
#include "io/read_text.h"

namespace pelage {
namespace {

RawShape read(const std::string& bytes) { return read_ply(bytes, "a.ply"); }

void error(const std::string& bytes, const char* part) {
  test::expect_input_error([&] { read(bytes); }, part);
}

const Attribute* find(const RawShape& shape, const std::string& name) {
  for (const Attribute& a : shape.mesh.attributes)
    if (a.name == name) return &a;
  return nullptr;
}

/// Bytes of numbers, in the order of the machine or turned.
struct Bytes {
  bool turned = false;
  std::string text;
  template <class T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (turned) std::reverse(raw, raw + sizeof(T));
    text.append(raw, sizeof(T));
    return *this;
  }
};

const std::string triangle_ascii =
    "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0.1\n3 0 1 2\n";

/// Floats of colours beside a byte of alpha, and the other way round.
TEST(PlyReader, AlphaOfAnotherType) {
  const auto color = [](const std::string& of_color, const std::string& of_alpha, const std::string& values) {
    const RawShape shape = read_ply(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nproperty " +
            of_color + " red\nproperty " + of_color + " green\nproperty " + of_color + " blue\nproperty " + of_alpha +
            " alpha\nend_header\n0 0 0 " + values + "\n",
        "a.ply");
    return shape.mesh.find("color")->values;
  };
  const double half = linear_from_srgb(0.5), byte = linear_from_srgb(51 / 255.0);
  EXPECT_EQ(color("float", "uchar", "0.5 1 0 51"), (std::vector<double>{half, 1, 0, 0.2}));
  EXPECT_EQ(color("uchar", "float", "51 255 0 0.2"), (std::vector<double>{byte, 1, 0, 0.2}));
}

TEST(PlyReader, Ascii) {
  const RawShape shape = read(triangle_ascii);
  EXPECT_EQ(shape.mesh.points[2], (Point{0, 1, 0.1}));
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(shape.vertex_lines, (std::vector<int>{11, 12, 13}));
  EXPECT_EQ(shape.face_lines, (std::vector<int>{14}));
}

TEST(PlyReader, BothByteOrdersAllTypesAnyOrder) {
  for (bool big : {false, true}) {
    const std::string header =
        std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\r\nelement face 1\r\nproperty int8 kind\r\nproperty list uint16 uint8 vertex_index\r\n"
        "element junk 1\r\nproperty list uchar double x\r\n"
        "element vertex 3\r\nproperty float64 z\r\nproperty short y\r\nproperty uchar red\r\nproperty uchar green\r\n"
        "property uchar blue\r\nproperty uint x\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
        "property float quality\r\nend_header\r\n";
    Bytes b{big, {}};
    b.add(std::int8_t{-1}).add(std::uint16_t{3}).add(std::uint8_t{0}).add(std::uint8_t{1}).add(std::uint8_t{2});
    b.add(std::uint8_t{2}).add(1.0).add(2.0);
    for (int v = 0; v < 3; ++v)
      b.add(0.1 * v)
          .add(std::int16_t(-300 * v))
          .add(std::uint8_t{255})
          .add(std::uint8_t{51})
          .add(std::uint8_t{0})
          .add(std::uint32_t(4000000000u))
          .add(0.f)
          .add(0.f)
          .add(1.f)
          .add(0.5f * static_cast<float>(v));
    const RawShape shape = read(header + b.text);
    EXPECT_EQ(shape.mesh.points[2], (Point{4e9, -600, 0.2}));
    EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2}));
    ASSERT_EQ(shape.mesh.attributes.size(), 4u);
    EXPECT_EQ(find(shape, "kind")->values, (std::vector<double>{-1}));
    EXPECT_EQ(find(shape, "kind")->type, NumberType::int8);
    EXPECT_EQ(find(shape, "normal")->values, (std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
    EXPECT_EQ(shape.findings.size(), 1u);  // the element "junk"
    EXPECT_EQ(find(shape, "quality")->values, (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(find(shape, "color")->components, 3);
    EXPECT_EQ(find(shape, "color")->values[4], linear_from_srgb(0.2));
  }
}

TEST(PlyReader, AttributesAreGrouped) {
  const RawShape shape = read(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "s\n"
      "property float t\nproperty float red\nproperty float green\nproperty float blue\nproperty float alpha\nproperty "
      "int id\n"
      "property list uchar int more\nend_header\n0 0 0 0.25 0.75 0.5 1 0 0.5 7 2 8 9\n");
  EXPECT_EQ(find(shape, "uv")->values, (std::vector<double>{0.25, 0.75}));
  EXPECT_EQ(find(shape, "color")->values, (std::vector<double>{linear_from_srgb(0.5), 1, 0, 0.5}));
  EXPECT_EQ(find(shape, "id")->values, (std::vector<double>{7}));
  EXPECT_EQ(shape.mesh.attributes.size(), 3u);
  EXPECT_EQ(shape.findings.size(), 1u);  // the list "more"
}

/// One colour as bytes, as 16 bits, as numbers from 0 to 1, and under MeshLab's other names.
TEST(PlyReader, ColoursAreTheSameInEveryType) {
  const auto color = [](const std::string& type, const std::string& prefix, const std::string& values) {
    std::string header =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    for (const char* name : {"red", "green", "blue"}) header += "property " + type + " " + prefix + name + "\n";
    return find(read(header + "end_header\n0 0 0 " + values + "\n"), "color")->values;
  };
  const std::vector<double> orange = {1, linear_from_srgb(128 / 255.0), 0};
  EXPECT_EQ(color("uchar", "", "255 128 0"), orange);
  EXPECT_EQ(color("uchar", "diffuse_", "255 128 0"), orange);
  EXPECT_NEAR(color("ushort", "", "65535 32896 0")[1], orange[1], 1e-12);
  EXPECT_NEAR(color("float", "", "1 0.501960784313 0")[1], orange[1], 1e-9);
  EXPECT_NEAR(color("double", "", "1 0.501960784313 0")[1], orange[1], 1e-9);
  EXPECT_EQ(color("int", "", "255 128 0"), orange);
}

TEST(PlyReader, FacesAndCornersHaveAttributesToo) {
  const RawShape shape = read(
      "ply\nformat ascii 1.0\ncomment TextureFile my skin.png\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty int id\nelement face 2\nproperty list uchar int vertex_indices\nproperty int id\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar float weight\n"
      "property list uchar int odd\nend_header\n0 0 0 1\n1 0 0 2\n1 1 0 16777217\n0 1 0 4\n"
      "3 0 1 2 7 255 0 0 3 1 2 3 1 9\n4 0 1 2 3 -8 0 0 255 4 4 5 6 7 1 9\n");
  EXPECT_EQ(find(shape, "id")->values, (std::vector<double>{1, 2, 16777217, 4}));
  EXPECT_EQ(find(shape, "face_id")->values, (std::vector<double>{7, -8}));
  EXPECT_EQ(find(shape, "color")->domain, Domain::face);
  EXPECT_EQ(find(shape, "color")->values, (std::vector<double>{1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(find(shape, "weight")->domain, Domain::corner);
  EXPECT_EQ(find(shape, "weight")->values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(shape.mesh.links.at(0).file, "my skin.png");
  ASSERT_EQ(shape.findings.size(), 2u);
  EXPECT_NE(shape.findings[0].text.find("\"odd\""), std::string::npos);
  EXPECT_NE(shape.findings[1].text.find("image \"my skin.png\""), std::string::npos);
}

/// A header that ends its lines with \\r alone, before data that begin with \\n.
TEST(PlyReader, CarriageReturnsAlone) {
  Bytes b{false, {}};
  b.add(std::uint8_t{'\n'}).add(std::uint8_t{1}).add(std::uint8_t{2});
  const RawShape shape = read(
      "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\rproperty uchar y\rproperty uchar "
      "z\rend_header\r" +
      b.text);
  EXPECT_EQ(shape.mesh.points.at(0), (Point{10, 1, 2}));
}

TEST(PlyReader, TriangleStripsRestartAtMinusOne) {
  const RawShape shape = read(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement "
      "tristrips 1\n"
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 4 2 3\n");
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 2, 1, 3, 4, 2, 3}));
  EXPECT_EQ(shape.mesh.face_count(), 3u);
}

TEST(PlyReader, TextureCoordinatesOfFacesSitAtTheCorners) {
  std::string text = triangle_ascii;
  text.replace(text.find("end_header"), 0, "property list uchar float texcoord\n");
  text.replace(text.rfind("3 0 1 2"), 7, "3 0 1 2 6 0 0.5 1 0 1 1");
  const RawShape shape = read(text);
  EXPECT_EQ(find(shape, "uv")->values, (std::vector<double>{0, 0.5, 1, 0, 1, 1}));
  EXPECT_EQ(find(shape, "uv")->domain, Domain::corner);
}

TEST(PlyReader, LongerLinesAreReported) {
  std::string text = triangle_ascii;
  text.replace(text.rfind("3 0 1 2"), 7, "3 0 1 2 9 9");
  EXPECT_EQ(read(text).findings.at(0).kind, "longer-lines");
}

TEST(PlyReader, DamagedHeaders) {
  error("plx\n", "a.ply:1:");
  error("ply\nformat ascii 1.0\nelement vertex 1\n", "end_header");
  error("ply\nelement vertex 0\nend_header\n", "format");
  error("ply\nformat ascii 2.0\nend_header\n", "a.ply:2:");
  error("ply\nformat text 1.0\nend_header\n", "a.ply:2:");
  error("ply\nformat ascii 1.0\nelement vertex -3\nend_header\n", "a.ply:3:");
  error("ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "a.ply:3:");
  error("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "a.ply:3:");
  error("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", "a.ply:4:");
  error("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\nend_header\n", "a.ply:4:");
  error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float z\nend_header\n0 0\n", "property y");
  error("ply\nformat ascii 1.0\nelement face 0\nend_header\n", "no vertices");
}

TEST(PlyReader, CountsThatTheFileCannotHold) {
  for (const char* count : {"4000000000", "9223372036854775807"}) {
    for (const char* format : {"ascii", "binary_little_endian"})
      error(std::string("ply\nformat ") + format + " 1.0\nelement vertex " + count +
                "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
            "a.ply:3: the header promises");
  }
  error("ply\nformat ascii 1.0\nelement vertex 99999999999999999999\nend_header\n", "too large");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
  error(header + Bytes().add(std::uint32_t{4294967280u}).add(0).text, "face 0");
  error(header + Bytes().add(std::uint32_t{2}).add(0).text, "cut short");
}

TEST(PlyReader, EveryByteThatIsMissingIsMissed) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  Bytes data;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) data.add(x);
  data.add(std::uint8_t{3}).add(0).add(1).add(2);
  EXPECT_EQ(read(header + data.text).mesh.corners, (std::vector<std::int32_t>{0, 1, 2}));
  for (std::size_t k = 0; k < data.text.size(); ++k) error(header + data.text.substr(0, k), "");
}

TEST(PlyReader, CutShortAndWrongValues) {
  for (std::size_t length = triangle_ascii.size() - 2; length > triangle_ascii.find("0 0 0"); --length) {
    std::string cut = triangle_ascii.substr(0, length);
    error(cut, "a.ply:");
  }
  std::string text = triangle_ascii;
  text.replace(text.rfind("3 0 1 2"), 7, "3 0 1.5 2");
  error(text, "a.ply:14: face 0:");
  text = triangle_ascii;
  text.replace(text.rfind("3 0 1 2"), 7, "-3 0 1 2");
  error(text, "a.ply:14: face 0:");
  text = triangle_ascii;
  text.replace(text.rfind("3 0 1 2"), 7, "3 0 x 2");
  error(text, "a.ply:14: expected a number");
}

}  // namespace
}  // namespace pelage
