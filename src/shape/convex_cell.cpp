#include "shape/convex_cell.h"

#include <algorithm>
#include <limits>

namespace pelage {

namespace {

std::int32_t first_vertex(const ConvexCell& cell) {
  std::int32_t first = std::numeric_limits<std::int32_t>::max();
  for (std::size_t f = 0; f < cell.faces; ++f)
    for (std::size_t k = 0; k < cell.face[f].corners; ++k) first = std::min(first, cell.face[f].corner[k]);
  return first;
}

/// Of the face in which the triangle lies; 0 where there is none.
std::uint8_t label_of(const ConvexCell& cell, std::int32_t a, std::int32_t b, std::int32_t c) {
  for (std::size_t f = 0; f < cell.faces; ++f) {
    const ConvexCell::Face& face = cell.face[f];
    if (face.has(a) && face.has(b) && face.has(c)) return face.label;
  }
  return 0;
}

}  // namespace

bool ConvexCell::Face::has(std::int32_t vertex) const {
  const auto* end = corner.begin() + corners;
  return std::find(corner.begin(), end, vertex) != end;
}

void ConvexCell::add_face(std::span<const std::int32_t> loop, std::uint8_t label) {
  Face& next = face[faces];
  next = {{}, 0, label};
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (loop[k] != loop[(k + 1) % loop.size()]) next.corner[next.corners++] = loop[k];
  if (next.corners >= 3) ++faces;
}

void append_tets(const ConvexCell& cell, std::vector<LabelledTet>& tets) {
  const std::int32_t apex = first_vertex(cell);
  for (std::size_t f = 0; f < cell.faces; ++f) {
    const ConvexCell::Face& face = cell.face[f];
    if (face.has(apex)) continue;
    const auto* const end = face.corner.begin() + face.corners;
    const auto first = static_cast<std::size_t>(std::min_element(face.corner.begin(), end) - face.corner.begin());
    const auto at = [&](std::size_t k) { return face.corner[(first + k) % face.corners]; };
    for (std::size_t k = 1; k + 1 < face.corners; ++k) {
      const std::int32_t a = at(0), b = at(k), c = at(k + 1);
      tets.push_back(
          {{apex, a, b, c},
           {face.label, label_of(cell, apex, b, c), label_of(cell, apex, a, c), label_of(cell, apex, a, b)}});
    }
  }
}

}  // namespace pelage
