#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "base/srgb.h"
#include "io/tet_file.h"
#include "io/vtk_xml.h"
#include "io/vtu_writer.h"
#include "io/written_meshes.h"
#include "io/zlib.h"
#include "pelage/error.h"
#include "shape/sample_volumes.h"

namespace pelage {
namespace {

std::vector<double> counting(std::size_t n, double step = 1) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<double>(i % 100) * step;
  return values;
}

/// Attributes of every type, and what VTK knows by other names.
TetMesh full_volume() {
  TetMesh volume = test::cube_of_tets(2, 0.2);
  volume.metres_per_unit = 0.001;
  for (int type = 0; type < 8; ++type)
    for (int components = 1; components <= 3; ++components) {
      const auto t = static_cast<NumberType>(type);
      volume.set({std::string(name_of(t)) + std::to_string(components), components, Domain::vertex,
                  counting(components * volume.nodes(), is_integer(t)              ? 1
                                                        : t == NumberType::float64 ? 0.1
                                                                                   : 0.125),
                  t});
    }
  volume.set({"group", 1, Domain::vertex, counting(volume.nodes(), 0), NumberType::int32, {"a<b> & \"c\"", ""}});
  Attribute color{"color", 3, Domain::vertex, {}, NumberType::uint16};
  for (std::size_t i = 0; i < 3 * volume.nodes(); ++i)
    color.values.push_back(linear_from_srgb(static_cast<double>(i * 4001 % 65536) / 65535));
  volume.set(color);
  return volume;
}

void expect_same(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.metres_per_unit, b.metres_per_unit);
  ASSERT_EQ(a.attributes.size(), b.attributes.size());
  for (const Attribute& x : a.attributes) {
    const Attribute* y = b.find(x.name);
    ASSERT_NE(y, nullptr) << x.name;
    EXPECT_EQ(x.values, y->values) << x.name;
    EXPECT_EQ(x.type, y->type) << x.name;
    EXPECT_EQ(x.components, y->components) << x.name;
    EXPECT_EQ(x.labels, y->labels) << x.name;
  }
}

TEST(Vtu, ComesBackToTheLastBit) {
  const TetMesh volume = full_volume();
  const TetFile file = read_tet_bytes(vtu_bytes(volume), "a.vtu");
  EXPECT_TRUE(file.findings.empty()) << file.findings[0].text;
  expect_same(volume, file.volume);
}

TEST(Vtu, GoesByTheExtension) {
  EXPECT_TRUE(is_tet_file("a.VTU"));
  EXPECT_TRUE(is_tet_file("a.msh"));
  EXPECT_FALSE(is_tet_file("a.vti"));
  const std::string path = (test::fresh_folder() / "a.vtu").string();
  write_tets(full_volume(), path);
  expect_same(full_volume(), read_tets(path).volume);
  EXPECT_THROW(write_tets(full_volume(), "a.msh"), Error);
  EXPECT_THROW(read_tet_bytes("", "a.obj"), Error);
  TetMesh bad = full_volume();
  bad.points[0][1] = NAN;
  EXPECT_THROW(write_tets(bad, path), Error);
}

/// A file as others write it: a hexahedron, a voxel, a wedge, a pyramid and a tetrahedron in a row, and a triangle.
std::string zoo(const std::string& cell_data = "") {
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="15" NumberOfCells="6">
<PointData><DataArray type="Int16" Name="u" format="ascii">0 1 2 3 4 5 6 7 8 9 10 11 12 13 14</DataArray>
<DataArray type="String" Name="s" format="ascii">65 0</DataArray></PointData>
<CellData>)" +
         cell_data + R"(</CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0  1 0 0  1 1 0  0 1 0  0 0 1  1 0 1  1 1 1  0 1 1
0 0 2  1 0 2  0 1 2  1 1 2  0 0 3  0 1 3  0.5 2 0.5
</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7  4 5 7 6 8 9 10 11  8 12 9 10 13 11  3 7 6 2 14
  8 9 11
  6 11 14 7</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 16 22 27 30 34</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 11 13 14 5 10</DataArray>
</Cells>
</Piece></UnstructuredGrid></VTKFile>
)";
}

TEST(Vtu, ReadsCellsOfAllShapes) {
  const TetFile file =
      read_tet_bytes(zoo(R"(<DataArray type="Int64" Name="part" format="ascii">7 7 7 7 1 7</DataArray>)"), "a.vtu");
  EXPECT_EQ(file.volume.find("part")->values, std::vector<double>(15, 7));
  EXPECT_EQ(file.volume.find("part")->type, NumberType::int32);
  EXPECT_EQ(file.volume.find("u")->values, counting(15));
  std::vector<std::string> kinds;
  for (const Finding& f : file.findings) kinds.push_back(f.kind);
  // The triangle, the strings, and the values of cells.
  EXPECT_EQ(kinds, (std::vector<std::string>{"left-out", "left-out", "cell-data"}));
}

TEST(Vtu, VolumesOfCellsAreThose) {
  std::string text = zoo();
  EXPECT_NEAR(test::volume(read_tet_bytes(text, "a.vtu").volume), 1 + 1 + 0.5 + 1.0 / 3 + 1.0 / 6, 1e-14);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_fault(const std::string& text, const std::string& words, const std::string& name = "a.vtu") {
  try {
    read_tet_bytes(text, name);
    FAIL() << "no fault: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Vtu, FaultsSayTheirPlace) {
  expect_fault(replaced(zoo(), "8 16 22", "8 7 22"), "a.vtu:15: the offset of cell 1 does not follow");
  expect_fault(replaced(zoo(), "12 11 13", "12 42 13"), "a.vtu:16: cell 1 is of the kind 42 (a polyhedron)");
  expect_fault(replaced(zoo(), "12 11 13", "12 10 13"), "a.vtu:15: cell 1 is a tetrahedron with 8 nodes");
  expect_fault(replaced(zoo(), "0 1 2 3 4 5 6 7  4", "0 1 2 3 4 5 6 15  4"),
               "a.vtu:12: cell 0 has the node 15, but there are 15");
  expect_fault(replaced(zoo(), "0 1 2 3 4 5 6 7  4", "0 1 2 3 4 5 6 -1  4"), "cell 0 has the node -1");
  expect_fault(replaced(zoo(), "\"15\"", "\"16\""), "numbers where");
  expect_fault(replaced(zoo(), "\"offsets\"", "\"o\""), "no array \"offsets\"");
  expect_fault(replaced(zoo(), "type=\"UnstructuredGrid\"", "type=\"PUnstructuredGrid\""), "holds PUnstructuredGrid");
  expect_fault(
      replaced(zoo(R"(<DataArray type="UInt8" Name="vtkGhostType" format="ascii">0 32 0 0 0 0</DataArray>)"), "s", "s"),
      "cells are hidden");
  expect_fault(replaced(zoo(), "12 11 13 14 5 10", "0 0 0 0 5 0"), "no cell with a volume");
}

/// Every row of the table of the docs that VTU has, by a file with that alone.
TEST(Vtu, TheTableOfTheDocsIsTrue) {
  const TetFile zoo_file =
      read_tet_bytes(zoo(R"(<DataArray type="Int64" Name="part" format="ascii">7 7 7 7 1 7</DataArray>)"), "a.vtu");
  const auto noted = [&](const TetFile& file, const std::string& kind) {
    return std::ranges::count(file.findings, kind, &Finding::kind) > 0;
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    return read_tet_bytes(replaced(zoo(), from, to), "a.vtu");
  };
  std::map<std::string, std::function<bool()>> rows;
  const bool kept = read_tet_bytes(vtu_bytes(full_volume()), "a.vtu").volume.tets == full_volume().tets;
  rows["| tetrahedra | kept | kept |"] = [&] { return kept; };
  rows["| hexahedra, wedges, pyramids | cut | cut |"] =
      rows["| voxels | cut | |"] = [&] { return zoo_file.volume.tets.size() == 18; };  // 6, 6, 3, 2 and 1
  rows["| cells of higher order | corners, noted | corners, noted |"] = [&] {
    std::string text = replaced(zoo(), "6 11 14 7<", "6 11 14 7 0 1 2 3 4 5<");
    text = replaced(replaced(text, "30 34", "30 40"), "5 10<", "5 24<");
    return noted(read_tet_bytes(text, "a.vtu"), "higher-order");
  };
  rows["| surfaces, lines and points beside them | left out, noted | left out, noted |"] = [&] {
    return noted(zoo_file, "left-out");
  };
  rows["| numbers at nodes | kept | kept |"] = [&] { return zoo_file.volume.find("u")->type == NumberType::int16; };
  rows["| numbers of cells | at nodes, noted | at nodes, noted |"] = [&] {
    return zoo_file.volume.find("part") && noted(zoo_file, "cell-data");
  };
  rows["| physical groups | | at nodes, noted |"] = [] { return true; };  // tests/io/msh_reader_test.cpp
  rows["| inverted cells | turned, noted | turned, noted |"] = [&] {
    return noted(changed("6 11 14 7<", "11 6 14 7<"), "turned-cells");
  };
  rows["| flat cells | left out, noted | left out, noted |"] = [&] {
    return noted(changed("6 11 14 7<", "6 6 14 7<"), "flat-cells");
  };
  rows["| unused nodes | left out, noted | left out, noted |"] = [&] {
    return noted(changed("12 11 13 14 5 10", "12 11 0 0 5 0"), "unused-nodes");
  };
  std::ifstream page(std::string(PELAGE_SOURCE_DIR) + "/docs/formats.md");
  std::string line;
  while (std::getline(page, line) && line != "| volumes read | vtu | msh |") {
  }
  std::getline(page, line);
  std::size_t count = 0;
  for (; std::getline(page, line) && line.starts_with("| "); ++count) {
    ASSERT_TRUE(rows.contains(line)) << line;
    EXPECT_TRUE(rows[line]()) << line;
  }
  EXPECT_EQ(count, rows.size());
}

/// Two tetrahedra, a piece each, appended and packed by zlib, as ParaView writes them.
TEST(Vtu, JoinsPiecesThatArePacked) {
  const auto word = [](std::uint64_t x) { return std::string(reinterpret_cast<const char*>(&x), 8); };
  std::string appended;
  std::vector<std::size_t> offsets;
  const auto add = [&](const std::string& bytes) {
    offsets.push_back(appended.size());
    const std::string packed = zlib_packed(bytes);
    appended += word(1) + word(bytes.size()) + word(0) + word(packed.size()) + packed;
  };
  const std::vector<std::vector<double>> points = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                                                   {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}};
  for (const auto& p : points) add(packed(p, NumberType::float32));
  add(packed({0, 1, 2, 3}, NumberType::int32));
  add(packed({4}, NumberType::int32));
  add(packed({10}, NumberType::uint8));
  const auto array = [&](const std::string& type, const std::string& name, std::size_t k) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           (name == "Points" ? "3" : "1") + "\" format=\"appended\" offset=\"" + std::to_string(offsets[k]) + "\"/>";
  };
  std::string text =
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>";
  for (std::size_t k = 0; k < 2; ++k)
    text += "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>" + array("Float32", "Points", k) +
            "</Points><Cells>" + array("Int32", "connectivity", 2) + array("Int32", "offsets", 3) +
            array("UInt8", "types", 4) + "</Cells></Piece>";
  text += "</UnstructuredGrid><AppendedData encoding=\"raw\">_" + appended + "</AppendedData></VTKFile>";
  const TetFile file = read_tet_bytes(text, "a.vtu");
  EXPECT_EQ(file.volume.nodes(), 5U);
  EXPECT_EQ(file.volume.tets.size(), 2U);
  EXPECT_NEAR(test::volume(file.volume), 0.5, 1e-7);
  ASSERT_FALSE(file.findings.empty());
  EXPECT_EQ(file.findings[0].kind, "joined-pieces");
  EXPECT_EQ(file.findings[0].count, 3U);
}

/// No prefix of a file is read as something else, or crashes.
TEST(Vtu, WhatIsCutShortIsRefused) {
  const std::string whole = vtu_bytes(test::cube_of_tets(1));
  for (std::size_t n = 0; n + 30 < whole.size(); n += 7)
    EXPECT_THROW(read_tet_bytes(whole.substr(0, n), "a.vtu"), Error) << n;
}

}  // namespace
}  // namespace pelage
