#pragma once
// Numbers as people read them.

#include <cstdint>
#include <string>

#include "base/number.h"
#include "pelage/io.h"

namespace pelage {

/// Three significant digits.
std::string brief(double value);

/// "812 bytes", "3.1 MB" (powers of 1000).
std::string file_size(std::uintmax_t bytes);

/// "0.8 s", "42 s", "3 min 5 s", "2 h 10 min".
std::string duration(double seconds);

/// The text with its line breaks turned into blanks, and other control characters into question marks.
std::string one_line(std::string text);

/// The name of the shape in files that name it: that of the file's only object, else "cow" for models/cow.obj and for
/// builtin:cow?n=900.
std::string object_name(const ShapeFile& file, const std::string& path);

/// The text, broken at blanks into lines of at most `width` characters, each after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width = 100);

}  // namespace pelage
