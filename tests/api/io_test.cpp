#include <pelage/io.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "api_support.h"

namespace pelage::api {
namespace {

TriangleMesh colored_sphere() {
  TriangleMesh mesh = load_shape("builtin:sphere?n=162");
  Attribute color{"color", 3, Domain::vertex, {}}, uv{"uv", 2, Domain::corner, {}};
  for (const Point& p : mesh.points)
    for (const double x : p) color.values.push_back(0.5 + 0.5 * std::clamp(x, -1.0, 1.0));
  for (std::size_t corner = 0; corner < 6 * mesh.triangles.size(); ++corner)
    uv.values.push_back(0.125 * static_cast<double>(corner % 8));
  mesh.set(color);
  mesh.set(uv);
  return mesh;
}

class Io : public InFolder {};

TEST_F(Io, BytesInMemoryAreThoseOfTheFile) {
  const TriangleMesh mesh = colored_sphere();
  ASSERT_GE(mesh_extensions().size(), 6u);
  for (const std::string& extension : mesh_extensions()) {
    save(mesh, path("a" + extension));
    EXPECT_EQ(mesh_bytes(mesh, extension), bytes_of(path("a" + extension))) << extension;
  }
  EXPECT_EQ(mesh_bytes(mesh, ".GLB"), mesh_bytes(mesh, ".glb"));
}

TEST_F(Io, ReadingBytesIsReadingTheFile) {
  const TriangleMesh mesh = colored_sphere();
  for (const std::string extension : {".obj", ".ply", ".stl", ".off", ".glb"}) {
    save(mesh, path("a" + extension));
    const ShapeFile file = read_shape(path("a" + extension));
    const ShapeFile memory = read_shape_bytes(bytes_of(path("a" + extension)), "upload" + extension);
    EXPECT_EQ(memory.mesh.points, file.mesh.points) << extension;
    EXPECT_EQ(memory.mesh.triangles, file.mesh.triangles) << extension;
    ASSERT_EQ(memory.mesh.attributes.size(), file.mesh.attributes.size()) << extension;
    for (std::size_t i = 0; i < file.mesh.attributes.size(); ++i)
      EXPECT_EQ(memory.mesh.attributes[i].values, file.mesh.attributes[i].values) << extension;
    EXPECT_EQ(load_shape(path("a" + extension)).points, file.mesh.points) << extension;
  }
}

TEST_F(Io, WhatWasRepairedIsTold) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 2 4\n";
  const ShapeFile file = read_shape_bytes(text, "a.obj");
  EXPECT_EQ(file.mesh.triangles.size(), 4u);
  ASSERT_EQ(file.findings.size(), 1u);
  EXPECT_TRUE(file.findings[0].repaired);
  EXPECT_EQ(file.findings[0].element, 4u);
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 1, 3}};
  const ShapeFile own = check_shape(mesh);
  EXPECT_EQ(own.mesh.triangles, file.mesh.triangles);
  EXPECT_EQ(own.findings.size(), 1u);
  mesh.triangles[0][0] = 17;
  EXPECT_EQ(fault_of([&] { check_shape(mesh); }), 3);
}

TEST_F(Io, FaultsSayWhereTheyAre) {
  const TriangleMesh mesh = colored_sphere();
  EXPECT_EQ(fault_of([&] { mesh_bytes(mesh, ".xyz"); }), 2);
  EXPECT_EQ(fault_of([&] { mesh_bytes(mesh, "glb"); }), 2);
  EXPECT_EQ(fault_of([&] { save(mesh, path("no/such/folder/a.glb")); }), 5);
  EXPECT_EQ(fault_of([&] { load_shape(path("missing.obj")); }), 3);
  EXPECT_EQ(fault_of([&] { read_shape_bytes("", "a.xyz"); }), 3);
  TriangleMesh bad = mesh;
  bad.points[7][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of([&] { mesh_bytes(bad, ".ply"); }), 4);
  try {
    read_shape_bytes("v 0 0 0\nv 1 0 0\nv 0 1 zero\n", "upload.obj");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where().file, "upload.obj");
    EXPECT_EQ(error.where().line, 3);
  }
}

TEST_F(Io, PicturesInMemoryAreThoseOfTheFile) {
  Image image{3, 2, std::vector<float>(18)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i) / 18;
  write_png(image, path("a.png"));
  EXPECT_EQ(png_bytes(image), bytes_of(path("a.png")));
  EXPECT_EQ(png_bytes(image).substr(1, 3), "PNG");
  image.rgb[4] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(fault_of([&] { png_bytes(image); }), 4);
}

}  // namespace
}  // namespace pelage::api
