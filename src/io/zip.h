#pragma once
// ZIP archives, as documents are packed in.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

struct ZipEntry {
  std::string name;  ///< with its folders, "3D/3dmodel.model"
  std::string_view bytes;
};

/// The archive, each file of it deflated (PKWARE's APPNOTE 6.3); the same bytes for the same files, which have the
/// earliest date that there is. Error(Fault::output) for 4 GB or more.
std::string zip_archive(const std::vector<ZipEntry>& entries);

/// The bytes of a file in such an archive; nothing where it is not there or is damaged. Takes no memory for more than
/// deflate can make of so many bytes.
std::optional<std::string> zip_entry(std::string_view archive, std::string_view name);

}  // namespace pelage
