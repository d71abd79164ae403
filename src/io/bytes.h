#pragma once
// Numbers in the bytes of a file.

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "base/checked.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

static_assert(std::endian::native == std::endian::little, "the binary formats are written in the machine's order");

/// Appends the bytes of a number, little-endian.
template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// The little-endian number that begins there; nothing where the bytes end before it does.
template <class T>
std::optional<T> bytes_at(std::string_view bytes, std::size_t at) {
  if (at > bytes.size() || bytes.size() - at < sizeof(T)) return {};
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// Appends a value of an attribute as the file has it; it must be one of the type.
inline void append_number(std::string& bytes, NumberType type, double value) {
  switch (type) {
    case NumberType::float32:
      return append_bytes(bytes, static_cast<float>(value));
    case NumberType::float64:
      return append_bytes(bytes, value);
    case NumberType::int8:
      return append_bytes(bytes, saturated<std::int8_t>(value));
    case NumberType::uint8:
      return append_bytes(bytes, saturated<std::uint8_t>(value));
    case NumberType::int16:
      return append_bytes(bytes, saturated<std::int16_t>(value));
    case NumberType::uint16:
      return append_bytes(bytes, saturated<std::uint16_t>(value));
    case NumberType::int32:
      return append_bytes(bytes, saturated<std::int32_t>(value));
    case NumberType::uint32:
      return append_bytes(bytes, saturated<std::uint32_t>(value));
  }
}

/// Appends the shortest decimal text that reads back as the same number.
template <class T>
void append_text(std::string& text, T value) {
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end.ptr);
}

}  // namespace pelage
