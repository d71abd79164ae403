#pragma once
// OpenEXR: numbers as pictures, 32 bits each.

#include <string>
#include <vector>

namespace pelage {

/// The bytes of an EXR file (single part, scan lines, compressed by ZIP): a channel of 32-bit floats for each plane, of
/// which pixel (x, y), counted from the top left corner, is planes[k][y * width + x]. "R", "G" and "B" are the colours,
/// in linear light, that programs show; a dot in a name makes a layer. Errors: Fault::usage for an empty name and one
/// that is there twice; Fault::numerics for a value that is not finite. `path` is for messages.
std::string exr_bytes(const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes, int width,
                      int height, const std::string& path = "");

/// The file appears whole or not at all; Fault::output when it cannot be written.
void write_exr(const std::string& path, const std::vector<std::string>& names,
               const std::vector<std::vector<float>>& planes, int width, int height);

}  // namespace pelage
