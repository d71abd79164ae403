// Compressed glTF: packed here by the encoders of the same libraries, where the build has them; refused by name
// otherwise.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "io/glb_builder.h"
#include "io/gltf_reader.h"
#include "io/read_text.h"
#include "pelage/io.h"
#include "shape/generators.h"

#ifdef PELAGE_HAS_DRACO
#include <draco/attributes/geometry_attribute.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef PELAGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace pelage {
namespace {

using test::GlbBuilder;

RawShape read(const std::string& bytes) { return read_gltf(bytes, "a.glb"); }

const std::vector<float> square = {0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0.5};
const std::vector<std::uint16_t> faces = {0, 1, 2, 2, 1, 3};

const std::string draco_extension = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{)";

/// A mesh whose accessors have no data of their own.
std::string draco_file(const std::string& packed, const std::string& ids) {
  GlbBuilder file;
  file.view(packed);
  file.accessor("VEC3", 5126, 4, "");
  file.accessor("SCALAR", 5123, 6, "");
  file.accessor("VEC4", 5121, 4, ",\"normalized\":true");
  return file.file_of(R"("attributes":{"POSITION":0,"COLOR_0":2},"indices":1)" + draco_extension + ids + "}}}",
                      R"(,"extensionsRequired":["KHR_draco_mesh_compression"])");
}

std::string meshopt_file(const std::string& points, const std::string& mode, const std::string& indices,
                         const std::string& filter = "") {
  GlbBuilder file;
  const auto packed = [](std::size_t at, std::size_t length, int stride, int count, const std::string& more) {
    return R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + std::to_string(at) +
           ",\"byteLength\":" + std::to_string(length) + ",\"byteStride\":" + std::to_string(stride) +
           ",\"count\":" + std::to_string(count) + more + "}}}";
  };
  file.view(points + indices);
  const std::string text =
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":)" +
      std::to_string(points.size() + indices.size()) + R"(},{"byteLength":60}],"bufferViews":[
      {"buffer":1,"byteLength":48)" +
      packed(0, points.size(), 12, 4, R"(,"mode":"ATTRIBUTES")" + filter) +
      R"(,{"buffer":1,"byteOffset":48,"byteLength":12)" +
      packed(points.size(), indices.size(), 2, 6, ",\"mode\":\"" + mode + "\"") +
      R"(],"accessors":[{"bufferView":0,"type":"VEC3","componentType":5126,"count":4},
      {"bufferView":1,"type":"SCALAR","componentType":5123,"count":6}])";
  return test::glb(R"({"asset":{"version":"2.0"},)" + text + "}", points + indices);
}

TEST(GltfDraco, DamagedDataAreRefusedByName) {
  const std::string message = "mesh 0 is compressed with Draco (KHR_draco_mesh_compression)";
  test::expect_input_error([&] { read(draco_file(std::string("DRACO\2\2\1\1") + std::string(60, '\0'), "")); },
                           message);
  test::expect_input_error([&] { read(draco_file("no", "")); }, "export without compression");
}

TEST(GltfDraco, PlainDataAreUsedWhereTheyAre) {
  GlbBuilder file;
  file.view("DRACO damaged");
  file.array("VEC3", square);
  file.array("SCALAR", faces);
  const RawShape shape =
      read(file.file_of(R"("attributes":{"POSITION":0},"indices":1)" + draco_extension + R"("POSITION":0}}})",
                        R"(,"extensionsUsed":["KHR_draco_mesh_compression"])"));
  EXPECT_EQ(shape.mesh.points[3], (Point{2, 1, 0.5}));
  EXPECT_EQ(shape.mesh.corners.size(), 6u);
}

TEST(GltfMeshopt, DamagedDataAreRefusedByName) {
  const std::string message = "buffer view 0 is compressed with meshoptimizer (EXT_meshopt_compression)";
  test::expect_input_error([&] { read(meshopt_file(std::string(40, '\1'), "TRIANGLES", std::string(20, '\2'))); },
                           message);
  test::expect_input_error([&] { read(meshopt_file("", "TRIANGLES", "")); }, "export without mesh compression");
}

TEST(GltfMeshopt, PlainDataAreUsedWhereTheyAre) {
  GlbBuilder file;
  file.view(test::bytes_of(square),
            R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":2,"byteStride":12,"count":4,
            "mode":"ATTRIBUTES"}})");
  file.accessor("VEC3", 5126, 4, ",\"bufferView\":0");
  EXPECT_EQ(read(file.file_of(R"("attributes":{"POSITION":0})")).mesh.points[3], (Point{2, 1, 0.5}));
}

#ifdef PELAGE_HAS_DRACO

/// The square with bytes as colours, packed; ids 0 and 1.
std::string draco_square(draco::MeshEncoderMethod method, int position_bits) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
  for (std::uint32_t f = 0; f < 2; ++f) {
    const std::uint16_t* t = faces.data() + 3 * f;
    const std::uint8_t colors[3][4] = {{std::uint8_t(51 * t[0]), 0, 255, 255},
                                       {std::uint8_t(51 * t[1]), 0, 255, 255},
                                       {std::uint8_t(51 * t[2]), 0, 255, 255}};
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), &square[3 * t[0]], &square[3 * t[1]],
                                      &square[3 * t[2]]);
    builder.SetAttributeValuesForFace(color, draco::FaceIndex(f), colors[0], colors[1], colors[2]);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  if (position_bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// The corners of all faces, in the order of the file, as places; faces begin at their smallest.
std::vector<std::array<Point, 3>> sorted_faces(const RawShape& shape) {
  std::vector<std::array<Point, 3>> result;
  for (std::size_t c = 0; c < shape.mesh.corners.size(); c += 3) {
    std::array<Point, 3> face;
    for (std::size_t k = 0; k < 3; ++k) face[k] = shape.mesh.points[shape.mesh.corners[c + k]];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    result.push_back(face);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(GltfDraco, IsUnpacked) {
  const std::vector<std::array<Point, 3>> expected = {{{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}},
                                                      {{{0, 1, 0}, {2, 0, 0}, {2, 1, 0.5}}}};
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const RawShape shape = read(draco_file(draco_square(method, 0), R"("POSITION":0,"COLOR_0":1)"));
    EXPECT_EQ(sorted_faces(shape), expected);
    ASSERT_EQ(shape.mesh.attributes.size(), 1u);
    for (std::size_t v = 0; v < shape.mesh.points.size(); ++v) {
      const Point& p = shape.mesh.points[v];
      const double number = (p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0);
      EXPECT_NEAR(shape.mesh.attributes[0].values[4 * v], number / 5, 1e-12);
      EXPECT_EQ(shape.mesh.attributes[0].values[4 * v + 2], 1);
    }
  }
  const RawShape quantised =
      read(draco_file(draco_square(draco::MESH_EDGEBREAKER_ENCODING, 14), R"("POSITION":0,"COLOR_0":1)"));
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(sorted_faces(quantised)[f][c][k], expected[f][c][k], 2.0 / (1 << 14));
}

TEST(GltfDraco, MissingOrCutDataAreRefused) {
  const std::string packed = draco_square(draco::MESH_EDGEBREAKER_ENCODING, 0);
  test::expect_input_error([&] { read(draco_file(packed, R"("POSITION":7,"COLOR_0":1)")); },
                           "and its POSITION cannot be decoded");
  for (std::size_t length = 0; length < packed.size(); length += 3)
    EXPECT_THROW(read(draco_file(packed.substr(0, length), R"("POSITION":0,"COLOR_0":1)")), Error);
}

#endif

#ifdef PELAGE_HAS_MESHOPTIMIZER

template <class Encode>
std::string packed(Encode&& encode) {
  std::string bytes(10000, '\0');
  bytes.resize(encode(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size()));
  return bytes;
}

/// What is written small reads as the mesh that it was, to the digits that are promised; vertices by their numbers.
TEST(GltfMeshopt, WrittenFilesReadAsTheyWere) {
  TriangleMesh mesh = builtin_shape("builtin:torus?n=576");
  const double metres = 0.001;
  mesh.metres_per_unit = metres;
  Attribute number{"number", 1, Domain::vertex, {}}, color{"color", 3, Domain::vertex, {}},
      normal{"normal", 3, Domain::vertex, {}}, material{"material", 1, Domain::face, {}, NumberType::int32, {"a", "b"}};
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double x = static_cast<double>(v) / static_cast<double>(mesh.points.size());
    number.values.push_back(static_cast<double>(v));
    color.values.insert(color.values.end(), {x, x * x, 1 - x});
    const double angle = 7 * x;
    normal.values.insert(normal.values.end(), {std::cos(angle), 0.6 * std::sin(angle), -0.8 * std::sin(angle)});
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) material.values.push_back(f % 3 == 0 ? 1 : 0);
  for (Attribute* a : {&number, &color, &normal, &material}) mesh.set(*a);
  const std::string plain = mesh_bytes(mesh, ".glb"), small = mesh_bytes(mesh, ".glb", {.compress = true});
  EXPECT_LT(2 * small.size(), plain.size());

  const RawShape file = read(small);
  const PolygonMesh& back = file.mesh;
  const double unit = file.metres_per_unit.value_or(1);
  ASSERT_GE(back.points.size(), mesh.points.size());  // parts are read with vertices of their own
  ASSERT_EQ(back.face_count(), mesh.triangles.size());
  for (const char* name : {"NUMBER", "color", "normal", "material"}) ASSERT_TRUE(back.find(name)) << name;
  const Attribute &numbers = *back.find("NUMBER"), &colors = *back.find("color"), &normals = *back.find("normal");
  double size = 0;
  for (const Point& p : mesh.points)
    size = std::max({size, 2 * std::abs(p[0]), 2 * std::abs(p[1]), 2 * std::abs(p[2])});
  for (std::size_t v = 0; v < back.points.size(); ++v) {
    const auto was = static_cast<std::size_t>(std::lround(numbers.values[v]));
    ASSERT_LT(was, mesh.points.size());
    double cosine = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(back.points[v][k] * unit, metres * mesh.points[was][k], metres * size / 65535);
      EXPECT_NEAR(colors.values[3 * v + k], color.values[3 * was + k], 0.6 / 65535);
      cosine += normals.values[3 * v + k] * normal.values[3 * was + k];
    }
    EXPECT_GT(cosine, std::cos(0.05 * std::numbers::pi / 180));
  }
  std::set<std::array<long, 4>> faces_before, faces_after;
  const auto face = [](long a, long b, long c, double m) {
    while (a > b || a > c) std::tie(a, b, c) = std::tuple{b, c, a};
    return std::array<long, 4>{a, b, c, std::lround(m)};
  };
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    faces_before.insert(face(t[0], t[1], t[2], material.values[f]));
    std::array<long, 3> n;
    for (std::size_t k = 0; k < 3; ++k)
      n[k] = std::lround(numbers.values[static_cast<std::size_t>(back.corners[3 * f + k])]);
    faces_after.insert(face(n[0], n[1], n[2], back.find("material")->values[f]));
  }
  EXPECT_EQ(faces_before, faces_after);
}

TEST(GltfMeshopt, IsUnpacked) {
  const std::vector<std::uint32_t> wide(faces.begin(), faces.end());
  const std::string points = packed(
      [](unsigned char* out, std::size_t size) { return meshopt_encodeVertexBuffer(out, size, square.data(), 4, 12); });
  const std::string triangles = packed([&](unsigned char* out, std::size_t size) {
    return meshopt_encodeIndexBuffer(out, size, wide.data(), wide.size());
  });
  const std::string sequence = packed([&](unsigned char* out, std::size_t size) {
    return meshopt_encodeIndexSequence(out, size, wide.data(), wide.size());
  });
  const std::string exponents = packed([](unsigned char* out, std::size_t size) {
    std::vector<std::uint32_t> coded(12);
    for (std::size_t i = 0; i < 12; ++i)  // halves: mantissa 2x, exponent -1
      coded[i] = 0xFF000000U | static_cast<std::uint32_t>(2 * square[i]);
    return meshopt_encodeVertexBuffer(out, size, coded.data(), 4, 12);
  });
  const auto check = [&](const RawShape& shape) {
    for (std::size_t v = 0; v < 4; ++v)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(shape.mesh.points[v][k], square[3 * v + k]);
    ASSERT_EQ(shape.mesh.corners.size(), 6u);
    std::vector<std::int32_t> corners = shape.mesh.corners;  // a triangle may begin at another corner
    for (int f = 0; f < 2; ++f)
      std::rotate(corners.begin() + 3 * f,
                  std::find(corners.begin() + 3 * f, corners.begin() + 3 * f + 3, f == 0 ? 0 : 2),
                  corners.begin() + 3 * f + 3);
    EXPECT_EQ(corners, (std::vector<std::int32_t>{0, 1, 2, 2, 1, 3}));
  };
  check(read(meshopt_file(points, "TRIANGLES", triangles)));
  check(read(meshopt_file(points, "INDICES", sequence)));
  check(read(meshopt_file(exponents, "INDICES", sequence, R"(,"filter":"EXPONENTIAL")")));
  test::expect_input_error([&] { read(meshopt_file(points, "INDICES", sequence, R"(,"filter":"QUATERNION")")); },
                           "in a way that cannot be");
}

#endif

}  // namespace
}  // namespace pelage
