#include "io/vtk_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/grid_file.h"
#include "io/vtk_xml.h"
#include "io/written_meshes.h"
#include "io/zlib.h"
#include "pelage/error.h"

namespace pelage {
namespace {

/// The ends of the type and what lies between.
std::vector<double> numbers_of(NumberType type, std::size_t count) {
  static constexpr double ends[][2] = {{-std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()},
                                       {-std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()},
                                       {-128, 127},
                                       {0, 255},
                                       {-32768, 32767},
                                       {0, 65535},
                                       {-2147483648.0, 2147483647.0},
                                       {0, 4294967295.0}};
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) / 7;
    values.push_back(is_integer(type) ? std::floor(x) : type == NumberType::float32 ? static_cast<float>(x) : x);
  }
  std::copy_n(ends[static_cast<int>(type)], 2, values.begin());
  return values;
}

/// An even grid with an attribute of every type, and what VTK knows by other names.
Grid full_grid() {
  Grid grid;
  grid.count = {5, 4, 3};
  grid.periodic = {true, false, true};
  grid.origin = {0.1, -2, 1e-9};
  grid.spacing = {0.3, 1.0 / 3, 7};
  grid.metres_per_unit = 0.001;
  for (int type = 0; type < 8; ++type)
    for (int components = 1; components <= 3; ++components) {
      const auto t = static_cast<NumberType>(type);
      grid.set({std::string(name_of(t)) + "_" + std::to_string(components), components, Domain::vertex,
                numbers_of(t, grid.nodes() * components), t});
    }
  grid.set({"normal", 3, Domain::vertex, std::vector<double>(3 * grid.nodes(), 0.5)});
  grid.set({"uv", 2, Domain::vertex, std::vector<double>(2 * grid.nodes(), 0.25)});
  grid.set(
      {"material", 1, Domain::vertex, std::vector<double>(grid.nodes(), 1), NumberType::int32, {"", "a<b> & \"c\""}});
  for (const NumberType type : {NumberType::uint8, NumberType::uint16}) {
    Attribute color{type == NumberType::uint8 ? "color" : "input_color",
                    type == NumberType::uint8 ? 4 : 3,
                    Domain::vertex,
                    {},
                    type};
    for (std::size_t i = 0; i < color.components * grid.nodes(); ++i) {
      const double stored = type == NumberType::uint8 ? static_cast<double>(i % 256) / 255
                                                      : static_cast<double>(i * 4001 % 65536) / 65535;
      color.values.push_back(color.components == 4 && i % 4 == 3 ? stored : linear_from_srgb(stored));
    }
    grid.set(color);
  }
  return grid;
}

Grid curved_grid() {
  Grid grid = full_grid();
  std::vector<Point> points;
  for (std::size_t v = 0; v < grid.nodes(); ++v) {
    const Point p = grid.point(static_cast<std::int32_t>(v));
    points.push_back({p[0] + 0.1 * std::sin(p[1]), p[1], std::cos(p[2])});
  }
  grid.points = points;
  grid.period = {{{1, 2, 3}, {}, {0, 0.1, 0}}};
  return grid;
}

void expect_same_attributes(const Grid& a, const Grid& b) {
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

void expect_same(const Grid& a, const Grid& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.periodic, b.periodic);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.metres_per_unit, b.metres_per_unit);
  expect_same_attributes(a, b);
}

TEST(VtkGrid, VtiComesBackToTheLastBit) {
  const Grid grid = full_grid();
  const GridFile file = read_grid_bytes(vti_bytes(grid), "a.vti");
  expect_same(grid, file.grid);
  EXPECT_EQ(grid.origin, file.grid.origin);
  EXPECT_EQ(grid.spacing, file.grid.spacing);
  EXPECT_TRUE(file.findings.empty()) << file.findings[0].text;
}

TEST(VtkGrid, VtsComesBackToTheLastBit) {
  const Grid grid = curved_grid();
  const GridFile file = read_grid_bytes(vts_bytes(grid), "a.vts");
  expect_same(grid, file.grid);
  EXPECT_TRUE(file.findings.empty()) << file.findings[0].text;
}

TEST(VtkGrid, PointsThatAreFloatsAreWrittenAsSuch) {
  Grid grid = curved_grid();
  EXPECT_NE(vts_bytes(grid).find("Float64\" Name=\"Points"), std::string::npos);
  for (Point& p : grid.points)
    for (double& x : p) x = static_cast<float>(x);
  const std::string bytes = vts_bytes(grid);
  EXPECT_NE(bytes.find("Float32\" Name=\"Points"), std::string::npos);
  expect_same(grid, read_grid_bytes(bytes, "a.vts").grid);
}

TEST(VtkGrid, AnEvenGridAsVtsHasItsPoints) {
  const Grid grid = full_grid(), back = read_grid_bytes(vts_bytes(grid), "a.vts").grid;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) EXPECT_EQ(back.point(v), grid.point(v));
  EXPECT_EQ(back.period[0], (Point{0.3 * 5, 0, 0}));
  EXPECT_EQ(back.period[2], (Point{0, 0, 21}));
  expect_same_attributes(grid, back);
}

TEST(VtkGrid, LinesAndSheetsComeBack) {
  for (const std::array<std::int32_t, 3> count : {std::array{7, 1, 1}, std::array{4, 3, 1}}) {
    Grid grid;
    grid.count = count;
    grid.set({"u", 1, Domain::vertex, numbers_of(NumberType::float64, grid.nodes()), NumberType::float64});
    expect_same(grid, read_grid_bytes(vti_bytes(grid), "a.vti").grid);
  }
}

TEST(VtkGrid, WritersRefuseWhatTheyCannotHold) {
  EXPECT_THROW(vti_bytes(curved_grid()), Error);
  Grid grid = full_grid();
  grid.set({"u", 1, Domain::vertex, std::vector<double>(grid.nodes(), NAN)});
  EXPECT_THROW(vti_bytes(grid), Error);
}

TEST(GridFile, GoesByTheExtension) {
  EXPECT_TRUE(is_grid_file("a.VTI"));
  EXPECT_TRUE(is_grid_file("a.b/c.jpeg"));
  EXPECT_FALSE(is_grid_file("a.obj"));
  EXPECT_FALSE(is_grid_file("vti"));
  EXPECT_FALSE(is_grid_file("a.exr"));  // written only
  const std::string path = (test::fresh_folder() / "a.vts").string();
  write_grid(curved_grid(), path);
  expect_same(curved_grid(), read_grid(path).grid);
  EXPECT_THROW(write_grid(curved_grid(), "a.png"), Error);  // a block
  EXPECT_THROW(write_grid(curved_grid(), "a.jpg"), Error);
  EXPECT_THROW(read_grid_bytes("", "a.obj"), Error);
}

// --- the table of the docs ---

/// A sheet with the datum of one row alone.
Grid grid_with(const std::string& what) {
  Grid grid;
  grid.count = {4, 3, what == "block" ? 3 : 1};
  if (what == "line") grid.count = {4, 1, 1};
  if (what == "bent grid") grid.points = std::vector<Point>(12, {0.1, 1e5 / 3, 0});
  if (what == "periodic axes") grid.periodic = {true, true, false};
  if (what == "unit") grid.metres_per_unit = 0.0254;
  const auto add = [&](const char* name, int components, NumberType type) {
    grid.set({name, components, Domain::vertex, numbers_of(type, grid.nodes() * components), type});
  };
  if (what == "number") add("a", 1, NumberType::float32);
  if (what == "integer") add("a", 1, NumberType::uint32);
  if (what == "double") add("a", 1, NumberType::float64);
  if (what == "vector") add("a", 3, NumberType::float64);
  if (what.starts_with("colour")) {
    const bool deep = what.ends_with("16 bits");
    grid.set({"color", 3, Domain::vertex, {}, deep ? NumberType::uint16 : NumberType::uint8});
    for (int i = 0; i < 36; ++i)
      grid.attributes[0].values.push_back(linear_from_srgb(deep ? i * 1801 / 65535.0 : i * 7 / 255.0));
  }
  if (what == "labels") {
    add("material", 1, NumberType::int32);
    grid.attributes[0].labels = {"Fur", "", "Nose"};
  }
  return grid;
}

TEST(VtkGrid, TheTableOfTheDocsIsTrue) {
  std::ifstream page(std::string(PELAGE_SOURCE_DIR) + "/docs/formats.md");
  std::string line;
  while (std::getline(page, line) && line != "| grids written | vti | vts |") {
  }
  std::getline(page, line);
  std::size_t rows = 0;
  for (; std::getline(page, line) && line.starts_with("| "); ++rows) {
    const std::size_t first = line.find(" | "), second = line.find(" | ", first + 3);
    const Grid grid = grid_with(line.substr(2, first - 2));
    const std::string vti = line.substr(first + 3, second - first - 3), vts = line.substr(second + 3);
    SCOPED_TRACE(line);
    if (vti == "kept")
      expect_same(grid, read_grid_bytes(vti_bytes(grid), "a.vti").grid);
    else
      EXPECT_THROW(vti_bytes(grid), Error);
    const Grid back = read_grid_bytes(vts_bytes(grid), "a.vts").grid;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v) EXPECT_EQ(back.point(v), grid.point(v));
    EXPECT_EQ(back.periodic, grid.periodic);
    EXPECT_EQ(back.metres_per_unit, grid.metres_per_unit);
    expect_same_attributes(grid, back);
    EXPECT_TRUE(vts == "kept |" || vts == "points |") << vts;
  }
  EXPECT_EQ(rows, 13U);
}

// --- as other programs write them ---

std::string base64(const std::string& bytes) {
  std::string text;
  append_base64(text, bytes);
  return text;
}

template <class T>
std::string as_bytes(T value, bool big) {
  std::string bytes;
  append_bytes(bytes, value);
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// One of the ways in which VTK writes arrays.
struct Encoding {
  bool inline_array, base64, zlib, wide, big;
};

/// The array's text: its head and data as VTK lays them out.
std::string encoded(const std::string& bytes, const Encoding& e) {
  const auto word = [&](std::size_t n) {
    return e.wide ? as_bytes(static_cast<std::uint64_t>(n), e.big) : as_bytes(static_cast<std::uint32_t>(n), e.big);
  };
  if (!e.zlib) return e.base64 ? base64(word(bytes.size()) + bytes) : word(bytes.size()) + bytes;
  constexpr std::size_t block = 64;
  const std::size_t blocks = (bytes.size() + block - 1) / block;
  std::string head = word(blocks) + word(block) + word(bytes.size() % block), data;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string packed = zlib_packed(bytes.substr(i * block, block));
    head += word(packed.size());
    data += packed;
  }
  return e.base64 ? base64(head) + base64(data) : head + data;
}

/// A VTI file of 6 x 5 nodes whose extent begins at (2, -1), with the arrays `u`, doubles, and `n`, 16 bits.
std::string file_with(const Encoding& e) {
  std::string u, n, appended;
  for (int i = 0; i < 30; ++i) {
    u += as_bytes(0.1 * i, e.big);
    n += as_bytes(static_cast<std::int16_t>(-i), e.big);
  }
  std::string text = R"(<?xml version="1.0"?><VTKFile type="ImageData" version="1.0")";
  text += std::string(" byte_order=\"") + (e.big ? "BigEndian" : "LittleEndian") + "\"";
  if (e.wide) text += " header_type=\"UInt64\"";
  if (e.zlib) text += " compressor=\"vtkZLibDataCompressor\"";
  text +=
      ">\n <ImageData WholeExtent=\"2 7 -1 3 0 0\" Origin=\"1 1 0\" Spacing=\"0.5 0.25 0\">\n"
      "  <FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">1</DataArray></FieldData>"
      "<Piece Extent=\"2 7 -1 3 0 0\">\n   <PointData Scalars=\"u\">\n";
  const auto add = [&](const char* type, const char* name, const std::string& bytes) {
    text += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" RangeMin=\"0\" format=\"";
    if (e.inline_array)
      text += "binary\">\n     " + encoded(bytes, e) + "\n    ";
    else
      text += "appended\" offset=\"" + std::to_string(appended.size()) + "\">";
    text +=
        "<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\"></InformationKey></DataArray>\n";
    if (!e.inline_array) appended += encoded(bytes, e);
  };
  add("Float64", "u", u);
  add("Int16", "n", n);
  text += "</PointData><CellData></CellData></Piece></ImageData>\n";
  if (!e.inline_array)
    text += std::string("<AppendedData encoding=\"") + (e.base64 ? "base64" : "raw") + "\">\n   _" + appended +
            "\n  </AppendedData>\n";
  return text + "</VTKFile>\n";
}

void expect_the_file(const GridFile& file) {
  EXPECT_EQ(file.grid.count, (std::array<std::int32_t, 3>{6, 5, 1}));
  EXPECT_EQ(file.grid.origin, (Point{2, 0.75, 0}));
  EXPECT_EQ(file.grid.spacing, (Point{0.5, 0.25, 1}));
  ASSERT_EQ(file.grid.attributes.size(), 2U);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(file.grid.find("u")->values[i], 0.1 * i);
    EXPECT_EQ(file.grid.find("n")->values[i], -i);
  }
  EXPECT_EQ(file.grid.find("n")->type, NumberType::int16);
  EXPECT_TRUE(file.findings.empty()) << file.findings[0].text;
}

TEST(VtkGridReader, TakesEveryEncodingOfVtk) {
  for (int bits = 0; bits < 32; ++bits) {
    const Encoding e{(bits & 1) != 0, (bits & 2) != 0 || (bits & 1) != 0, (bits & 4) != 0, (bits & 8) != 0,
                     (bits & 16) != 0};
    SCOPED_TRACE(bits);
    expect_the_file(read_grid_bytes(file_with(e), "a.vti"));
  }
}

/// Written by VTK 9.1 in its modes: nodes (2..5, -1..1, 3..4), at (1 + i/2, 2 + j/4, 3 + 2 k), and what is the same.
TEST(VtkGridReader, TakesWhatVtkItselfWrote) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PELAGE_SOURCE_DIR "/tests/fuzz/corpus/vtk")) {
    const std::string path = entry.path().string();
    if (!entry.path().filename().string().starts_with("written_by_vtk")) continue;
    SCOPED_TRACE(path);
    const GridFile file = read_grid(path);
    EXPECT_EQ(file.grid.count, (std::array<std::int32_t, 3>{4, 3, 2}));
    EXPECT_TRUE(file.findings.empty()) << file.findings[0].text;
    ASSERT_EQ(file.grid.attributes.size(), 4U);
    const double slack = path.find("ascii") != std::string::npos ? 1e-10 : 0;
    for (std::int32_t v = 0; v < 24; ++v) {
      EXPECT_EQ(file.grid.point(v), (Point{2 + 0.5 * (v % 4), 1.75 + 0.25 * (v / 4 % 3), 9 + 2.0 * (v / 12)}));
      EXPECT_NEAR(file.grid.find("wave")->values[v], std::sin(v), 1e-15 + slack);
      EXPECT_EQ(file.grid.find("step")->values[v], -v);
      EXPECT_EQ(file.grid.find("id")->values[v], v);
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(srgb_byte(file.grid.find("color")->values[3 * v + k]), k == 0 ? v : k == 1 ? 2 * v : 255 - v);
    }
    EXPECT_EQ(file.grid.find("step")->type, NumberType::int16);
    EXPECT_EQ(file.grid.find("id")->type, NumberType::int32);
    ++count;
  }
  EXPECT_EQ(count, 32);
}

/// An ascii VTI with an attribute list for the data set, and what stands in the piece.
std::string ascii_file(const std::string& attributes, const std::string& piece_extent, const std::string& inside) {
  return "<VTKFile type=\"ImageData\">\n<ImageData " + attributes + ">\n<Piece Extent=\"" + piece_extent + "\">\n" +
         inside + "\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

std::string point_data(const std::string& type, const std::string& name, const std::string& numbers) {
  return "<PointData>\n<DataArray type=\"" + type + "\" Name=\"" + name + "\">" + numbers + "</DataArray></PointData>";
}

GridFile read(const std::string& text) { return read_grid_bytes(text, "a.vti"); }

TEST(VtkGridReader, FloatsOfTextsAreFloats) {
  const GridFile file =
      read(ascii_file("WholeExtent=\"0 2 0 0 0 0\"", "0 2 0 0 0 0", point_data("Float32", "u", "0.1 -2e3\n7")));
  EXPECT_EQ(file.grid.find("u")->values, (std::vector<double>{0.1F, -2000, 7}));
}

TEST(VtkGridReader, ATurnedImageLiesWhereItIs) {
  const GridFile file =
      read(ascii_file("WholeExtent=\"1 3 0 1 0 0\" Origin=\"5 5 5\" Spacing=\"2 3 1\" Direction=\"0 -1 0 1 0 0 0 0 1\"",
                      "1 3 0 1 0 0", point_data("UInt8", "u", "0 1 2 3 4 5")));
  EXPECT_EQ(file.grid.points, (std::vector<Point>{{5, 7, 5}, {5, 9, 5}, {5, 11, 5}, {2, 7, 5}, {2, 9, 5}, {2, 11, 5}}));
  ASSERT_EQ(file.findings.size(), 1U);
  EXPECT_EQ(file.findings[0].kind, "turned-image");
}

TEST(VtkGridReader, AnUprightSheetBecomesASheet) {
  std::string text = ascii_file("WholeExtent=\"4 4 0 2 0 2\" Spacing=\"0.5 1 2\"", "4 4 0 2 0 2",
                                point_data("UInt8", "u", "0 1 2 3 4 5 6 7 8"));
  text.insert(text.find('\n'), "<FieldData><DataArray type=\"Int8\" Name=\"periodic\">0 0 1</DataArray></FieldData>");
  const GridFile file = read(text);
  EXPECT_EQ(file.grid.count, (std::array<std::int32_t, 3>{3, 3, 1}));
  EXPECT_EQ(file.grid.points,
            (std::vector<Point>{
                {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {2, 0, 2}, {2, 1, 2}, {2, 2, 2}, {2, 0, 4}, {2, 1, 4}, {2, 2, 4}}));
  EXPECT_EQ(file.grid.find("u")->values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(file.grid.periodic, (std::array{false, true, false}));
  EXPECT_EQ(file.grid.period[1], (Point{0, 0, 6}));
}

TEST(VtkGridReader, PiecesAreJoined) {
  const auto piece = [](const char* extent, const char* numbers) {
    return std::string("<Piece Extent=\"") + extent + "\">" + point_data("Int32", "u", numbers) + "</Piece>\n";
  };
  const auto file = [](const std::string& pieces) {
    return "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 2 0 1 0 0\">\n" + pieces + "</ImageData></VTKFile>";
  };
  const std::string left = piece("0 1 0 1 0 0", "0 1 3 4"), right = piece("1 2 0 1 0 0", "1 2 4 5");
  EXPECT_EQ(read(file(left + right)).grid.find("u")->values, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_THROW(read(file(left + left)), Error);
  EXPECT_THROW(read(file(left)), Error);
  // A block cut across its second axis, which begins at 5.
  const std::string block = "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 5 7 0 1\">\n" +
                            piece("0 1 5 6 0 1", "0 1 2 3 6 7 8 9") + piece("0 1 6 7 0 1", "2 3 4 5 8 9 10 11") +
                            "</ImageData></VTKFile>";
  EXPECT_EQ(read(block).grid.find("u")->values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST(VtkGridReader, SaysWhatIsLeftOut) {
  const GridFile file =
      read(ascii_file("WholeExtent=\"0 1 0 1 0 0\"", "0 1 0 1 0 0",
                      "<PointData><DataArray type=\"Int64\" Name=\"id\">0 1 2 3</DataArray>"
                      "<DataArray type=\"Bit\" Name=\"flag\">0 1 0 1</DataArray>"
                      "<DataArray type=\"Float64\" Name=\"u\">1 nan 2 3</DataArray></PointData>"
                      "<CellData><DataArray type=\"Float32\" Name=\"pressure\">1</DataArray></CellData>"));
  EXPECT_EQ(file.grid.find("id")->type, NumberType::int32);
  EXPECT_EQ(file.grid.find("u")->values, (std::vector<double>{1, 0, 2, 3}));
  std::string said;
  for (const Finding& finding : file.findings) said += finding.text + "\n";
  EXPECT_EQ(file.findings.size(), 3U) << said;
  for (const char* name : {"\"flag\"", "\"u\"", "\"pressure\""}) EXPECT_NE(said.find(name), std::string::npos) << said;
}

// --- damage ---

std::string fault_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input);
    return error.what();
  }
  return "";
}

TEST(VtkGridReader, FaultsHaveTheirPlace) {
  const std::string good = point_data("UInt8", "u", "1 2 3 4"), box = "0 1 0 1 0 0",
                    whole = "WholeExtent=\"0 1 0 1 0 0\"";
  const struct {
    std::string bytes, begin, contains;
  } cases[] = {
      {"", "a.vti:1: ", "no XML"},
      {"solid", "a.vti", "no XML"},
      {"<VTKFile>\n<ImageData>\n</Image></VTKFile>", "a.vti:3: ", "no XML"},
      {"<html></html>", "a.vti:1: ", "VTKFile"},
      {"\n<VTKFile type=\"PImageData\"></VTKFile>", "a.vti:2: ", "PImageData"},
      {"<VTKFile type=\"ImageData\"></VTKFile>", "a.vti:1: ", "no element ImageData"},
      {"<VTKFile type=\"ImageData\" compressor=\"vtkLZ4DataCompressor\"></VTKFile>", "a.vti:1: ", "LZ4"},
      {ascii_file("", box, good), "a.vti:2: ", "6 numbers"},
      {ascii_file("WholeExtent=\"0 -1 0 -1 0 -1\"", box, good), "a.vti:2: ", "no box"},
      {ascii_file("WholeExtent=\"0 1e5 0 1e5 0 1e5\"", box, good), "a.vti:2: ", "counted"},
      {ascii_file("WholeExtent=\"0 999 0 999 0 999\"", "0 999 0 999 0 999", ""), "a.vti:2: ", "without any values"},
      {ascii_file("WholeExtent=\"0 999 0 999 0 999\"", "0 999 0 999 0 999", good), "a.vti:5: ", "1000000000 belong"},
      {ascii_file(whole, "0 1 0 2 0 0", good), "a.vti:3: ", "beyond"},
      {ascii_file(whole, box, point_data("UInt8", "u", "1 2 3")), "a.vti:5: ", "3 numbers"},
      {ascii_file(whole, box, point_data("UInt8", "u", "1 2 x 4")), "a.vti:5: ", "\"x\""},
      {ascii_file(whole, box, point_data("UInt8", "u", "1 2 256 4")), "a.vti:5: ", "\"256\""},
      {ascii_file(whole, box, point_data("UInt8", "vtkGhostType", "0 0 2 0")), "a.vti:5: ", "hidden"},
      {ascii_file(whole + " Spacing=\"0 1 1\"", box, good), "a.vti", "spacing"},
      {ascii_file(whole + " Direction=\"1 0 0\"", box, good), "a.vti:2: ", "9 numbers"},
  };
  for (const auto& c : cases) {
    const std::string said = fault_of(c.bytes);
    EXPECT_TRUE(said.starts_with(c.begin)) << said << "\n" << c.bytes;
    EXPECT_NE(said.find(c.contains), std::string::npos) << said << "\n" << c.bytes;
  }
}

/// Wherever a file ends, and whatever a byte of its head says, it is read or refused.
TEST(VtkGridReader, DamagedArraysAreRefused) {
  for (const bool zlib : {false, true})
    for (const bool plain : {false, true}) {
      const std::string good = file_with({false, !plain, zlib, true, false});
      const std::size_t begin = good.find("   _") + 4;
      for (std::size_t size = 0; size < begin + 60; ++size)
        EXPECT_FALSE(fault_of(good.substr(0, size)).empty()) << size;
      for (std::size_t i = begin; i < begin + 40; ++i)
        for (const char c : {'\xff', '\x7f', '/'}) {
          std::string bad = good;
          bad[i] = c;
          fault_of(bad);
        }
    }
}

}  // namespace
}  // namespace pelage
