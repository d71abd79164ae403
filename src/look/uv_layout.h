#pragma once
// Where the faces of a mesh lie in the images that its uv names, and which place of the mesh a texel shows.

#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/mesh_place.h"

namespace pelage {

/// A fault of uv that an image can be baked with all the same.
struct UvNote {
  enum class Kind { degenerate, mirrored, outside, overlapping } kind;
  std::size_t count = 0;  ///< faces
  Index first = 0;        ///< triangle
};

/// Of n x n texels; texel (x, y) is counted from the top left corner. Where whole faces lie in whole tiles beside the
/// first one, each of these is an image of its own (UDIM); where a face lies across the border of tiles, there is one
/// image that repeats.
class UvLayout {
 public:
  /// `uv`: two components, at vertices or corners, v upwards.
  UvLayout(const std::vector<Triangle>& triangles, const Attribute& uv, int size);

  int size() const { return size_; }
  std::size_t face_count() const { return tile_of_face_.size(); }
  int gutter() const { return gutter_; }  ///< texels around charts that show the surface beyond their borders
  bool repeats() const { return repeats_ || tiles_ != std::vector<int>{1001}; }
  const std::vector<int>& tiles() const { return tiles_; }  ///< their numbers, 1001 + u + 10 v; one: a plain image
  std::size_t tile_of(Index face) const { return tile_of_face_[static_cast<std::size_t>(face)]; }
  const std::vector<UvNote>& notes() const { return notes_; }  ///< none of overlaps

  /// A triangle in a tile [texels, x to the right, y downwards].
  struct Placed {
    Index face;
    std::array<std::array<double, 2>, 3> corner;
    std::array<bool, 3> border;  ///< whether the edge from corner k on is one of its chart

    /// The place that texture coordinates name; beyond the triangle as its plane goes on.
    MeshPlace place(double x, double y) const;
  };
  struct Texel {
    int x, y;
    const Placed* shows;
    bool inside;  ///< else in the gutter
  };
  /// The texels of some rows of a tile that show the mesh, row by row. Where faces lie over each other the first one is
  /// shown, and the numbers of the others are appended to `hidden`.
  std::vector<Texel> texels(std::size_t tile, int first_row, int last_row, std::vector<Index>& hidden) const;

 private:
  struct Rows;
  void place(Index face, const std::array<std::array<double, 2>, 3>& uv, const std::array<bool, 3>& border);
  void note(UvNote::Kind kind, Index face);
  void sort_into_bands();

  static constexpr int band = 4;  ///< rows

  int size_, gutter_;
  bool repeats_ = false;
  std::vector<int> tiles_;
  std::vector<std::size_t> tile_of_face_;
  std::vector<std::vector<Placed>> placed_;                      ///< per tile
  std::vector<std::vector<std::vector<std::int32_t>>> in_band_;  ///< per tile and band of rows: numbers of these
  std::vector<UvNote> notes_;
};

/// How long texels of n x n are on a mesh, along the direction in which they are longest: all but `share` of the area
/// have shorter ones. 0 where no face has an area in the image.
double texel_length(const TriangleMesh& mesh, const Attribute& uv, int size, double share);

/// Whether the mesh has uv on which an image can lie.
bool has_uv(const TriangleMesh& shape);

}  // namespace pelage
