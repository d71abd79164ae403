#include "io/stl_reader.h"

#include <cstring>

#include "base/srgb.h"
#include "io/read_text.h"

namespace pelage {
namespace {

RawShape read(const std::string& bytes) { return read_stl(bytes, "a.stl"); }

std::string binary(const std::string& header, std::uint32_t promised, int facets) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&promised), 4);
  for (int f = 0; f < facets; ++f) {
    const float values[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(f)};
    bytes.append(reinterpret_cast<const char*>(values), sizeof values);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(StlReader, BinaryAlsoIfItBeginsWithSolid) {
  for (const char* header : {"", "solid thing"}) {
    const RawShape shape = read(binary(header, 2, 2));
    EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(shape.mesh.points[5], (Point{0, 1, 1}));
    EXPECT_TRUE(shape.face_lines.empty());
  }
}

TEST(StlReader, Text) {
  const RawShape shape = read(
      " SOLID a b c\r\n FACET NORMAL 0 0 1\r\n  outer loop\r\n   vertex 0 0 0\r\n   VERTEX 1e0 0 0\r\n   vertex 0 1 "
      "0.1\r\n  endloop\r\n"
      " endfacet\r\nendsolid a b c\r\nsolid\r\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 "
      "0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid");
  EXPECT_EQ(shape.mesh.points[2], (Point{0, 1, 0.1}));
  EXPECT_EQ(shape.mesh.face_ends, (std::vector<std::size_t>{3, 7}));
  EXPECT_EQ(shape.face_lines, (std::vector<int>{3, 12}));
  EXPECT_EQ(shape.vertex_lines[1], 5);
}

/// One facet in the words of a program, as a text around three corners.
const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::vector<std::string> solids(const std::string& bytes) {
  const RawShape shape = read(bytes);
  const Attribute* object = shape.mesh.find("object");
  std::vector<std::string> names;
  for (std::size_t f = 0; f < shape.mesh.face_count(); ++f)
    names.push_back(object ? object->labels.at(static_cast<std::size_t>(object->values.at(f))) : "");
  return names;
}

TEST(StlReader, NamesOfSolids) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(solids("solid\n" + facet + "endsolid\n"), Names{""});
  EXPECT_EQ(solids("solid facet normal loop\n" + facet + "endsolid facet normal loop\n"), Names{"facet normal loop"});
  EXPECT_EQ(solids("solid a\n" + facet + "endsolid a\nsolid b #2\n" + facet + "endsolid"), (Names{"a", "b #2"}));
  EXPECT_EQ(solids("solid\n" + facet + "endsolid\nsolid\n" + facet + "endsolid"), (Names{"solid 1", "solid 2"}));
  EXPECT_EQ(solids("solid a\n" + facet + "endsolid a solid b\n" + facet + "endsolid b\n"), (Names{"a", "b"}));
}

TEST(StlReader, TextOfAllDialects) {
  std::string flat = facet;  // all on one line
  for (char& c : flat)
    if (c == '\n') c = ' ';
  const std::string split =
      "facet\n normal\n0\n0 1 outer\nloop vertex 0 0\n0 vertex 1 0 0\n\tvertex 0 1 0 end loop END\nFACET\n";
  std::string old_mac = "solid x\n" + facet + "endsolid x";
  for (char& c : old_mac)
    if (c == '\n') c = '\r';
  const std::string glued =
      "facet normal 0 0 1\nouter loop\nvertex0 0 0\nvertex +1.E+000 0 0\nvertex 0 1e0 0\nendloopendfacet";
  for (const std::string& text :
       {"solid x\n" + facet + "endsolid x", "solid x " + flat + "endsolid x", "solid x\n" + split + "end solid x",
        "solid x\n" + glued + "endsolidx\n", old_mac, "\xEF\xBB\xBF\n\n  Solid x\n" + facet + "endsolid",
        "solid x\nfacet normal -nan(ind) 0 1\n" + facet.substr(19) + "endsolid"}) {
    const RawShape shape = read(text);
    ASSERT_EQ(shape.mesh.face_ends, (std::vector<std::size_t>{3})) << text;
    EXPECT_EQ(shape.mesh.points, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << text;
    EXPECT_EQ(shape.mesh.find("object")->labels[0], "x") << text;
    EXPECT_TRUE(shape.findings.empty()) << text;
  }
}

TEST(StlReader, WhatIsSkippedOrGuessedIsNamed) {
  const auto kinds = [](const std::string& bytes) {
    std::string text;
    for (const Finding& f : read(bytes).findings) text += f.kind + " ";
    return text;
  };
  EXPECT_EQ(kinds("solid\n" + facet + "endsolid\n\x1a" + std::string(3, '\0')), "data-behind-the-end ");
  EXPECT_EQ(kinds("solid\n" + facet), "no-end ");
  EXPECT_EQ(kinds(binary("", 2, 2) + "signed"), "data-behind-the-end ");
  std::string bytes = binary("", 1, 1);
  bytes[84 + 11] = '\xbf';  // the normal points to -1
  EXPECT_EQ(kinds(bytes), "turned-normals ");
  bytes = binary("", 1, 1);
  bytes[132] = 5;
  EXPECT_EQ(kinds(bytes), "attribute-bytes ");
}

/// A header and the attribute bytes of two facets.
std::vector<double> face_colors(std::string header, std::uint16_t first, std::uint16_t second) {
  std::string bytes = binary(header, 2, 2);
  std::memcpy(bytes.data() + 132, &first, 2);
  std::memcpy(bytes.data() + 182, &second, 2);
  const RawShape shape = read(bytes);
  const Attribute* color = shape.mesh.find("color");
  return color ? color->values : std::vector<double>{};
}

TEST(StlReader, ColoursOfBothConventions) {
  const double half = linear_from_srgb(16 / 31.0);
  EXPECT_EQ(face_colors("", 0x8000 | 31 << 10, 0x8000 | 16 << 5 | 31), (std::vector<double>{1, 0, 0, 0, half, 1}));
  const std::string magics = std::string("COLOR=") + '\xff' + '\x33' + '\0' + '\xff' + " by Magics";
  EXPECT_EQ(face_colors(magics, 31 | 16 << 5, 0x8000), (std::vector<double>{1, half, 0, 1, linear_from_srgb(0.2), 0}));
  EXPECT_TRUE(face_colors("", 0, 0).empty());
}

TEST(StlReader, SaysWhatIsWrongAndWhere) {
  auto error = [](const std::string& bytes, const char* part) { test::expect_input_error([&] { read(bytes); }, part); };
  error(binary("", 4294967295u, 2), "promises 4294967295 facets");
  error(binary("", 3, 2), "a.stl: the header promises 3");
  error(binary("", 1, 2), "a.stl: the header promises 1");
  error(std::string(500, '\x7f'), "a.stl:");
  error("short", "a.stl:");
  error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "a.stl:4:");
  error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "cut short");
  error("solid\nvertex 0 0 0\n", "a.stl:2:");
  error("solid\nouter loop\nouter loop\n", "a.stl:3:");
  error("solid\nendloop\n", "a.stl:2:");
  error("solid\nhello\n", "a.stl:2: unexpected word \"hello\"");
}

}  // namespace
}  // namespace pelage
