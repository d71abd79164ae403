#pragma once
// What can be known before a picture is written (pelage/io.h).

#include <cstdint>
#include <string>

namespace pelage {

/// Refuses a name that does not end in .png (Fault::usage) or whose folder cannot be written to
/// (Fault::output): to be asked before the picture is made.
void check_picture_path(const std::string& path);

/// Refuses a picture of so many pixels that its file could not be written (Fault::usage): the same.
void check_picture_size(std::int64_t width, std::int64_t height, const std::string& path);

}  // namespace pelage
