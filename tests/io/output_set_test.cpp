#include "io/output_set.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "base/read_files.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/publication.h"
#include "io/written_meshes.h"
#include "support/expect_error.h"

namespace pelage {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

using Names = std::vector<std::string>;

/// Does it in another process, which then dies without any cleaning up.
template <class Work>
void killed_after(Work&& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
}

TEST(OutputSet, AllAppearTogether) {
  const fs::path folder = test::fresh_folder(), a = folder / "a", b = folder / "b";
  OutputSet set;
  write_file(a.string(), "new a");
  write_file(b.string(), "new b");
  EXPECT_FALSE(fs::exists(a) || fs::exists(b));
  set.publish();
  EXPECT_EQ(read_file(a.string()), "new a");
  EXPECT_EQ(names_in(folder), (Names{"a", "b"}));
}

TEST(OutputSet, WithoutPublishingTheOldFilesStay) {
  const fs::path folder = test::fresh_folder(), a = folder / "a";
  write_file(a.string(), "old");
  {
    OutputSet set;
    expect_output((folder / "b").string());
    write_file(a.string(), "new");
  }
  EXPECT_EQ(read_file(a.string()), "old");
  EXPECT_EQ(names_in(folder), Names{"a"});
}

TEST(OutputSet, FilesAtOnceDoNotWait) {
  const fs::path folder = test::fresh_folder(), state = folder / "state";
  OutputSet set;
  expect_output(state.string());
  for (const char* text : {"one", "two"}) {
    write_file(state.string(), text, Appearance::at_once);
    EXPECT_EQ(read_own_file(state.string()), text);
  }
}

TEST(OutputSet, NoTwoOutputsAndNoInputAreTheSameFile) {
  const fs::path folder = test::fresh_folder(), a = folder / "a", b = folder / "b";
  write_file(a.string(), "input");
  fs::create_symlink("a", folder / "link");
  OutputSet set;
  expect_output(b.string());
  expect_error(Fault::usage, "two outputs", [&] { expect_output((folder / "./b").string()); });
  expect_error(Fault::usage, "two outputs", [&] {
    write_file(b.string(), "x");
    write_file(b.string(), "y");
  });
  read_file(a.string());
  expect_error(Fault::usage, "is an input itself", [&] { expect_output((folder / "link").string()); });
  expect_output((folder / "c").string());
  expect_error(Fault::usage, "is an input itself", [&] { note_reading((folder / "c").string()); });
}

TEST(OutputSet, ForceReplacesInputs) {
  const fs::path folder = test::fresh_folder(), a = folder / "a";
  write_file(a.string(), "old");
  OutputSet set({.may_replace_inputs = true});
  expect_output(a.string());
  write_file(a.string(), read_file(a.string()) + " and new");
  set.publish();
  EXPECT_EQ(read_file(a.string()), "old and new");
}

TEST(OutputSet, AnotherRunIsRefused) {
  const fs::path folder = test::fresh_folder(), a = folder / "a";
  OutputSet set;
  expect_output(a.string());
  // A second open file has a lock of its own, as another process has.
  expect_error(Fault::output, "another run is writing", [&] { TemporaryFile second(a.string()); });
}

TEST(OutputSet, WhatIsNoRegularFileIsNeverReplaced) {
  const fs::path folder = test::fresh_folder(), pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_error(Fault::output, "no regular file", [&] { write_file(pipe.string(), "x"); });
  EXPECT_TRUE(fs::is_fifo(pipe));
}

/// A link in the place of the temporary file would have us write elsewhere.
TEST(OutputSet, TemporaryFilesAreNoLinks) {
  const fs::path folder = test::fresh_folder(), other = folder / "other", a = folder / "a";
  write_file(other.string(), "precious");
  fs::create_symlink("other", a.string() + ".pelage-partial");
  expect_error(Fault::output, "cannot write", [&] { write_file(a.string(), "x"); });
  EXPECT_EQ(read_file(other.string()), "precious");
}

TEST(OutputSet, LeftoversOfKilledRunsGo) {
  const fs::path folder = test::fresh_folder();
  killed_after([&] {
    static OutputSet set;
    expect_output((folder / "a").string());
    write_file((folder / "b").string(), "half of the set");
  });
  EXPECT_EQ(names_in(folder), (Names{"a.pelage-partial", "b.pelage-partial"}));
  OutputSet set;
  expect_output((folder / "c").string());
  EXPECT_EQ(names_in(folder), Names{"c.pelage-partial"});
}

/// Killed between the list and the first renaming, and after each of them: the next run makes the set whole.
TEST(OutputSet, AKilledPublicationIsFinished) {
  for (int renamed = 0; renamed <= 2; ++renamed) {
    const fs::path folder = test::fresh_folder();
    for (const char* name : {"a", "b"}) write_file((folder / name).string(), "old");
    std::string list = "pelage set 1\n";
    for (const char* name : {"a", "b"}) list += (folder / name).string() + ".pelage-partial" + '\0';
    write_file((folder / "a.pelage-set").string(), list + "end");
    for (int k = 0; k < 2; ++k) {
      const std::string name = (folder / (k ? "b" : "a")).string();
      write_file(k < renamed ? name : name + ".pelage-partial", "new");
    }
    clear_leftovers(folder.string());
    EXPECT_EQ(names_in(folder), (Names{"a", "b"})) << renamed;
    for (const char* name : {"a", "b"}) EXPECT_EQ(read_file((folder / name).string()), "new") << renamed << name;
  }
}

TEST(OutputSet, AListThatIsCutShortOrForeignDoesNothing) {
  const fs::path folder = test::fresh_folder(), other = folder / "other";
  write_file(other.string(), "precious");
  for (const std::string& list :
       {std::string("pelage set 1\n"), "pelage set 1\n" + (folder / "a.pelage-partial").string() + '\0',
        "pelage set 1\n" + other.string() + '\0' + "end", std::string("x")}) {
    write_file((folder / "a.pelage-set").string(), list);
    write_file((folder / "a.pelage-partial").string(), "half");
    clear_leftovers(folder.string());
    EXPECT_EQ(names_in(folder), Names{"other"}) << list;
  }
  EXPECT_EQ(read_file(other.string()), "precious");
}

/// A run that is alive holds a lock on its temporary files.
TEST(OutputSet, LivingRunsAreLeftAlone) {
  const fs::path folder = test::fresh_folder();
  TemporaryFile living((folder / "a").string());
  living.write("half");
  clear_leftovers(folder.string());
  EXPECT_EQ(names_in(folder), Names{"a.pelage-partial"});
  const TemporaryFile other((folder / "b").string());
  const std::string list =
      "pelage set 1\n" + living.name() + '\0' + other.name() + '\0' + "end";  // it is about to rename them
  write_file((folder / "a.pelage-set").string(), list);
  clear_leftovers(folder.string());
  EXPECT_EQ(names_in(folder), (Names{"a.pelage-partial", "a.pelage-set", "b.pelage-partial"}));
}

/// Seen where the second renaming fails.
TEST(OutputSet, AListStandsWhileTwoFilesAreRenamed) {
  const fs::path folder = test::fresh_folder();
  std::vector<TemporaryFile> files;
  for (const char* name : {"a", "b"}) files.emplace_back((folder / name).string());
  fs::create_directories(folder / "b" / "in the way");
  expect_error(Fault::output, "cannot write", [&] { put_all_in_place(std::move(files)); });
  EXPECT_EQ(names_in(folder), (Names{"a", "a.pelage-set", "b"}));
}

}  // namespace
}  // namespace pelage
