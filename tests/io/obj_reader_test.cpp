#include "io/obj_reader.h"

#include <algorithm>

#include "base/srgb.h"
#include "io/read_text.h"

namespace pelage {
namespace {

RawShape read(std::string_view text) { return read_obj(text, "a.obj"); }

std::string findings(const RawShape& shape) {
  std::string kinds;
  for (const Finding& f : shape.findings) kinds += (kinds.empty() ? "" : " ") + f.kind;
  return kinds;
}

TEST(ObjReader, ReadsWhatZBrushPaintsIntoComments) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const RawShape shape = read(triangle + "# The MRGB block\n#MRGB ffff0000ff00ff33\r\n#MRGB 800000ff\n");
  ASSERT_EQ(shape.mesh.attributes.size(), 2U);
  EXPECT_EQ(shape.mesh.find("color")->values, (std::vector<double>{1, 0, 0, 0, 1, linear_from_srgb(0.2), 0, 0, 1}));
  EXPECT_EQ(shape.mesh.find("mask")->values, (std::vector<double>{255, 255, 128}));
  EXPECT_EQ(read(triangle + "#MRGB ffff0000ff00ff33ff0000ff\n").mesh.attributes.size(), 1U);
  EXPECT_EQ(findings(read(triangle + "#MRGB ffff0000 nothing\n")), "left-out");
  EXPECT_EQ(findings(read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n#MRGB ff000000ff000000ff000000\n")),
            "left-out");
}

TEST(ObjReader, SaysWhatItDoesNotTakeOfVertices) {
  const RawShape shape = read_obj("v 0 0 0 1 0 0 0.5\nv 1 0 0 1 0 0 0.5\nv 0 1 0 0.2 0.3\nf 1 2 3\n", "a.obj");
  const auto said =
      std::ranges::find(shape.findings, "3 vertices with more numbers than x y z r g b; left out", &Finding::text);
  EXPECT_NE(said, shape.findings.end());
}

TEST(ObjReader, VerticesFacesAndLines) {
  const RawShape shape = read(
      "# comment\nmtllib x.mtl\no thing\nv 0.1 -2e3 +3\nv 1 0 0 1\nv 0 1 0\ng a b\ns off\nvn 0 0 1\nf 1//1 2//1 "
      "3//1\nl 1 2\np 1\nf 3/ 2 1\n");
  ASSERT_EQ(shape.mesh.points.size(), 3u);
  EXPECT_EQ(shape.mesh.points[0], (Point{0.1, -2000, 3}));
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 2, 1, 0}));
  EXPECT_EQ(shape.mesh.face_ends, (std::vector<std::size_t>{3, 6}));
  EXPECT_EQ(shape.vertex_lines, (std::vector<int>{4, 5, 6}));
  EXPECT_EQ(shape.face_lines, (std::vector<int>{10, 13}));
  ASSERT_EQ(shape.mesh.attributes.size(), 3U);
  EXPECT_EQ(shape.mesh.find("normal")->values,
            (std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(shape.mesh.find("object")->labels, (std::vector<std::string>{"thing"}));
  EXPECT_EQ(shape.mesh.find("group")->labels[0], "a b");
  ASSERT_EQ(shape.mesh.links.size(), 1U);
  EXPECT_EQ(shape.mesh.links[0].file, "x.mtl");
  EXPECT_EQ(findings(shape), "corners-without-values missing-file left-out");
}

TEST(ObjReader, KeepsDoublePrecision) {
  EXPECT_EQ(read("v 0.52573111211913359 1e-300 123456789.12345679\n").mesh.points[0],
            (Point{0.52573111211913359, 1e-300, 123456789.12345679}));
}

TEST(ObjReader, NegativeIndicesContinuationTabsAndMissingLastNewline) {
  const RawShape shape = read("v 0 0 0\r\nv\t1 0 \\\r\n0\r\nv 0 1 0\r\nf -3 -2 \\\r\n-1\r\nv 5 5 5\r\nf -1 -2 -3");
  EXPECT_EQ(shape.mesh.points[1], (Point{1, 0, 0}));
  EXPECT_EQ(shape.mesh.corners, (std::vector<std::int32_t>{0, 1, 2, 3, 2, 1}));
}

TEST(ObjReader, TextureCoordinatesSitAtTheCorners) {
  const RawShape shape = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nvt 1 1 0\nvt 0.75\nf 1/1 2/2/9 3/-1\nf 3 2 1\n");
  const Attribute& uv = shape.mesh.attributes.at(0);
  EXPECT_EQ(uv.name, "uv");
  EXPECT_EQ(uv.domain, Domain::corner);
  EXPECT_EQ(uv.values, (std::vector<double>{0.5, 0.25, 1, 1, 0.75, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(ObjReader, ColoursBecomeLinear) {
  const RawShape shape = read("v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\n");
  const Attribute& color = shape.mesh.attributes.at(0);
  EXPECT_EQ(color.name, "color");
  EXPECT_EQ(color.components, 3);
  EXPECT_EQ(color.values, (std::vector<double>{1, linear_from_srgb(0.5), 0, 0, 0, 1}));
  EXPECT_EQ(read("v 0 0 0 255 51 0\n").mesh.attributes.at(0).values,
            (std::vector<double>{1, linear_from_srgb(0.2), 0}));
  const RawShape some = read("v 0 0 0 0 0 1\nv 0 0 1\n");
  EXPECT_EQ(some.mesh.attributes.at(0).values, (std::vector<double>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(findings(some), "vertices-without-colour");
}

TEST(ObjReader, FacesBelongToObjectsGroupsMaterials) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const RawShape shape = read(vertices +
                              "f 1 2 3\no A#1\ng left arm\nusemtl red fur\ns 2\nf 1 2 3\nusemtl glass\ns off\n"
                              "f 1 2 3\nusemtl red fur\nf 1 2 3\n");
  const auto values = [&](const char* name) { return shape.mesh.find(name)->values; };
  EXPECT_EQ(values("object"), (std::vector<double>{0, 1, 1, 1}));
  EXPECT_EQ(values("group"), (std::vector<double>{0, 1, 1, 1}));
  EXPECT_EQ(values("material"), (std::vector<double>{0, 1, 2, 1}));
  EXPECT_EQ(values("smoothing"), (std::vector<double>{0, 2, 0, 0}));
  EXPECT_EQ(shape.mesh.find("object")->labels[1], "A#1");
  EXPECT_EQ(shape.mesh.find("material")->labels, (std::vector<std::string>{"", "red fur", "glass"}));
  EXPECT_EQ(findings(shape), "");
}

TEST(ObjReader, WhatIsNotUnderstoodIsNamed) {
  const RawShape shape = read("v 0 0 0 2\nv 1 0 0\nv 0 1 0\nvt 0 0 1\ncurv 1 2\nl 1 2\nl 2 3\nf 1 2 3/\nf 1//7 2 3\n");
  EXPECT_EQ(findings(shape), "left-out left-out left-out left-out left-out");
  EXPECT_NE(shape.findings.back().text.find("2 x \"l\" (line 6)"), std::string::npos) << shape.findings.back().text;
}

TEST(ObjReader, SaysWhatIsWrongAndWhere) {
  auto error = [](const char* text, const char* part) { test::expect_input_error([&] { read(text); }, part); };
  error("v 0 0 0\nv 1 x 0\n", "a.obj:2: expected a coordinate, found \"x\"");
  error("v 0 0\n", "a.obj:1: a coordinate is missing");
  error("v 0,5 0 0\n", "a.obj:1:");
  error("v 0 0 0\nf 0 1 2\n", "a.obj:2: a vertex number is 0");
  error("v 0 0 0\nf -2 1 1\n", "a.obj:2:");
  error("f 1 2 99999999999999999999\n", "a.obj:1:");
  error("f 1 2 4294967297\n", "a.obj:1:");
  error("f 1 2 a/b\n", "a.obj:1:");
  error("f /1 /2 /3\n", "a.obj:1:");
  error("v 0 0 0\nvt 0 0\nf 1/1 1/2 1/1\n", "vt 2");
}

}  // namespace
}  // namespace pelage
