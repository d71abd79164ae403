#pragma once
// A whole file in memory.

#include <string>

namespace pelage {

/// The bytes of a file. Throws Error(Fault::input) if it cannot be read, is a directory, or is compressed.
std::string read_file(const std::string& path);

/// The same of a file of our own, such as a checkpoint, which may be written anew while it is in use: nobody is told of
/// it (base/read_files.h).
std::string read_own_file(const std::string& path);

/// The same of any file at all, compressed or empty, of which nobody is told either.
std::string read_raw_file(const std::string& path);

/// Throws as read_file() does for a path that is no file or cannot be opened.
void require_file(const std::string& path);

/// ".png" of "a.PNG": how the name ends, in lower case.
std::string lower_extension(const std::string& path);

}  // namespace pelage
