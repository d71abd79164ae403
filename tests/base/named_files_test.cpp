#include "base/named_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace pelage {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder() {
  const fs::path folder = fs::path(testing::TempDir()) / "pelage-named-files";
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// outer/ has a file, and inner/ with a text, a file, a folder and links.
class NamedFiles : public testing::Test {
 protected:
  NamedFiles() {
    fs::create_directories(inner / "deep");
    for (const fs::path& file : {outer / "secret", inner / "own", inner / "deep" / "own"}) std::ofstream(file) << "x";
    fs::create_symlink(outer / "secret", inner / "leads_out");
    fs::create_symlink(outer, inner / "leads_up");
    fs::create_symlink("own", inner / "stays");
    fs::create_directory_symlink(inner, outer / "other_name");
    fs::create_directories(outer / "inner2");
    std::ofstream(outer / "inner2" / "secret") << "x";
  }
  ~NamedFiles() override { allow_outside_files(false); }

  bool may_read(const std::string& name) const { return may_read_beside((inner / "text.toml").string(), name); }

  fs::path outer = fresh_folder(), inner = outer / "inner";
};

TEST_F(NamedFiles, LieInTheFolderOfTheText) {
  for (const std::string name :
       {"own", "./own", "deep/own", "deep/../own", "stays", "missing", "deep/missing", "..dots"})
    EXPECT_TRUE(may_read(name)) << name;
  EXPECT_TRUE(may_read((inner / "own").string()));
  EXPECT_TRUE(may_read("../inner/own"));
}

TEST_F(NamedFiles, NotOutsideHoweverTheWayLeads) {
  for (const std::string name : {"../secret", "deep/../../secret", "leads_out", "leads_up/secret", "leads_up/missing",
                                 "../inner2/secret", "..", "/etc/passwd", "/dev/zero", "missing/../../secret"})
    EXPECT_FALSE(may_read(name)) << name;
  EXPECT_FALSE(may_read((outer / "secret").string()));
}

TEST_F(NamedFiles, TheFolderIsItsOwnWhateverItIsCalled) {
  EXPECT_TRUE(may_read_beside((outer / "other_name" / "text.toml").string(), "own"));
  EXPECT_FALSE(may_read_beside((outer / "other_name" / "text.toml").string(), "../secret"));
  const fs::path before = fs::current_path();
  fs::current_path(inner);
  EXPECT_TRUE(may_read_beside("text.toml", "own"));
  EXPECT_TRUE(may_read_beside("", "own"));  // a text that is no file
  EXPECT_FALSE(may_read_beside("text.toml", "../secret"));
  EXPECT_TRUE(may_read_beside("../text.toml", "inner/own"));
  fs::current_path(before);
  EXPECT_TRUE(may_read_beside("/text.toml", "etc/passwd"));
}

TEST_F(NamedFiles, AreRefusedAtTheirPlaceUnlessTheUserAllowsThem) {
  const Location where{(inner / "text.toml").string(), 3, 7};
  EXPECT_EQ(named_file("own", where), (inner / "own").string());
  try {
    named_file("../secret", where);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), where.file +
                                ":3:7: \"../secret\" is a file which lies outside the folder of this file; copy it "
                                "there, or give --allow-outside");
  }
  allow_outside_files(true);
  EXPECT_EQ(named_file("../secret", where), (inner / "../secret").string());
}

TEST_F(NamedFiles, BuiltInNamesAreNoFiles) {
  const Location where{(inner / "text.toml").string(), 3, 7};
  EXPECT_EQ(named_text("turing", where), "turing");
  EXPECT_EQ(named_text("own.toml:spots", where), (inner / "own.toml:spots").string());
  EXPECT_THROW(named_text("../own.toml", where), Error);
  EXPECT_EQ(named_shape("builtin:animal", where), "builtin:animal");
  EXPECT_EQ(named_shape("", where), "");
  EXPECT_THROW(named_shape("/etc/passwd", where), Error);
}

}  // namespace
}  // namespace pelage
