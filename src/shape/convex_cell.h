#pragma once
// Convex cells cut into tetrahedra that fit together where cells share a face.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pelage/tet_mesh.h"

namespace pelage {

/// A cell with at most six faces of three or four corners each.
struct ConvexCell {
  struct Face {
    std::array<std::int32_t, 4> corner{};  ///< vertex numbers, counter-clockwise from outside
    std::size_t corners = 0;
    std::uint8_t label = 0;
    bool has(std::int32_t vertex) const;
  };
  std::array<Face, 6> face{};
  std::size_t faces = 0;

  /// Adds a face without the corners that follow their own copy; one of fewer than three that are left is none.
  void add_face(std::span<const std::int32_t> loop, std::uint8_t label);
};

/// A tetrahedron (positive where the cell is) with the label of the cell's face that the side opposite to each corner
/// lies in; 0 inside of the cell.
struct LabelledTet {
  Tetrahedron corner;
  std::array<std::uint8_t, 4> label;
};

/// Appends the tetrahedra between the corner of the smallest number and the faces that it is not on, each cut from its
/// own corner of the smallest number: so neighbours cut the face between them alike, whatever they are.
void append_tets(const ConvexCell& cell, std::vector<LabelledTet>& tets);

}  // namespace pelage
