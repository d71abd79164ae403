#include "io/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "base/fingerprint.h"
#include "io/bytes.h"
#include "io/file_bytes.h"
#include "io/temporary_file.h"

namespace pelage {

namespace {

/// The name of the first part, which is the record of the command. It tells the format as well.
constexpr std::string_view heading = "pelage parts 1";

struct Part {
  std::string_view name, bytes;
  std::size_t end = 0;  ///< where the next one begins
};

std::uint64_t checksum(std::string_view name, std::string_view bytes) {
  return Fingerprint().add(name).add(bytes).value();
}

/// The part that begins there, if it is whole: two lengths, the name, the bytes, the checksum.
std::optional<Part> part_at(std::string_view file, std::size_t at) {
  const auto name_length = bytes_at<std::uint64_t>(file, at), length = bytes_at<std::uint64_t>(file, at + 8);
  if (!name_length || !length) return {};
  at += 16;
  if (*name_length > file.size() - at || *length > file.size() - at - *name_length) return {};
  const Part part{file.substr(at, *name_length), file.substr(at + *name_length, *length),
                  at + *name_length + *length + 8};
  const auto sum = bytes_at<std::uint64_t>(file, part.end - 8);
  if (!sum || *sum != checksum(part.name, part.bytes)) return {};
  return part;
}

}  // namespace

Journal::Journal(const std::string& output, std::string record)
    : path_(output + ".pelage-parts"), record_(std::move(record)) {
  std::error_code ignored;
  if (!record_.empty() && std::filesystem::is_regular_file(path_, ignored)) read();
}

Journal::~Journal() {
  if (file_ >= 0) ::close(file_);
}

void Journal::read() {
  const std::string file = read_raw_file(path_);
  auto part = part_at(file, 0);
  if (!part || part->name != heading || part->bytes != record_) return;
  for (; part; part = part_at(file, sound_)) {
    if (sound_ > 0) parts_[std::string(part->name)] = part->bytes;
    sound_ = part->end;
  }
}

std::optional<std::string> Journal::find(const std::string& part) const {
  const std::lock_guard lock(mutex_);
  const auto found = parts_.find(part);
  if (found == parts_.end()) return {};
  return found->second;
}

std::size_t Journal::size() const {
  const std::lock_guard lock(mutex_);
  return parts_.size();
}

void Journal::open() {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file_ < 0 || ::ftruncate(file_, static_cast<off_t>(sound_)) != 0) fail_to_write(path_, errno);
  if (sound_ == 0) append(heading, record_);
}

void Journal::append(std::string_view name, std::string_view bytes) {
  std::string part;
  append_bytes(part, std::uint64_t{name.size()});
  append_bytes(part, std::uint64_t{bytes.size()});
  part += name;
  part += bytes;
  append_bytes(part, checksum(name, bytes));
  for (std::string_view rest = part; !rest.empty();) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_to_write(path_, errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Journal::add(const std::string& part, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (record_.empty()) return;
  if (file_ < 0) open();
  append(part, bytes);
  if (::fdatasync(file_) != 0) fail_to_write(path_, errno);
  parts_[part] = bytes;
}

void Journal::finish() {
  const std::lock_guard lock(mutex_);
  if (file_ < 0 && sound_ == 0) return;  // what is there may be anything
  ::unlink(path_.c_str());
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

}  // namespace pelage
