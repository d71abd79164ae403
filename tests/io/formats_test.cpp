// The table of docs/formats.md against what the writers do, and the way through files to the last bit.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "base/srgb.h"
#include "io/written_meshes.h"
#include "pelage/io.h"
#include "shape/scalar_attributes.h"

namespace pelage {
namespace {

/// Two quads and a triangle over seven vertices.
PolygonMesh roof() {
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0.5}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0.5}, {2, 1, 0}, {1, 2, 0}};
  for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 6}}) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.end_face();
  }
  return mesh;
}

std::size_t tuples(const PolygonMesh& mesh, Domain domain) {
  if (domain == Domain::vertex) return mesh.points.size();
  return domain == Domain::corner ? mesh.corners.size() : mesh.face_count();
}

/// Different values of that type, the ends of its range and what is no float among them.
double value_of(NumberType type, std::size_t i) {
  const auto k = static_cast<double>(i);
  switch (type) {
    case NumberType::float32:
      return static_cast<float>(0.1 * k);
    case NumberType::float64:
      return 1 + 1e-12 * k;
    case NumberType::int8:
      return -128 + k;
    case NumberType::uint8:
      return 255 - k;
    case NumberType::int16:
      return -32768 + k;
    case NumberType::uint16:
      return 65535 - k;
    case NumberType::int32:
      return i == 1 ? -2147483648.0 : 16777217 + k;
    case NumberType::uint32:
      return 4294967295.0 - k;
  }
  return 0;
}

Attribute attribute(const PolygonMesh& mesh, const std::string& name, int components, Domain domain, NumberType type) {
  Attribute a{name, components, domain, {}, type};
  for (std::size_t i = 0; i < tuples(mesh, domain) * static_cast<std::size_t>(components); ++i)
    a.values.push_back(value_of(type, i));
  return a;
}

constexpr NumberType types[] = {NumberType::float32, NumberType::float64, NumberType::int8,  NumberType::uint8,
                                NumberType::int16,   NumberType::uint16,  NumberType::int32, NumberType::uint32};

TEST(Formats, PlyKeepsEveryTypeEverywhereToTheLastBit) {
  PolygonMesh mesh = roof();
  for (const Domain domain : {Domain::vertex, Domain::corner, Domain::face})
    for (const NumberType type : types)
      mesh.set(attribute(mesh, name_of(type) + std::to_string(static_cast<int>(domain)), 1, domain, type));
  const ShapeFile file = read_shape_bytes(mesh_bytes(mesh, ".ply"), "a.ply");
  ASSERT_TRUE(file.source);
  const PolygonMesh& back = file.source->polygons;
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.corners, mesh.corners);
  EXPECT_EQ(back.face_ends, mesh.face_ends);
  ASSERT_EQ(back.attributes.size(), mesh.attributes.size());
  for (const Attribute& a : mesh.attributes) {
    const Attribute* b = back.find(a.name);
    ASSERT_TRUE(b) << a.name;
    EXPECT_EQ(b->type, a.type) << a.name;
    EXPECT_EQ(b->domain, a.domain) << a.name;
    EXPECT_EQ(b->values, a.values) << a.name;
  }
  EXPECT_EQ(mesh_bytes(back, ".ply"), mesh_bytes(mesh, ".ply"));
  EXPECT_TRUE(file.findings.empty());
}

Attribute colors(const PolygonMesh& mesh, Domain domain, int components = 3) {
  Attribute a{"color", components, domain, {}, NumberType::uint8};
  for (std::size_t i = 0; i < tuples(mesh, domain); ++i)
    for (int k = 0; k < components; ++k)
      a.values.push_back(k == 3 ? 200 / 255.0 : linear_from_srgb(static_cast<double>(8 * i + 80 * k) / 255));
  return a;
}

/// Colours beside "color" come back as colours, under their names.
TEST(Formats, FurtherColoursStayColours) {
  PolygonMesh mesh = roof();
  for (const char* name : {"color1", "input_color", "input_input_color"}) {
    Attribute a = colors(mesh, Domain::vertex, name[0] == 'c' ? 4 : 3);
    a.name = name;
    mesh.set(a);
  }
  Attribute material = colors(mesh, Domain::face);
  material.name = "material_color";
  mesh.set(material);
  for (const std::string extension : {".ply", ".glb"}) {
    const PolygonMesh back = read_shape_bytes(mesh_bytes(mesh, extension), "a" + extension).source->polygons;
    for (const Attribute& a : mesh.attributes) {
      if (extension == ".glb" && a.domain == Domain::face) continue;
      const Attribute* b = back.find(a.name);
      ASSERT_TRUE(b) << a.name << extension;
      EXPECT_TRUE(is_color(*b));
      ASSERT_EQ(b->values.size(), a.values.size()) << a.name << extension;
      for (std::size_t i = 0; i < a.values.size(); ++i)
        EXPECT_NEAR(b->values[i], a.values[i], extension == ".ply" ? 1e-12 : 1e-7) << a.name << extension;
    }
  }
}

/// Formulas call the components of a vector alike whatever file they come from.
TEST(Formats, ComponentsOfVectorsHaveOneName) {
  PolygonMesh mesh = roof();
  mesh.set(attribute(mesh, "flow", 3, Domain::vertex, NumberType::float32));
  const TriangleMesh given = read_shape_bytes(mesh_bytes(mesh, ".glb"), "a.glb").mesh;
  const TriangleMesh back = read_shape_bytes(mesh_bytes(mesh, ".ply"), "a.ply").mesh;
  const VertexAttributes from_glb = scalar_attributes(given), from_ply = scalar_attributes(back);
  for (const char* end : {"_1", "_2", "_3"})
    EXPECT_EQ(from_ply.at(std::string("flow") + end), from_glb.at(std::string("FLOW") + end)) << end;
}

/// The bytes of an array, decoded with a table of its own.
std::string vtp_array(const std::string& vtp, const std::string& type, const std::string& name) {
  const std::size_t tag = vtp.find("type=\"" + type + "\" Name=\"" + name + "\"");
  if (tag == std::string::npos) return "";
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (std::size_t i = vtp.find('>', tag) + 1; digits.find(vtp[i]) != std::string::npos; ++i) {
    buffer = buffer << 6 | static_cast<unsigned>(digits.find(vtp[i]));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(buffer >> (bits -= 8) & 0xff);
  }
  return bytes.substr(8);
}

template <class T>
std::string bytes_of(const std::vector<double>& values) {
  std::string bytes;
  for (const double x : values) {
    const T value = static_cast<T>(x);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bytes;
}

std::string bytes_of(NumberType type, const std::vector<double>& values) {
  switch (type) {
    case NumberType::float32:
      return bytes_of<float>(values);
    case NumberType::float64:
      return bytes_of<double>(values);
    case NumberType::int8:
      return bytes_of<std::int8_t>(values);
    case NumberType::uint8:
      return bytes_of<std::uint8_t>(values);
    case NumberType::int16:
      return bytes_of<std::int16_t>(values);
    case NumberType::uint16:
      return bytes_of<std::uint16_t>(values);
    case NumberType::int32:
      return bytes_of<std::int32_t>(values);
    case NumberType::uint32:
      return bytes_of<std::uint32_t>(values);
  }
  return "";
}

TEST(Formats, VtpKeepsEveryTypeToTheLastBit) {
  const std::map<NumberType, std::string> vtk = {{NumberType::float32, "Float32"}, {NumberType::float64, "Float64"},
                                                 {NumberType::int8, "Int8"},       {NumberType::uint8, "UInt8"},
                                                 {NumberType::int16, "Int16"},     {NumberType::uint16, "UInt16"},
                                                 {NumberType::int32, "Int32"},     {NumberType::uint32, "UInt32"}};
  PolygonMesh mesh = roof();
  for (const Domain domain : {Domain::vertex, Domain::face})
    for (const NumberType type : types)
      mesh.set(attribute(mesh, name_of(type) + std::to_string(static_cast<int>(domain)), 2, domain, type));
  const std::string vtp = mesh_bytes(mesh, ".vtp");
  for (const Attribute& a : mesh.attributes)
    EXPECT_EQ(vtp_array(vtp, vtk.at(a.type), a.name), bytes_of(a.type, a.values)) << a.name;
  std::vector<double> ends(mesh.face_ends.begin(), mesh.face_ends.end());
  EXPECT_EQ(vtp_array(vtp, "Int32", "offsets"), bytes_of<std::int32_t>(ends));
}

/// What eight bits a channel of sRGB say of the colours that a file gives back.
std::vector<double> read_back_bytes(const TriangleMesh& coat, const std::string& extension) {
  const std::string bytes = mesh_bytes(coat, extension);
  std::vector<double> values;
  const TriangleMesh back = read_shape_bytes(bytes, "a" + extension).mesh;
  EXPECT_EQ(back.points, coat.points) << extension;
  for (const double light : back.find("color")->values) values.push_back(255 * srgb_from_linear(light));
  return values;
}

/// One coat, one colour: every format says it in its own way, linear or sRGB, as bytes, floats or text, and the one
/// that cannot says so.
TEST(Formats, AllSayTheSameColourWithinHalfAByte) {
  TriangleMesh coat;
  constexpr std::int32_t n = 17;
  Attribute color{"color", 3, Domain::vertex, {}};
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i) {
      coat.points.push_back({static_cast<double>(i), static_cast<double>(j), 0});
      for (const double painted : {i / 16.0, j / 16.0, (i + n * j) / 288.0})
        color.values.push_back(linear_from_srgb(painted));
      const std::int32_t a = i + n * j;
      if (i + 1 < n && j + 1 < n)
        coat.triangles.insert(coat.triangles.end(), {{a, a + 1, a + n}, {a + 1, a + n + 1, a + n}});
    }
  coat.set(color);
  for (const std::string& extension : mesh_extensions()) {
    if (extension == ".3mf") continue;  // is not read; tests/scripts/print_test.sh does it
    const std::vector<std::string> lost = losses(coat, extension);
    if (!lost.empty()) {
      EXPECT_EQ(extension, ".stl");
      EXPECT_NE(lost[0].find("cannot hold color"), std::string::npos);
      continue;
    }
    const std::vector<double> bytes = read_back_bytes(coat, extension);
    ASSERT_EQ(bytes.size(), color.values.size()) << extension;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      EXPECT_NEAR(bytes[i], 255 * srgb_from_linear(color.values[i]), 0.5001) << extension << ' ' << i;
  }
}

// --- the table ---

Attribute labelled(const PolygonMesh& mesh, const std::string& name) {
  Attribute a{name, 1, Domain::face, {}, NumberType::int32, {"", "left half", "right"}};
  for (std::size_t i = 0; i < mesh.face_count(); ++i) a.values.push_back(static_cast<double>(i % 3));
  return a;
}

/// A mesh with the datum of one row alone.
PolygonMesh mesh_with(const std::string& row) {
  PolygonMesh mesh = roof();
  const std::map<std::string, Domain> domains = {
      {"vertex", Domain::vertex}, {"corner", Domain::corner}, {"face", Domain::face}};
  const std::size_t per = row.find(" per ");
  const std::string what = row.substr(0, per);
  const Domain domain = per == std::string::npos ? Domain::vertex : domains.at(row.substr(per + 5));
  if (what == "coordinates far from the origin")
    for (Point& p : mesh.points) p = {p[0] + 5.4e6 + 0.3, p[1], p[2]};
  else if (what == "normal")
    mesh.set(attribute(mesh, "normal", 3, domain, NumberType::float32));
  else if (what == "uv")
    mesh.set(attribute(mesh, "uv", 2, domain, NumberType::float32));
  else if (what == "colour")
    mesh.set(colors(mesh, domain));
  else if (what == "alpha")
    mesh.set(colors(mesh, domain, 4));
  else if (what == "number")
    mesh.set(attribute(mesh, "mask", 1, domain, NumberType::float32));
  else if (what == "integer")
    mesh.set(attribute(mesh, "id", 1, domain, NumberType::int32));
  else if (what == "double")
    mesh.set(attribute(mesh, "value", 1, domain, NumberType::float64));
  else if (what == "vector")
    mesh.set(attribute(mesh, "flow", 3, domain, NumberType::float32));
  else if (what == "object" || what == "group" || what == "material")
    mesh.set(labelled(mesh, what));
  else if (what == "texture link")
    mesh.links.push_back({"TextureFile", "skin.png"});
  else if (what == "material library")
    mesh.links.push_back({"mtllib", "roof.mtl"});
  else
    EXPECT_EQ(what, "faces of any size");
  return mesh;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' '), end = cell.find_last_not_of(' ');
    if (begin != std::string::npos) result.push_back(cell.substr(begin, end - begin + 1));
  }
  return result;
}

/// OBJ knows uv and normals of corners only.
Attribute at_corners(const PolygonMesh& mesh, const Attribute& a) {
  if (a.domain != Domain::vertex || (a.name != "uv" && a.name != "normal")) return a;
  Attribute result{a.name, a.components, Domain::corner, {}};
  for (const std::int32_t v : mesh.corners)
    for (int k = 0; k < a.components; ++k) result.values.push_back(a.values[a.components * v + k]);
  return result;
}

/// All that a mesh has beside points and faces.
std::string summary(const PolygonMesh& mesh) {
  std::ostringstream text;
  for (const Attribute& any : mesh.attributes) {
    const Attribute a = at_corners(mesh, any);
    text << a.name << ' ' << a.components << ' ' << static_cast<int>(a.domain);
    for (const std::string& label : a.labels) text << " \"" << label << '"';
    for (const double x : a.values) text << ' ' << (is_color(a) ? srgb_byte(x) : x);
    text << '\n';
  }
  for (const FileLink& link : mesh.links) text << link.kind << ' ' << link.file << '\n';
  return text.str();
}

void check_way_back(const PolygonMesh& mesh, const std::string& extension, const std::string& row) {
  if (extension == ".3mf") return;  // is not read
  const ShapeFile file = read_shape_bytes(mesh_bytes(mesh, extension), "a" + extension);
  const PolygonMesh& back = file.source->polygons;
  if (row.starts_with("vector")) {  // PLY has one property for each component
    ASSERT_EQ(back.attributes.size(), extension == ".ply" && !row.ends_with("corner") ? 3U : 1U) << row << extension;
    return;
  }
  EXPECT_EQ(back.corners, mesh.corners) << row << extension;
  EXPECT_EQ(back.face_ends, mesh.face_ends) << row << extension;
  EXPECT_EQ(summary(back), summary(mesh)) << row << extension;
  EXPECT_EQ(back.points, mesh.points) << row << extension;
}

TEST(Formats, TheTableOfTheDocsIsTrue) {
  std::ifstream page(std::string(PELAGE_SOURCE_DIR) + "/docs/formats.md");
  std::vector<std::string> head;
  std::size_t rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("|")) head.clear();
    if (!line.starts_with("|") || line.starts_with("| ---")) continue;
    const std::vector<std::string> row = cells(line);
    if (row[0] == "written") head = row;
    if (head.empty() || row == head) continue;
    ASSERT_EQ(row.size(), head.size()) << line;
    ++rows;
    const PolygonMesh mesh = mesh_with(row[0]);
    for (std::size_t i = 1; i < row.size(); ++i) {
      const std::string extension = "." + head[i], where = row[0] + ", " + head[i];
      const std::vector<std::string> lines = losses(roof(), extension);  // that faces are cut is another row
      std::vector<std::string> said = losses(mesh, extension);
      EXPECT_FALSE(mesh_bytes(mesh, extension).empty());
      if (row[i] == "kept" || row[i] == "split") {
        EXPECT_EQ(said, lines) << where;
        if (row[i] == "kept" && extension != ".glb" && extension != ".stl") check_way_back(mesh, extension, row[0]);
      } else {
        EXPECT_TRUE(row[i] == "warned" || row[i] == "rounded, warned") << where << ": " << row[i];
        EXPECT_FALSE(said.empty()) << where;
        EXPECT_TRUE(said != lines || row[0] == "faces of any size") << where;
        EXPECT_EQ(said.back().find("rounded") != std::string::npos, row[i] == "rounded, warned")
            << where << ": " << said.back();
      }
    }
  }
  EXPECT_GE(rows, 24U);
}

TEST(Formats, EveryWriterHasAColumn) {
  std::ifstream page(std::string(PELAGE_SOURCE_DIR) + "/docs/formats.md");
  std::string line;
  while (std::getline(page, line) && !line.starts_with("| written")) {
  }
  for (const std::string& extension : mesh_extensions())
    EXPECT_NE(line.find("| " + extension.substr(1) + " "), std::string::npos) << extension;
}

TEST(Formats, StlKeepsColoursOfFacesAndNamesOfSolids) {
  PolygonMesh mesh = roof();
  Attribute color{"color", 3, Domain::face, {}, NumberType::uint8};
  for (const double five_bits : {31, 0, 4, 17, 30, 1, 0, 0, 31})
    color.values.push_back(linear_from_srgb(five_bits / 31));
  mesh.set(color);
  EXPECT_EQ(losses(mesh, ".stl").size(), 1U);  // that quads are cut
  const ShapeFile colored = read_shape_bytes(mesh_bytes(mesh, ".stl"), "a.stl");
  const std::vector<double>& back = colored.mesh.find("color")->values;
  ASSERT_EQ(back.size(), 15U);
  for (std::size_t f = 0; f < 5; ++f)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[3 * f + k], color.values[3 * (f / 2) + k], 1e-12);
  mesh.attributes = {labelled(mesh, "object")};
  mesh.find("object")->labels[0] = "first";
  const ShapeFile solids = read_shape_bytes(mesh_bytes(mesh, ".stl"), "a.stl");
  EXPECT_EQ(solids.mesh.find("object")->labels, (std::vector<std::string>{"first", "left half", "right"}));
  EXPECT_EQ(solids.mesh.find("object")->values, (std::vector<double>{0, 0, 1, 1, 2}));
}

// --- back into the form of the file ---

TEST(AsInFile, WhatIsNotTouchedComesBackToTheLastBit) {
  PolygonMesh mesh = roof();
  mesh.points[1][2] = 1e-3;
  mesh.set(labelled(mesh, "material"));
  mesh.set(attribute(mesh, "id", 1, Domain::vertex, NumberType::int32));
  mesh.set(attribute(mesh, "uv", 2, Domain::corner, NumberType::float64));
  mesh.set(attribute(mesh, "normal", 3, Domain::corner, NumberType::float64));
  mesh.links.push_back({"TextureFile", "skin.png"});
  mesh.position_type = NumberType::float64;
  const std::string bytes = mesh_bytes(mesh, ".ply");
  const ShapeFile file = read_shape_bytes(bytes, "a.ply");
  TriangleMesh unchanged = file.mesh;
  unchanged.attributes.clear();
  EXPECT_EQ(mesh_bytes(as_in_file(*file.source, unchanged), ".ply"), bytes);
}

/// Seams of the file are doubled vertices: what grew on the merged ones comes to both.
TEST(AsInFile, MergedVerticesGetTheSame) {
  const ShapeFile file =
      read_shape_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 4 5 6\n", "a.obj");
  ASSERT_EQ(file.mesh.points.size(), 4U);
  TriangleMesh coat = file.mesh;
  coat.attributes = {{"b", 1, Domain::vertex, {}}};
  for (const Point& p : coat.points) coat.attributes[0].values.push_back(p[0] + 10 * p[1]);
  for (Point& p : coat.points) p[2] = 5;
  const PolygonMesh back = as_in_file(*file.source, coat);
  EXPECT_EQ(back.corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(back.find("b")->values, (std::vector<double>{0, 1, 10, 1, 11, 10, 0}));
  EXPECT_EQ(back.points[4], (Point{1, 1, 5}));
  EXPECT_EQ(back.points[6], (Point{9, 9, 9}));
}

/// A cube with sharp edges, turned: its normals turn with it and stay sharp.
TEST(AsInFile, NormalsFollow) {
  const ShapeFile file = read_shape_bytes(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 1\nv 1 1 1\nvn 0 0 1\nvn -1 0 0\nf 1//1 2//1 3//1 4//1\nf 2//2 5//2 "
      "6//2 3//2\n",
      "a.obj");
  TriangleMesh turned = file.mesh;
  for (Point& p : turned.points) p = {p[0], -p[2], p[1]};
  turned.attributes.clear();
  const std::vector<double> normals = as_in_file(*file.source, turned).find("normal")->values;
  for (std::size_t c = 0; c < 8; ++c) {
    const Point wanted = c < 4 ? Point{0, -1, 0} : Point{-1, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(normals[3 * c + k], wanted[k], 1e-15) << c;
  }
}

}  // namespace
}  // namespace pelage
