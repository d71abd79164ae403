#pragma once
// The compression of PNG, EXR, VTK and ZIP: deflate.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pelage {

/// A zlib stream (RFC 1950), made quickly.
std::string zlib_packed(std::string_view bytes);

/// The `size` bytes that a zlib stream holds; nothing if it is damaged or holds another number. Takes no memory for
/// more than deflate can make of so many bytes, which is 1032 times as many.
std::optional<std::string> zlib_unpacked(std::string_view stream, std::size_t size);

/// The same of deflate alone (RFC 1951), packed more tightly.
std::string deflated(std::string_view bytes);
std::optional<std::string> inflated(std::string_view stream, std::size_t size);

/// The check sum of PNG and ZIP.
std::uint32_t crc32(std::string_view bytes);

}  // namespace pelage
