#include "shape/soup_orient.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "shape/enclosures.h"
#include "shape/soup_contacts.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

class SoupOrientation {
 public:
  SoupOrientation(const TriangleMesh& mesh, const SoupContacts& contacts) : contacts_(contacts.of) {
    for (const Triangle& t : mesh.triangles) {
      const auto corner = [&](std::size_t k) { return mesh.points[at(t[k])]; };
      area_.push_back(length(cross(difference(corner(1), corner(0)), difference(corner(2), corner(0)))));
    }
  }

  /// Which triangles to reverse.
  std::vector<char> reversed() const {
    std::vector<char> reverse(area_.size(), 0), done = reverse;
    for (std::size_t f = 0; f < reverse.size(); ++f) {
      if (done[f]) continue;
      const std::vector<std::size_t> piece = spread(f, reverse, done);
      double kept = 0;
      for (const std::size_t t : piece) kept += (reverse[t] ? -1 : 1) * area_[t];
      if (kept < 0)
        for (const std::size_t t : piece) reverse[t] = !reverse[t];
    }
    return reverse;
  }

 private:
  /// Over the longest contacts first; the triangles that were reached.
  std::vector<std::size_t> spread(std::size_t first, std::vector<char>& reverse, std::vector<char>& done) const {
    struct Step {
      double length;
      std::size_t to;
      bool reverse;
      bool operator<(const Step& s) const { return length != s.length ? length < s.length : to > s.to; }
    };
    std::priority_queue<Step> open;
    std::vector<std::size_t> piece;
    open.push({0, first, false});
    while (!open.empty()) {
      const Step step = open.top();
      open.pop();
      if (done[step.to]) continue;
      done[step.to] = 1;
      reverse[step.to] = step.reverse;
      piece.push_back(step.to);
      for (const SoupContact& c : contacts_[step.to])
        open.push({std::abs(c.length), at(c.other), step.reverse != (c.length < 0)});
    }
    return piece;
  }

  const std::vector<std::vector<SoupContact>>& contacts_;
  std::vector<double> area_;  ///< twice that of the triangles
};

/// The last two corners change places.
void reverse_triangle(TriangleMesh& mesh, std::size_t f) {
  std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  for (Attribute& a : mesh.attributes) {
    if (a.domain != Domain::corner) continue;
    const std::size_t n = at(a.components);
    const auto second = a.values.begin() + static_cast<std::ptrdiff_t>(n * (3 * f + 1));
    std::swap_ranges(second, second + static_cast<std::ptrdiff_t>(n), second + static_cast<std::ptrdiff_t>(n));
  }
}

std::size_t reverse_triangles(TriangleMesh& mesh, const std::vector<char>& which) {
  for (std::size_t f = 0; f < which.size(); ++f)
    if (which[f]) reverse_triangle(mesh, f);
  return static_cast<std::size_t>(std::ranges::count(which, 1));
}

/// Of parts that others may reach into.
std::vector<char> inside_out(const TriangleMesh& mesh, const SoupContacts& contacts) {
  const Enclosures enclosures(mesh, contacts);
  std::vector<char> result;
  for (const std::int32_t p : enclosures.part()) result.push_back(enclosures.inside_out(p));
  return result;
}

}  // namespace

std::size_t orient_soup(TriangleMesh& mesh) {
  SoupContacts contacts = soup_contacts(mesh);
  const std::size_t reversed = reverse_triangles(mesh, SoupOrientation(mesh, contacts).reversed());
  if (reversed > 0) contacts = soup_contacts(mesh);
  return reversed + reverse_triangles(mesh, inside_out(mesh, contacts));
}

}  // namespace pelage
