// Every file of the collections of good and broken meshes, if they are there.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/sample_meshes.h"

namespace pelage {
namespace {

const std::filesystem::path folder = PELAGE_SHARED_MESHES;

bool is_mesh(const std::filesystem::path& path) {
  for (const std::string& extension : readable_extensions())
    if (path.extension() == extension) return true;
  return false;
}

/// file -> ok, warn or error. The real files are not in the table.
std::map<std::string, std::string> classes() {
  std::map<std::string, std::string> result;
  std::ifstream table(folder / "bad" / "MANIFEST.tsv");
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string file, kind;
    words >> file >> kind;
    result[file] = kind;
  }
  return result;
}

/// Reads a file and checks what is promised of the result; the message of the error, or "".
std::string try_reading(const std::filesystem::path& path) {
  try {
    const ShapeFile shape = read_shape(path.string());
    EXPECT_FALSE(shape.mesh.triangles.empty()) << path;
    EXPECT_EQ(test::first_violation(shape.mesh), "") << path;
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input) << path;
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(path.string(), 0), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
}

TEST(BadMeshes, AreRepairedOrRefusedAsTheTableSays) {
  if (!std::filesystem::exists(folder / "bad")) GTEST_SKIP() << "no collection of meshes";
  const std::map<std::string, std::string> wanted = classes();
  for (const auto& entry : std::filesystem::directory_iterator(folder / "bad")) {
    if (!is_mesh(entry.path())) continue;
    const std::string message = try_reading(entry.path());
    const auto row = wanted.find(entry.path().filename().string());
    if (row == wanted.end()) continue;
    if (row->second == "warn") continue;
    EXPECT_EQ(message.empty(), row->second == "ok") << entry.path() << " " << message;
  }
}

TEST(GoodMeshes, AreRead) {
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no collection of meshes";
  for (const auto& sub : {folder, folder / "noisy"})
    for (const auto& entry : std::filesystem::directory_iterator(sub)) {
      if (!is_mesh(entry.path())) continue;
      const std::string message = try_reading(entry.path());
      // Its faces fold onto each other: edges with three faces.
      const bool broken = entry.path().filename() == "conrod_3223.stl";
      EXPECT_EQ(message.empty(), !broken) << message;
    }
}

}  // namespace
}  // namespace pelage
