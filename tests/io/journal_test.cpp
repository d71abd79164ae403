#include "io/journal.h"

#include <fstream>

#include "io/file_bytes.h"
#include "io/written_meshes.h"
#include "support/expect_error.h"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string output() { return (test::fresh_folder() / "sheet.png").string(); }

/// As a process that is killed leaves it.
std::string left_behind(const std::string& output, const std::string& record) {
  Journal journal(output, record);
  journal.add("a", "bytes of a");
  journal.add("b", std::string("\0\n", 2));
  journal.add("", "");
  return journal.path();
}

TEST(Journal, TheSameCommandFindsWhatIsThere) {
  const std::string path = output();
  left_behind(path, "command");
  const Journal journal(path, "command");
  EXPECT_EQ(journal.size(), 3U);
  EXPECT_EQ(journal.find("a"), "bytes of a");
  EXPECT_EQ(journal.find("b"), std::string("\0\n", 2));
  EXPECT_EQ(journal.find(""), "");
  EXPECT_EQ(journal.find("c"), std::nullopt);
}

TEST(Journal, AnotherCommandBeginsAnew) {
  const std::string path = output();
  left_behind(path, "command --seed 1");
  Journal journal(path, "command --seed 2");
  EXPECT_EQ(journal.size(), 0U);
  journal.add("a", "other");
  const Journal again(path, "command --seed 2");
  EXPECT_EQ(again.size(), 1U);
  EXPECT_EQ(again.find("a"), "other");
}

TEST(Journal, WithoutARecordNothingIsKept) {
  const std::string path = output();
  Journal journal(path, "");
  journal.add("a", "bytes");
  EXPECT_FALSE(fs::exists(journal.path()));
  EXPECT_EQ(journal.find("a"), std::nullopt);
}

TEST(Journal, GoesWhenTheCommandEnds) {
  const std::string path = output(), parts = left_behind(path, "command");
  Journal journal(path, "command");
  EXPECT_TRUE(fs::exists(parts));
  journal.finish();
  EXPECT_FALSE(fs::exists(parts));
  Journal new_one(path, "command");
  new_one.add("a", "bytes");
  EXPECT_TRUE(fs::exists(parts));
  new_one.finish();
  EXPECT_FALSE(fs::exists(parts));
}

/// Wherever the writing stopped, whole parts are there and the rest is written anew.
TEST(Journal, CutAnywhereItGoesOnBehindTheLastWholePart) {
  const std::string path = output(), parts = left_behind(path, "command"), whole = read_raw_file(parts);
  std::size_t before = 0;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    std::ofstream(parts, std::ios::binary) << whole.substr(0, length);
    Journal journal(path, "command");
    EXPECT_LE(before, journal.size());
    before = journal.size();
    for (const auto& [name, bytes] :
         {std::pair<std::string, std::string>{"a", "bytes of a"}, {"b", {"\0\n", 2}}, {"", ""}})
      if (const auto found = journal.find(name)) {
        EXPECT_EQ(*found, bytes) << length;
      } else {
        journal.add(name, bytes);
      }
    EXPECT_EQ(read_raw_file(parts), whole) << length;
  }
  EXPECT_EQ(before, 3U);
}

TEST(Journal, DamagedPartsAreNotTaken) {
  const std::string path = output(), parts = left_behind(path, "command"), whole = read_raw_file(parts);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    std::ofstream(parts, std::ios::binary) << damaged;
    const Journal journal(path, "command");
    EXPECT_LT(journal.size(), 3U) << at;
    EXPECT_EQ(journal.find("a").value_or("bytes of a"), "bytes of a") << at;
  }
}

TEST(Journal, ReplacesNothingElse) {
  const std::string path = output();
  fs::create_directory(path + ".pelage-parts");
  Journal in_place_of_a_folder(path, "command");
  test::expect_error(Fault::output, "cannot write", [&] { in_place_of_a_folder.add("a", "bytes"); });
  in_place_of_a_folder.finish();
  EXPECT_TRUE(fs::is_directory(path + ".pelage-parts"));
  fs::remove(path + ".pelage-parts");
  std::ofstream(path + ".other") << "mine";
  fs::create_symlink(path + ".other", path + ".pelage-parts");
  Journal through_a_link(path, "command");
  test::expect_error(Fault::output, "cannot write", [&] { through_a_link.add("a", "bytes"); });
  EXPECT_EQ(read_raw_file(path + ".other"), "mine");
}

}  // namespace
}  // namespace pelage
