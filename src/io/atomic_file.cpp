#include "io/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

std::string follow_links(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored)) return path;
  const fs::path target = fs::weakly_canonical(path, ignored);
  return ignored ? path : target.string();
}

[[noreturn]] void fail_to_write(const std::string& path, int reason) {
  throw Error(Fault::output, "cannot write: " + std::generic_category().message(reason), {path});
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(follow_links(path)) {
  std::error_code ignored;
  if (fs::is_directory(target_, ignored)) fail(EISDIR);
  // "x": never opens a file that exists, be it the leftover of a killed run or another run's work.
  constexpr int enough_names = 1000;
  for (int attempt = 0; attempt < enough_names && !file_; ++attempt) {
    temporary_ = target_ + ".partial" + (attempt ? std::to_string(attempt) : "");
    file_ = std::fopen(temporary_.c_str(), "wbx");
    if (!file_ && errno != EEXIST) break;
  }
  if (!file_) {
    temporary_.clear();
    fail(errno);
  }
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void AtomicFile::commit() {
  // A full disk may show only here: at the flush, at the sync (delayed allocation, network) or at the close.
  if (std::fflush(file_) != 0 || fsync(fileno(file_)) != 0) fail(errno);
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(errno);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::fail(int reason) const { fail_to_write(path_, reason); }

void write_file(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void check_folder(const std::string& path) {
  fs::path folder = fs::path(follow_links(path)).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(Fault::output, "the folder " + folder.string() + " does not exist; create it first", {path});
  if (fs::is_directory(path, ignored)) fail_to_write(path, EISDIR);
  if (access(folder.c_str(), W_OK) != 0) fail_to_write(path, errno);
}

}  // namespace pelage
