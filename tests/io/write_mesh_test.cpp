#include "io/write_mesh.h"

#include <fstream>
#include <limits>
#include <sstream>

#include "io/written_meshes.h"
#include "pelage/io.h"
#include "support/decimal_comma.h"
#include "support/expect_error.h"

namespace pelage {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// The files also serve as material for tests/clients/run.sh.
TEST(WriteMesh, EveryFormatTwiceTheSameBytes) {
  const fs::path folder = test::fresh_folder();
  const std::pair<const char*, TriangleMesh> meshes[] = {{"closed", test::closed_mesh()},
                                                         {"seamed", test::seamed_mesh()}};
  for (const auto& [name, mesh] : meshes) {
    for (const std::string& extension : mesh_extensions()) {
      const fs::path path = folder / (name + extension);
      save(mesh, path.string());
      const std::string first = contents(path);
      EXPECT_FALSE(first.empty()) << path;
      save(mesh, path.string());
      EXPECT_EQ(contents(path), first) << path;
    }
  }
}

TEST(WriteMesh, CapitalExtension) {
  const fs::path path = test::fresh_folder() / "A.PLY";
  save(test::tetrahedron(), path.string());
  EXPECT_EQ(contents(path).substr(0, 4), "ply\n");
}

TEST(WriteMesh, UnknownExtensionsAreRefusedBeforeAnyWork) {
  expect_error(Fault::usage, "known: .3mf, .glb, .obj, .off, .ply, .stl, .vtp", [] { check_mesh_path("a.fbx"); });
  expect_error(Fault::usage, "did you mean \".ply\"?", [] { check_mesh_path("a.pyl"); });
  expect_error(Fault::usage, "needs an extension", [] { check_mesh_path("out"); });
  expect_error(Fault::output, "does not exist", [] { check_mesh_path("no/such/folder/a.glb"); });
  EXPECT_NO_THROW(check_mesh_path("a.glb"));
}

TEST(WriteMesh, NothingThatIsNotANumberReachesAFile) {
  const fs::path folder = test::fresh_folder();
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e39};
  for (const std::string& extension : mesh_extensions()) {
    for (double value : bad) {
      const std::string path = (folder / ("a" + extension)).string();
      TriangleMesh mesh = test::closed_mesh();
      mesh.find("a")->values[42] = value;
      expect_error(Fault::numerics, "\"a\" is ", [&] { save(mesh, path); });
      expect_error(Fault::numerics, "at vertex 42", [&] { save(mesh, path); });
      mesh = test::seamed_mesh();
      mesh.find("uv")->values[2 * 7 + 1] = value;
      expect_error(Fault::numerics, "at corner 1 of face 2", [&] { save(mesh, path); });
      mesh = test::closed_mesh();
      mesh.points[3][2] = value;
      expect_error(Fault::numerics, "the position is ", [&] { save(mesh, path); });
      EXPECT_FALSE(fs::exists(path));
    }
  }
}

TEST(WriteMesh, TheSameBytesInEveryLocale) {
  const fs::path folder = test::fresh_folder();
  const TriangleMesh mesh = test::seamed_mesh();
  for (const std::string& extension : mesh_extensions()) {
    const fs::path here = folder / ("here" + extension), there = folder / ("there" + extension);
    save(mesh, here.string());
    {
      const testing::DecimalComma elsewhere;
      save(mesh, there.string());
      const std::vector<std::string> readable = readable_extensions();
      const bool is_read = std::ranges::count(readable, extension) > 0;
      EXPECT_TRUE(!is_read || test::same_places(read_shape(here.string()).mesh, read_shape(there.string()).mesh))
          << extension;
    }
    EXPECT_EQ(contents(there), contents(here)) << extension;
  }
}

}  // namespace
}  // namespace pelage
