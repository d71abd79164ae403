#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "io/read_text.h"
#include "pelage/io.h"
#include "shape/generators.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

class ReadShape : public testing::Test {
 protected:
  ReadShape() { std::filesystem::create_directories(folder_); }
  ~ReadShape() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ + name, std::ios::binary) << bytes;
    return folder_ + name;
  }
  void error(const std::string& name, const std::string& bytes, const std::string& part) const {
    const std::string path = file(name, bytes);
    test::expect_input_error([&] { read_shape(path); }, path + part);
  }

  const std::string folder_ = testing::TempDir() + "pelage_read_shape/";
};

TEST_F(ReadShape, WhatIsWrittenIsRead) {
  TriangleMesh mesh = test::torus();
  for (Point& p : mesh.points)
    for (double& x : p) x = static_cast<float>(x);  // as STL and GLB store them
  for (const char* extension : {".obj", ".ply", ".off", ".stl", ".glb"}) {
    const std::string path = folder_ + "torus" + extension;
    save(mesh, path);
    const TriangleMesh result = read_shape(path).mesh;
    ASSERT_EQ(result.triangles.size(), mesh.triangles.size()) << extension;
    EXPECT_EQ(result.points.size(), mesh.points.size()) << extension;
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
      EXPECT_EQ(result.points[result.triangles[c / 3][c % 3]], mesh.points[mesh.triangles[c / 3][c % 3]]) << extension;
  }
}

TEST_F(ReadShape, ExtensionsCountWithoutCase) {
  EXPECT_EQ(read_shape(file("a.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).mesh.triangles.size(), 1u);
}

TEST_F(ReadShape, BuiltInShapesAreCleanSurfaces) {
  for (const std::string name : {"sphere", "torus", "knot", "cube", "plane"}) {
    const ShapeFile shape = read_shape("builtin:" + name + "?n=1000");
    EXPECT_EQ(test::first_violation(shape.mesh), "") << name;
  }
}

TEST_F(ReadShape, FaultsOfTheShapeNameFileLineAndElement) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\nf 1 2 3 4\n";
  error("a.obj", square + "f 1 2 9\n", ":7: face 1: refers to vertex 8");
  error("a.obj", "v nan 0 0\n" + square, ":1: vertex 0:");
  error("a.obj", "v 0 0 1\nv 1 1 1\n" + square + "f 3 4 1\nf 4 3 2\nf 3 4 2\nf 3 4 6\n",
        ":12: face 4: its edge between vertices 2 and 3");
  error("a.obj", "v 0 0 0\n", ": the shape has no faces");
}

/// Points alone are a cloud, which keeps what the file says of them but for points that are nowhere.
TEST_F(ReadShape, PointsWithoutFacesAreACloud) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 41\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float heat\nend_header\nnan 0 0 0 0 1 7\n";
  for (int i = 0; i < 40; ++i) text += std::to_string(i % 8) + " " + std::to_string(i / 8) + " 0 0 0 1 5\n";
  const ShapeFile cloud = read_shape(file("cloud.ply", text));
  EXPECT_TRUE(cloud.mesh.triangles.empty());
  ASSERT_EQ(cloud.mesh.points.size(), 40u);
  EXPECT_EQ(cloud.mesh.points[9], (Point{1, 1, 0}));
  EXPECT_EQ(cloud.mesh.find("normal")->values[2], 1);
  EXPECT_EQ(cloud.mesh.find("heat")->values, std::vector<double>(40, 5.0));
  const std::string again = folder_ + "again.ply";
  save(cloud.mesh, again);
  EXPECT_EQ(read_shape(again).mesh.points, cloud.mesh.points);
  EXPECT_THROW(save(cloud.mesh, folder_ + "a.glb"), Error);
  std::string lost;
  for (int i = 0; i < 40; ++i) lost += "v " + std::to_string(i) + " 0 0\n";
  error("lost.obj", lost, ": the shape has points and no faces; clouds of points are read from PLY or VTP");
}

TEST_F(ReadShape, BlendersFilesStandOnZ) {
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string comment = "comment Created by Blender 3.4.1 - www.blender.org, source file: 'cow.blend'\n";
  const ShapeFile guessed = read_shape(file("a.ply", "ply\nformat ascii 1.0\n" + comment + vertices));
  EXPECT_EQ(guessed.up, UpAxis::z);
  ASSERT_EQ(guessed.findings.size(), 1u);
  EXPECT_EQ(guessed.findings[0].kind, "up-axis");
  const ShapeFile other = read_shape(file("b.ply", "ply\nformat ascii 1.0\ncomment by hand\n" + vertices));
  EXPECT_EQ(other.up, UpAxis::y);
  EXPECT_TRUE(other.findings.empty());
  // Through GLB it stands: up is y there.
  save(guessed.mesh, folder_ + "up.glb", {"a", guessed.up});
  EXPECT_EQ(read_shape(folder_ + "up.glb").mesh.points[2], (Point{0, 0, -1}));
  save(guessed.mesh, folder_ + "as_is.ply", {"a", guessed.up});
  EXPECT_EQ(read_shape(folder_ + "as_is.ply").mesh.points[2], (Point{0, 1, 0}));
}

/// STL is millimetres to all programs for printing, glTF metres by its standard; the others do not say.
TEST_F(ReadShape, UnitsOfFormats) {
  const TriangleMesh mesh = builtin_shape("builtin:cube?n=100");
  EXPECT_EQ(read_shape("builtin:cube?n=100").mesh.metres_per_unit, 1);
  const std::map<std::string, std::optional<double>> units = {
      {".stl", 0.001}, {".glb", 1.0}, {".obj", {}}, {".ply", {}}, {".off", {}}};
  for (const auto& [extension, unit] : units) {
    SCOPED_TRACE(extension);
    save(mesh, folder_ + "a" + extension);
    const ShapeFile file = read_shape(folder_ + "a" + extension);
    EXPECT_EQ(file.mesh.metres_per_unit, unit);
    EXPECT_EQ(file.source->polygons.metres_per_unit, unit);
    EXPECT_EQ(as_in_file(*file.source, file.mesh).metres_per_unit, unit);
    const auto said = std::ranges::count(file.findings, "unit", &Finding::kind);
    EXPECT_EQ(said, extension == ".stl" ? 1 : 0);
  }
}

/// The numbers stay, and the node makes metres of them: what comes back is in metres, once and for all.
TEST_F(ReadShape, MillimetresThroughGlb) {
  for (const double offset : {0.0, 5.4e6}) {
    TriangleMesh mesh = builtin_shape("builtin:cube?n=100");
    for (Point& p : mesh.points) p[1] += offset;
    mesh.metres_per_unit = 0.001;
    save(mesh, folder_ + "mm.glb");
    const TriangleMesh metres = read_shape(folder_ + "mm.glb").mesh;
    EXPECT_EQ(metres.metres_per_unit, 1);
    save(metres, folder_ + "m.glb");
    const TriangleMesh again = read_shape(folder_ + "m.glb").mesh;
    ASSERT_EQ(metres.points.size(), mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(metres.points[v][k], 0.001 * mesh.points[v][k], 1e-9);
        EXPECT_NEAR(again.points[v][k], metres.points[v][k], 1e-9);
      }
    for (const char* name : {"mm.ply", "mm.obj", "mm.off"}) {
      save(mesh, folder_ + name);
      EXPECT_EQ(read_shape(folder_ + name).mesh.points, mesh.points) << name;
    }
  }
}

TEST_F(ReadShape, FilesThatAreNone) {
  test::expect_input_error([&] { read_shape(folder_ + "absent.obj"); }, "absent.obj: cannot be opened");
  test::expect_input_error([&] { read_shape(folder_); }, "is a directory");
  std::filesystem::create_directories(folder_ + "dir.obj");
  test::expect_input_error([&] { read_shape(folder_ + "dir.obj"); }, "is a directory");
  test::expect_input_error([&] { read_shape("a.fbx"); }, "a.fbx: cannot read files of the kind \".fbx\"");
  error("empty.off", "", ": the file is empty");
  error("a.obj", "\x1f\x8b\x08 and so on", ": is compressed (gzip)");
  error("a.ply", "PK\x03\x04 and so on", ": is compressed (zip)");
  error("a.off", "ply\nformat", ": holds a .ply file");
}

}  // namespace
}  // namespace pelage
