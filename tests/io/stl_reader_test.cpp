#include "io/stl_reader.h"

#include <cstring>

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
