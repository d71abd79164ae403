#include "io/raw_texture.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "io/bytes.h"
#include "io/write_mesh.h"
#include "pelage/error.h"

namespace pelage {

std::string raw_texture_bytes(const Grid& block) {
  const Attribute* color = block.find("color");
  if (block.dimension() != 3 || !color || color->components < 3)
    throw Error(Fault::usage, "a raw texture holds the colours of a block, which the grid has not");
  require_finite({}, {*color});
  const Attribute* inside = block.find("inside");
  const auto n = static_cast<std::size_t>(color->components);
  std::string bytes;
  bytes.reserve(4 * block.nodes());
  for (std::size_t v = 0; v < block.nodes(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) append_bytes(bytes, srgb_byte(color->values[n * v + k]));
    const double own = n > 3 ? std::clamp(color->values[n * v + 3], 0.0, 1.0) : 1;
    const double alpha = inside && inside->components == 1 && inside->values[v] == 0 ? 0 : own;
    append_bytes(bytes, static_cast<std::uint8_t>(std::lround(255 * alpha)));
  }
  return bytes;
}

std::string raw_texture_form(const Grid& block) {
  const auto& [nx, ny, nz] = block.count;
  return std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz) +
         " texels of 4 bytes (red, green, blue in sRGB, alpha), x fastest, then y, then z";
}

}  // namespace pelage
