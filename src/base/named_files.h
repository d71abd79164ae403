#pragma once
// Files that other files name (pelage/named_files.h).

#include <string>

#include "pelage/error.h"
#include "pelage/named_files.h"

namespace pelage {

/// The path of a file that the file `by` names: beside it.
std::string path_beside(const std::string& by, const std::string& name);

/// Whether that path may be read: it lies in the folder of `by` or below it, where links and ".." lead, or files
/// outside are allowed.
bool may_read_beside(const std::string& by, const std::string& name);

/// What to do about one that may not; ends a message.
inline constexpr const char* outside_hint =
    "which lies outside the folder of this file; copy it there, or give --allow-outside";

/// path_beside() of the file that a text names at this place; Error(Fault::usage), located there, if it may not be
/// read.
std::string named_file(const std::string& name, const Location& where);

/// The same where a text names something built in or a .toml file, maybe with a variant behind a colon.
std::string named_text(const std::string& name, const Location& where);

/// The same where it names a shape, built in or a file.
std::string named_shape(const std::string& name, const Location& where);

}  // namespace pelage
