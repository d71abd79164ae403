#include "io/temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

/// A file of that name which belongs to this user and no other process holds; -1 and errno if there can be none.
int open_locked(const std::string& name) {
  for (;;) {
    const int file = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) return -1;
    struct stat about {};
    const bool mine = fstat(file, &about) == 0 && S_ISREG(about.st_mode) && about.st_uid == geteuid();
    const bool locked = mine && lock_file(file);
    // Another run may have put it in its place between the opening and the lock.
    if (locked && is_at(file, name) && ::ftruncate(file, 0) == 0) return file;
    ::close(file);
    if (!mine || !locked) {
      errno = mine ? EWOULDBLOCK : EPERM;
      return -1;
    }
  }
}

}  // namespace

bool is_at(int file, const std::string& name) {
  struct stat open {
  }, there{};
  return fstat(file, &open) == 0 && lstat(name.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
         open.st_dev == there.st_dev;
}

void fail_to_write(const std::string& path, int reason) {
  throw Error(Fault::output, "cannot write: " + std::generic_category().message(reason), {path});
}

std::string true_path(const std::string& path) {
  std::error_code ignored;
  const fs::path target = fs::weakly_canonical(fs::absolute(path), ignored);
  return ignored ? path : target.string();
}

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// A file system without locks is taken as it is.
bool lock_file(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

void sync_folder(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  ::close(file);
}

TemporaryFile::TemporaryFile(const std::string& path)
    : path_(path), target_(true_path(path)), name_(target_ + std::string(partial_extension)) {
  std::error_code ignored;
  const fs::file_status there = fs::status(target_, ignored);
  if (fs::is_directory(there)) fail_to_write(path_, EISDIR);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw Error(Fault::output, "is no regular file, and nothing else is ever replaced", {path_});
  file_ = open_locked(name_);
  if (file_ >= 0) return;
  if (errno == EWOULDBLOCK)
    throw Error(Fault::output, "another run is writing this file; wait for its end, or give another name", {path_});
  fail_to_write(path_, errno);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      name_(std::exchange(other.name_, "")),
      file_(std::exchange(other.file_, -1)) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
  if (this == &other) return *this;
  drop();
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  name_ = std::exchange(other.name_, "");
  file_ = std::exchange(other.file_, -1);
  return *this;
}

TemporaryFile::~TemporaryFile() { drop(); }

/// The name goes before the lock.
void TemporaryFile::drop() {
  if (!name_.empty()) ::unlink(name_.c_str());
  if (file_ >= 0) ::close(file_);
}

void TemporaryFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_to_write(path_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A full disk may show only here: delayed allocation, network.
void TemporaryFile::sync() {
  if (fsync(file_) != 0) fail_to_write(path_, errno);
}

void TemporaryFile::put_in_place() {
  if (std::rename(name_.c_str(), target_.c_str()) != 0) fail_to_write(path_, errno);
  name_.clear();
  ::close(std::exchange(file_, -1));
}

}  // namespace pelage
