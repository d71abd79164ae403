#pragma once
// What tells files apart.

#include <string>
#include <string_view>

namespace pelage {

/// SHA-256 (FIPS 180-4) in 64 small hexadecimal digits, as sha256sum prints it.
std::string sha256(std::string_view bytes);

}  // namespace pelage
