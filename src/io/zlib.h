#pragma once
// The compression of PNG, EXR and VTK.

#include <optional>
#include <string>
#include <string_view>

namespace pelage {

/// A zlib stream (RFC 1950).
std::string zlib_packed(std::string_view bytes);

/// The `size` bytes that a zlib stream holds; nothing if it is damaged or holds another number. Takes no memory for
/// more than deflate can make of so many bytes, which is 1032 times as many.
std::optional<std::string> zlib_unpacked(std::string_view stream, std::size_t size);

}  // namespace pelage
