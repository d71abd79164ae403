#include "io/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/ascii.h"
#include "base/read_files.h"
#include "pelage/error.h"

namespace pelage {

namespace {

using namespace std::string_view_literals;

/// The name of the compression that the bytes begin with, or nullptr.
const char* compression_of(std::string_view bytes) {
  struct Magic {
    std::string_view bytes;
    const char* name;
  };
  static constexpr Magic magics[] = {{"\x1f\x8b"sv, "gzip"},
                                     {"PK\x03\x04"sv, "zip"},
                                     {"BZh"sv, "bzip2"},
                                     {"\xfd"
                                      "7zXZ\0"sv,
                                      "xz"},
                                     {"\x28\xb5\x2f\xfd"sv, "zstd"}};
  for (const Magic& magic : magics)
    if (bytes.starts_with(magic.bytes)) return magic.name;
  return nullptr;
}

[[noreturn]] void fail(const std::string& path, const std::string& why) { throw Error(Fault::input, why, {path}); }

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_file(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) fail(path, "is a directory, not a file");
  File file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail(path, std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}

}  // namespace

void require_file(const std::string& path) { open_file(path); }

std::string read_file(const std::string& path) {
  note_reading(path);
  std::string bytes = read_own_file(path);
  note_read(path, bytes);
  return bytes;
}

std::string read_raw_file(const std::string& path) {
  const File file = open_file(path);
  std::error_code code;
  // The size is a hint for the memory only: what is read counts, so that pipes work too.
  const std::uintmax_t hint = std::filesystem::file_size(path, code);
  std::string bytes;
  std::size_t size = 0;
  bytes.resize(code ? 65536 : static_cast<std::size_t>(hint) + 1);
  while (const std::size_t got = std::fread(bytes.data() + size, 1, bytes.size() - size, file.get())) {
    size += got;
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  if (std::ferror(file.get())) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  bytes.resize(size);
  return bytes;
}

std::string read_own_file(const std::string& path) {
  std::string bytes = read_raw_file(path);
  if (bytes.empty()) fail(path, "the file is empty");
  if (const char* name = compression_of(bytes))
    fail(path, std::string("is compressed (") + name + "); unpack it first");
  return bytes;
}

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = to_lower(c);
  return extension;
}

}  // namespace pelage
