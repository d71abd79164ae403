#include "io/atomic_file.h"

#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <sstream>

#include "io/written_meshes.h"
#include "support/expect_error.h"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void expect_output_error(const std::function<void()>& call, const std::string& words) {
  test::expect_error(Fault::output, words, call);
}

TEST(AtomicFile, AppearsAtCommitOnly) {
  const fs::path folder = test::fresh_folder(), path = folder / "a.txt";
  AtomicFile file(path.string());
  file.write("one ");
  file.write("two");
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(contents(path), "one two");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
  const fs::path folder = test::fresh_folder(), path = folder / "a.txt";
  write_file(path.string(), "old");
  try {
    AtomicFile file(path.string());
    file.write("half of the n");
    throw std::runtime_error("cancelled");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(contents(path), "old");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(AtomicFile, LeftoversOfKilledRunsAreNoObstacle) {
  const fs::path folder = test::fresh_folder(), path = folder / "a.txt";
  std::ofstream(path.string() + ".pelage-partial") << "a leftover that is longer";
  write_file(path.string(), "new");
  EXPECT_EQ(contents(path), "new");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(AtomicFile, LinksKeepPointing) {
  const fs::path folder = test::fresh_folder(), path = folder / "link.txt";
  fs::create_directory(folder / "deep");
  write_file((folder / "deep/a.txt").string(), "old");
  fs::create_symlink("deep/a.txt", path);
  write_file(path.string(), "new");
  EXPECT_TRUE(fs::is_symlink(path));
  EXPECT_EQ(contents(folder / "deep/a.txt"), "new");
}

TEST(AtomicFile, NamesThePathAndTheReason) {
  const fs::path folder = test::fresh_folder();
  const std::string lost = (folder / "none/a.txt").string();
  expect_output_error([&] { write_file(lost, "x"); }, lost + ": cannot write: No such file or directory");
  expect_output_error([&] { expect_output(lost); }, "does not exist");
  expect_output_error([&] { write_file(folder.string(), "x"); }, "Is a directory");
  expect_output_error([&] { expect_output(folder.string()); }, "Is a directory");
  EXPECT_NO_THROW(expect_output((folder / "a.txt").string()));
  EXPECT_NO_THROW(expect_output("a.txt"));
}

// A limit on the size of files stands in for a full disk: the system reports both in the same way.
TEST(AtomicFile, FullDiskLeavesNothing) {
  const fs::path folder = test::fresh_folder(), path = folder / "a.txt";
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 10000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  expect_output_error([&] { write_file(path.string(), std::string(20000, 'x')); }, path.string());
  expect_output_error([&] { write_file(path.string(), std::string(10001, 'x')); }, path.string());
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(files_in(folder), 0U);
}

}  // namespace
}  // namespace pelage
