#include "shape/orient.h"

#include <string>

namespace pelage {

namespace {

/// Six times the volume between a triangle and a point.
double volume_under(const TriangleMesh& mesh, std::size_t face, const Point& origin) {
  Point r[3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) r[k][i] = mesh.points[mesh.triangles[face][k]][i] - origin[i];
  return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) + r[0][1] * (r[1][2] * r[2][0] - r[1][0] * r[2][2]) +
         r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

class Orienter {
 public:
  Orienter(const NumberedMesh& work, const std::vector<HalfEdge>& opposite)
      : work_(work), mesh_(work.mesh), opposite_(opposite), flip(work.mesh.triangles.size(), unseen) {}

  /// Orients the component of a face, unless that is done.
  void component_of(std::size_t face) {
    if (flip[face] != unseen) return;
    collect(face);
    std::size_t reversed = 0;
    for (std::size_t f : component_) reversed += flip[f];
    const bool most = 2 * reversed > component_.size();
    if (most) turn_component();
    for (std::size_t f : component_)
      if (flip[f]) note(flipped, f);
    if (closed_ && volume() < 0) {
      turn_component();
      note(inward, face);
    }
  }

  void report(std::vector<Finding>& findings) {
    if (flipped.count > 0) {
      flipped.text = counted(flipped.count, "face") + " wound against the neighbours (first: face " +
                     std::to_string(flipped.element) + "); turned over";
      findings.push_back(flipped);
    }
    if (inward.count > 0) {
      inward.text = counted(inward.count, "closed component") + " inside out (first: that of face " +
                    std::to_string(inward.element) + "); turned outward";
      findings.push_back(inward);
    }
  }

 private:
  static constexpr char unseen = 2;

  /// Breadth-first over the component; flip becomes 0 or 1 relative to the first face.
  void collect(std::size_t face) {
    component_.assign(1, face);
    flip[face] = 0;
    closed_ = true;
    for (std::size_t i = 0; i < component_.size(); ++i) {
      const std::size_t f = component_[i];
      for (HalfEdge h = static_cast<HalfEdge>(3 * f); h < static_cast<HalfEdge>(3 * f + 3); ++h) {
        if (opposite_[h] < 0)
          closed_ = false;
        else
          visit(h, opposite_[h]);
      }
    }
  }

  void visit(HalfEdge from, HalfEdge to) {
    const bool same_way = tail(mesh_.triangles, from) == tail(mesh_.triangles, to);
    const char wanted = static_cast<char>(flip[from / 3] ^ static_cast<char>(same_way));
    char& there = flip[to / 3];
    if (there == unseen) {
      there = wanted;
      component_.push_back(to / 3);
    } else if (there != wanted) {
      throw ShapeFault(ShapeFault::Element::face, work_.face_number[to / 3],
                       "the surface has only one side (like a Moebius band), so that no outside can be chosen; "
                       "cut it open or make it two-sided");
    }
  }

  double volume() const {
    const Point& origin = mesh_.points[mesh_.triangles[component_[0]][0]];
    double sum = 0;
    for (std::size_t f : component_) sum += (flip[f] ? -1 : 1) * volume_under(mesh_, f, origin);
    return sum;
  }

  void turn_component() {
    for (std::size_t f : component_) flip[f] ^= 1;
  }

  void note(Finding& finding, std::size_t face) const {
    const std::size_t number = work_.face_number[face];
    if (finding.count++ == 0 || number < finding.element) finding.element = number;
  }

  const NumberedMesh& work_;
  const TriangleMesh& mesh_;
  const std::vector<HalfEdge>& opposite_;
  std::vector<std::size_t> component_;
  bool closed_ = true;

 public:
  std::vector<char> flip;
  Finding flipped{"flipped-faces", "", 0, 0, true};
  Finding inward{"inward-components", "", 0, 0, true};
};

}  // namespace

void orient(NumberedMesh& work, const std::vector<HalfEdge>& opposite, std::vector<Finding>& findings) {
  Orienter orienter(work, opposite);
  for (std::size_t f = 0; f < work.mesh.triangles.size(); ++f) orienter.component_of(f);
  orienter.report(findings);
  flip_faces(work.mesh, orienter.flip);
}

}  // namespace pelage
