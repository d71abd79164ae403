#pragma once
// The header of a PLY file: which elements follow, with which properties.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

enum class PlyFormat { ascii, little_endian, big_endian };

/// Bytes of a value.
std::size_t size_of(NumberType type);

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::float32;
  bool list = false;
  NumberType count_type = NumberType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  int line = 0;  ///< of its declaration

  /// Position of the property, or -1.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< texts behind "comment"
  std::size_t size = 0;               ///< bytes up to the data
  int lines = 0;
};

/// Throws Error(Fault::input) with file and line if something is wrong, and if an element promises more than
/// the bytes behind the header can hold.
PlyHeader read_ply_header(std::string_view bytes, const std::string& path);

}  // namespace pelage
