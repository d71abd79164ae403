#include "io/off_reader.h"

#include "base/srgb.h"
#include "io/read_text.h"

namespace pelage {
namespace {

RawShape read(std::string_view text) { return read_off(text, "a.off"); }

void expect_triangle(const RawShape& shape) {
  ASSERT_EQ(shape.mesh.points.size(), 3u);
  EXPECT_EQ(shape.mesh.points[1], (Point{1, 0, 0}));
  EXPECT_EQ(shape.mesh.points[2], (Point{0, 1, 0.5}));
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_TRUE(shape.findings.empty());
}

TEST(OffReader, AllWaysToStandOnLines) {
  expect_triangle(read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2\n"));
  expect_triangle(read("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2"));
  expect_triangle(read("OFF3 1 0\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2"));
  expect_triangle(read("3 1 0\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2"));
  expect_triangle(read("OFF\n3 1\n0 0 0\n1 0 0\n0 1 .5\n3 0 1 2"));
  expect_triangle(read("OFF 3 1 0 0 0 0 1 0 0 0 1 .5 3 0 1 2"));
  expect_triangle(read(
      "# hello\r\nOFF # off\r\n\r\n3 1 0\r\n0 0 0 # first\r\n1 0 0\r\n\r\n0 1 .5\r\n3 0 1 2 0.5 0.5 0.5 # grey\r\n"));
}

TEST(OffReader, Variants) {
  const RawShape four = read("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0 0.5 0 1\n0 1 .5 0 0 1 1\n3 0 1 2\n");
  expect_triangle(four);
  EXPECT_EQ(four.mesh.attributes.at(0).components, 3);  // alpha is 1 everywhere
  EXPECT_EQ(four.mesh.attributes.at(0).values[4], linear_from_srgb(0.5));
  const RawShape three = read("COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 51 0\n0 1 .5 0 0 255\n3 0 1 2\n");
  expect_triangle(three);
  EXPECT_EQ(three.mesh.attributes.at(0).values[4], linear_from_srgb(0.2));
  expect_triangle(read("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 .5 0 0 1\n3 0 1 2\n"));
  const RawShape all =
      read("STCNOFF\n3 1 0\n0 0 0 0 0 1 .1 .2 .3 .4 7 8\n1 0 0 0 0 1 1 1 1 1 5 6\n0 1 .5 0 0 1 0 0 0 1 3 4\n3 0 1 2\n");
  expect_triangle(all);
  EXPECT_EQ(all.mesh.find("normal")->values, (std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(all.mesh.find("color")->components, 4);
  EXPECT_EQ(all.mesh.find("uv")->values, (std::vector<double>{7, 8, 5, 6, 3, 4}));
}

TEST(OffReader, FacesHaveColours) {
  const std::string vertices = "OFF\n3 4 0\n0 0 0\n1 0 0\n0 1 .5\n";
  const RawShape shape = read(vertices + "3 0 1 2 255 51 0\n3 0 1 2 1. 0.2 0\n3 0 1 2\n3 0 1 2 7\n");
  const Attribute& color = shape.mesh.attributes.at(0);
  EXPECT_EQ(color.domain, Domain::face);
  EXPECT_EQ(color.values,
            (std::vector<double>{1, linear_from_srgb(0.2), 0, 1, linear_from_srgb(0.2), 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(shape.findings.size(), 2U);  // one without a colour, one with a number of a list
}

TEST(OffReader, MoreThanPromisedIsReported) {
  EXPECT_EQ(read("OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 .5 0 0 255\n3 0 1 2\n").findings.at(0).kind,
            "left-out");
  EXPECT_EQ(read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n").findings.at(0).kind, "data-behind-the-end");
}

TEST(OffReader, SaysWhatIsWrongAndWhere) {
  auto error = [](const char* text, const char* part) { test::expect_input_error([&] { read(text); }, part); };
  error("OFF\n-3 -1 0\n0 0 0\n", "a.off:2:");
  error("OFF\n2147483648 1 0\n0 0 0\n", "a.off:2: the header promises");
  error("OFF\n3 99999999999999999999 0\n0 0 0\n", "a.off:2:");
  error("OFF BINARY\nxxxx", "binary OFF");
  error("4OFF\n1 1 1\n", "not supported");
  error("nOFF\n3 3 3\n", "not supported");
  error("hello\n", "a.off:1:");
  error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "cut short");
  error("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "cut short");
  error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off:6: face 0: refers to vertex 3");
  error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", "a.off:6: face 0:");
  error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "a.off:6: face 0:");
  error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3000000000 0 1 2\n", "a.off:6: face 0:");
  error("OFF\n3 1 0\n0,5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off:3:");
}

}  // namespace
}  // namespace pelage
