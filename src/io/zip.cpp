#include "io/zip.h"

#include <cstdint>
#include <limits>

#include "io/bytes.h"
#include "io/zlib.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::uint32_t size32(std::size_t size) {
  if (size >= std::numeric_limits<std::uint32_t>::max())
    throw Error(Fault::output, "a ZIP archive holds less than 4 GB; take another format, or fewer triangles");
  return static_cast<std::uint32_t>(size);
}

/// What stands both before a file and in the directory.
std::string facts_of(const ZipEntry& entry, const std::string& packed) {
  constexpr std::uint16_t version = 20, flags = 0, deflate = 8, time = 0, date = 1 << 5 | 1;  // 1 January 1980
  std::string facts;
  for (const std::uint16_t field : {version, flags, deflate, time, date}) append_bytes(facts, field);
  append_bytes(facts, crc32(entry.bytes));
  append_bytes(facts, size32(packed.size()));
  append_bytes(facts, size32(entry.bytes.size()));
  append_bytes(facts, static_cast<std::uint16_t>(entry.name.size()));
  append_bytes(facts, std::uint16_t{0});  // no extra field
  return facts;
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
  std::string archive, directory;
  for (const ZipEntry& entry : entries) {
    const std::string packed = deflated(entry.bytes), facts = facts_of(entry, packed);
    directory += "PK\1\2";
    append_bytes(directory, std::uint16_t{20});  // version of the writer
    directory += facts;
    for (int field = 0; field < 3; ++field) append_bytes(directory, std::uint16_t{0});  // no comment, disk 0, binary
    append_bytes(directory, std::uint32_t{0});                                          // no attributes
    append_bytes(directory, size32(archive.size()));
    directory += entry.name;
    archive += "PK\3\4" + facts + entry.name + packed;
  }
  const std::uint32_t begin = size32(archive.size());
  const auto count = static_cast<std::uint16_t>(entries.size());
  archive += directory + "PK\5\6";
  for (const std::uint16_t field : {std::uint16_t{0}, std::uint16_t{0}, count, count}) append_bytes(archive, field);
  append_bytes(archive, size32(directory.size()));
  append_bytes(archive, begin);
  append_bytes(archive, std::uint16_t{0});  // no comment
  return archive;
}

std::optional<std::string> zip_entry(std::string_view archive, std::string_view name) {
  constexpr std::size_t head = 30;
  for (std::size_t at = 0; archive.size() - at > head && archive.substr(at).starts_with("PK\3\4");) {
    const std::size_t packed = *bytes_at<std::uint32_t>(archive, at + 18),
                      size = *bytes_at<std::uint32_t>(archive, at + 22),
                      letters = *bytes_at<std::uint16_t>(archive, at + 26),
                      begin = at + head + letters + *bytes_at<std::uint16_t>(archive, at + 28);
    if (begin > archive.size() || packed > archive.size() - begin) return {};
    if (archive.substr(at + head, letters) == name) return inflated(archive.substr(begin, packed), size);
    at = begin + packed;
  }
  return {};
}

}  // namespace pelage
