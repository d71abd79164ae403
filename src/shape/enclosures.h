#pragma once
// Parts of a soup that enclose something, and what lies inside of them.

#include <cstdint>
#include <memory>
#include <vector>

#include "base/box.h"
#include "shape/closest_point.h"
#include "shape/soup_contacts.h"
#include "shape/winding_tree.h"

namespace pelage {

/// A part is what hangs together by its vertices, edges and cracks. It encloses something if it is closed, or if all of
/// its openings lie inside others that do: as a leg without an upper end, stuck into a body.
class Enclosures {
 public:
  Enclosures(const TriangleMesh& mesh, const SoupContacts& contacts);

  std::size_t parts() const { return box_.size(); }
  /// Whether anything may lie inside another part.
  bool any_meet() const;
  const std::vector<std::int32_t>& part() const { return part_; }  ///< per triangle
  /// Those that enclose something and whose boxes meet that of a part.
  const std::vector<std::int32_t>& around(std::int32_t part) const { return around_[index(part)]; }
  bool inside(std::int32_t part, const Point& p) const;
  /// Whether its surface, openings included, passes within a distance [world units].
  bool passes(std::int32_t part, const Point& p, double within) const {
    return solid_[index(part)]->distance.any_within(p, within);
  }
  /// Whether a part encloses something and has its front sides inside.
  bool inside_out(std::int32_t part) const { return solid_[index(part)] && solid_[index(part)]->volume < 0; }

 private:
  struct Solid {
    DistanceTree distance;
    WindingTree winding;
    double volume;
  };
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }
  void number_parts(const TriangleMesh& mesh, const SoupContacts& contacts);
  void find_neighbours();
  bool is_closed_by_others(std::int32_t part, const std::vector<Point>& openings) const;
  void close(std::int32_t part, const TriangleMesh& mesh, const std::vector<std::int32_t>& faces,
             const std::vector<std::int32_t>& open);

  std::vector<std::int32_t> part_;
  std::vector<Box> box_;
  std::vector<std::vector<std::int32_t>> around_;
  std::vector<std::unique_ptr<const Solid>> solid_;  ///< null: encloses nothing, or meets nobody
};

}  // namespace pelage
