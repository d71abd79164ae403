#pragma once
// Appending numbers to the bytes of a file.

#include <bit>
#include <charconv>
#include <cstring>
#include <string>

namespace pelage {

static_assert(std::endian::native == std::endian::little, "the binary formats are written in the machine's order");

/// Appends the bytes of a number, little-endian.
template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// Appends the shortest decimal text that reads back as the same number.
template <class T>
void append_text(std::string& text, T value) {
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end.ptr);
}

}  // namespace pelage
