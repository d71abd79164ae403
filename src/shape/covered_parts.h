#pragma once
// What of a soup lies inside of other parts of it, where nobody sees it.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pelage/triangle_mesh.h"
#include "shape/enclosures.h"

namespace pelage {

/// Parts that lie wholly inside others count as seen: as behind glass. Of two sheets in one place that face the same
/// way the later one is covered.
class CoveredParts {
 public:
  /// A piece of a triangle; its corners are places (1-v-w) a + v b + w c on it.
  struct Piece {
    std::int32_t face;
    std::array<std::array<double, 2>, 3> corner;
  };

  /// Null where nothing is covered. The triangles of the mesh have one side out (orient_soup).
  static std::shared_ptr<const CoveredParts> of(std::shared_ptr<const TriangleMesh> mesh);

  /// Whether a place on a triangle is covered. From several threads.
  bool covers(std::int32_t face, const Point& p) const;
  bool same_part(std::int32_t face, std::int32_t other) const {
    return enclosures_.part()[static_cast<std::size_t>(face)] == enclosures_.part()[static_cast<std::size_t>(other)];
  }
  /// What is seen, in pieces of whole triangles and, where some are covered in part, of small ones.
  const std::vector<Piece>& seen() const { return seen_; }
  double share() const { return share_; }  ///< of the area that is covered

 private:
  enum class State : char { seen, covered, mixed };
  struct Split {
    bool near_others, whole;  ///< whether the surface of another part passes by; whether all of a piece is seen
  };
  CoveredParts(std::shared_ptr<const TriangleMesh> mesh, Enclosures enclosures);
  std::array<Point, 3> corners(std::int32_t face) const;
  std::array<Point, 3> corners(const Piece& piece) const;
  using Parts = std::span<const std::int32_t>;
  Parts around(std::int32_t face) const {
    return enclosures_.around(enclosures_.part()[static_cast<std::size_t>(face)]);
  }
  bool inside_one_of(Parts others, std::int32_t face, const Point& p, double way, std::int32_t end) const;
  bool looks_covered(Parts others, std::int32_t face, const Point& p) const;
  Split split(const Piece& piece, const std::array<Point, 3>& corner, Parts others);
  void keep_whole_parts();

  std::shared_ptr<const TriangleMesh> mesh_;
  Enclosures enclosures_;
  double hair_ = 0;           ///< nearer than that, places of two sheets are one [world units]
  double small_ = 0;          ///< edge of pieces that are not split [world units]
  std::vector<State> state_;  ///< per triangle; mixed: near another part's surface
  std::vector<Piece> seen_;
  double share_ = 0;
};

}  // namespace pelage
