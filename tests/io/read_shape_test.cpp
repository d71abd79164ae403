#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/read_text.h"
#include "pelage/io.h"
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

TEST_F(ReadShape, FilesThatAreNone) {
  test::expect_input_error([&] { read_shape(folder_ + "absent.obj"); }, "absent.obj: cannot be opened");
  test::expect_input_error([&] { read_shape(folder_); }, "known are");
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
