#include "io/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "io/output_set.h"
#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

TemporaryFile temporary_for(const std::string& path) {
  OutputSet* set = OutputSet::current();
  return set ? set->take(path) : TemporaryFile(path);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path, Appearance appearance)
    : appearance_(appearance), file_(temporary_for(path)) {}

void AtomicFile::commit() {
  OutputSet* set = OutputSet::current();
  if (set && appearance_ == Appearance::with_the_others) return set->keep(std::move(file_));
  file_.sync();
  file_.put_in_place();
  sync_folder(folder_of(file_.target()));
  if (set) set->reserve(file_.path());  // for the next time
}

void write_file(const std::string& path, std::string_view bytes, Appearance appearance) {
  AtomicFile file(path, appearance);
  file.write(bytes);
  file.commit();
}

void expect_output(const std::string& path) {
  std::error_code ignored;
  const std::string folder = folder_of(fs::is_symlink(path, ignored) ? true_path(path) : path);
  if (!fs::is_directory(folder, ignored))
    throw Error(Fault::output, "the folder " + folder + " does not exist; create it first", {path});
  if (fs::is_directory(path, ignored)) fail_to_write(path, EISDIR);
  if (access(folder.c_str(), W_OK) != 0) fail_to_write(path, errno);
  if (OutputSet* set = OutputSet::current()) set->reserve(path);
}

}  // namespace pelage
