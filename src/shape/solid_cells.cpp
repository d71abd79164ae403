#include "shape/solid_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "shape/convex_cell.h"
#include "shape/repair.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

using Loop = std::array<std::int32_t, 4>;

// Faces counter-clockwise from outside where the corners of the base are so from above; triangles repeat a corner.
constexpr Loop faces_of_pyramid[] = {{0, 3, 2, 1}, {0, 1, 4, 4}, {1, 2, 4, 4}, {2, 3, 4, 4}, {3, 0, 4, 4}};
constexpr Loop faces_of_wedge[] = {{0, 2, 1, 1}, {3, 4, 5, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr Loop faces_of_hexahedron[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Of all but tetrahedra.
std::span<const Loop> faces_of(CellShape shape) {
  switch (shape) {
    case CellShape::pyramid:
      return faces_of_pyramid;
    case CellShape::wedge:
      return faces_of_wedge;
    default:
      return faces_of_hexahedron;
  }
}

ConvexCell faced(const SolidCell& cell) {
  ConvexCell result;
  for (const Loop& loop : faces_of(cell.shape)) {
    Loop corners;
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = cell.corner[static_cast<std::size_t>(loop[k])];
    result.add_face(corners, 0);
  }
  return result;
}

/// How many, and the number of the first one.
struct Tally {
  std::size_t count = 0, first = 0;
  void add(std::size_t element) {
    if (count++ == 0) first = element;
  }
};

/// Six times the volume of a tetrahedron.
double volume6(const std::vector<Point>& points, const Tetrahedron& t) {
  const auto edge = [&](std::size_t k) {
    return difference(points[static_cast<std::size_t>(t[k])], points[static_cast<std::size_t>(t[0])]);
  };
  return dot(cross(edge(1), edge(2)), edge(3));
}

double longest_edge(const std::vector<Point>& points, const Tetrahedron& t) {
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 1; k < 4; ++k)
      longest = std::max(
          longest, length(difference(points[static_cast<std::size_t>(t[i])], points[static_cast<std::size_t>(t[k])])));
  return longest;
}

Tetrahedron sorted(Tetrahedron t) {
  std::ranges::sort(t);
  return t;
}

class Cutter {
 public:
  Cutter(SolidCells cells, std::vector<Finding>& findings) : cells_(std::move(cells)), findings_(findings) {}

  TetMesh cut() {
    check_places();
    for (std::size_t c = 0; c < cells_.cells.size(); ++c) cut(c);
    leave_out_copies();
    note_cells();
    if (tets_.empty())
      throw ShapeFault(ShapeFault::Element::none, 0,
                       "there is no cell with a volume; a surface is read from .ply or .stl");
    note_faces();
    volume_.points = std::move(cells_.points);
    volume_.attributes = std::move(cells_.at_nodes);
    volume_.metres_per_unit = cells_.metres_per_unit;
    for (const Attribute& a : cells_.in_cells) add_at_nodes(a);
    leave_out_nodes();
    volume_.tets = std::move(tets_);
    clear_non_finite_attributes(volume_.attributes, findings_);
    return std::move(volume_);
  }

 private:
  void note(const std::string& kind, const Tally& tally, const std::string& text, bool repaired) {
    if (tally.count > 0) findings_.push_back({kind, text, tally.count, tally.first, repaired});
  }
  static std::string cells(const Tally& tally) {
    return counted(tally.count, "cell") + " (the first is " + std::to_string(tally.first) + ")";
  }

  void check_places() const {
    constexpr double most = 1e75;  // its cube has room
    for (const SolidCell& cell : cells_.cells)
      for (std::size_t k = 0; k < static_cast<std::size_t>(cell.shape); ++k) {
        const auto v = static_cast<std::size_t>(cell.corner[k]);
        for (const double x : cells_.points[v])
          if (!(std::abs(x) <= most))
            throw ShapeFault(ShapeFault::Element::vertex, v, "its place is not a finite number below 1e75");
      }
  }

  void cut(std::size_t c) {
    parts_.clear();
    const auto& v = cells_.cells[c].corner;
    if (cells_.cells[c].shape == CellShape::tetrahedron)  // keeps the order of its corners
      parts_.push_back({{v[0], v[1], v[2], v[3]}, {}});
    else
      append_tets(faced(cells_.cells[c]), parts_);
    std::size_t positive = 0, negative = 0;
    for (const LabelledTet& part : parts_) {
      const double volume = volume6(cells_.points, part.corner);
      // Below this the sign is that of rounding, which is 1e-16 of the cube of an edge.
      constexpr double flat = 1e-12;
      const double edge = longest_edge(cells_.points, part.corner);
      if (!(std::abs(volume) > flat * edge * edge * edge)) continue;
      Tetrahedron t = part.corner;
      if (volume < 0) std::swap(t[2], t[3]);
      ++(volume < 0 ? negative : positive);
      tets_.push_back(t);
      cell_of_.push_back(c);
    }
    if (positive + negative < parts_.size() || parts_.empty()) flat_.add(c);
    const bool either_sense = cells_.cells[c].shape == CellShape::wedge;  // VTK and others differ
    if (negative > 0 && positive > 0) warped_.add(c);
    if (negative > 0 && positive == 0 && !either_sense) turned_.add(c);
  }

  /// Keeps the first of those with the same corners.
  void leave_out_copies() {
    std::vector<std::size_t> order(tets_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(sorted(tets_[i]), i); });
    std::vector<char> copy(tets_.size());
    for (std::size_t k = 1; k < order.size(); ++k)
      if (sorted(tets_[order[k - 1]]) == sorted(tets_[order[k]])) copy[order[k]] = 1;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      if (copy[i]) copies_.add(cell_of_[i]);
      tets_[kept] = tets_[i];
      cell_of_[kept] = cell_of_[i];
      kept += copy[i] ? 0 : 1;
    }
    tets_.resize(kept);
    cell_of_.resize(kept);
  }

  void note_cells() {
    note("turned-cells", turned_, cells(turned_) + " inside out; turned", true);
    note("warped-cells", warped_, cells(warped_) + " so warped that parts of them are inside out; these were turned",
         true);
    note("flat-cells", flat_, cells(flat_) + " without a volume, whole or in part; left out", true);
    note("duplicate-cells", copies_, counted(copies_.count, "tetrahedron") + " there more than once; left out", true);
  }

  void note_faces() {
    std::vector<Triangle> faces;
    faces.reserve(4 * tets_.size());
    for (const Tetrahedron& t : tets_)
      for (std::size_t k = 0; k < 4; ++k) {
        Triangle face = {t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
        std::ranges::sort(face);
        faces.push_back(face);
      }
    std::ranges::sort(faces);
    Tally crowded;
    for (std::size_t k = 2; k < faces.size(); ++k)
      if (faces[k] == faces[k - 2]) crowded.add(static_cast<std::size_t>(faces[k][0]));
    note("overlapping-cells", crowded,
         counted(crowded.count, "face") + " (the first at node " + std::to_string(crowded.first) +
             ") between more than two cells: cells overlap",
         false);
  }

  // --- values of cells ---

  double volume(std::size_t tet) const { return volume6(volume_.points, tets_[tet]); }

  void add_at_nodes(const Attribute& a) {
    if (volume_.find(a.name)) {
      findings_.push_back(
          {"left-out", "the values \"" + a.name + "\" of cells are left out: nodes have such, too", 1, 0, false});
      return;
    }
    const bool whole = is_integer(a.type);
    findings_.push_back({"cell-data",
                         "the values \"" + a.name + "\" of cells became such of nodes: " +
                             (whole ? "what most of the volume around has" : "means over the cells around"),
                         1, 0, true});
    volume_.set(whole ? prevailing(a) : mean(a));
  }

  Attribute mean(const Attribute& a) const {
    const auto n = static_cast<std::size_t>(a.components);
    Attribute result{a.name, a.components, Domain::vertex, std::vector<double>(n * volume_.points.size()),
                     a.type, a.labels};
    std::vector<double> weight(volume_.points.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      const double w = volume(t);
      for (const std::int32_t v : tets_[t]) {
        weight[static_cast<std::size_t>(v)] += w;
        for (std::size_t k = 0; k < n; ++k)
          result.values[n * static_cast<std::size_t>(v) + k] += w * a.values[n * cell_of_[t] + k];
      }
    }
    for (std::size_t i = 0; i < result.values.size(); ++i)
      if (weight[i / n] > 0) result.values[i] /= weight[i / n];
    if (result.type == NumberType::float32)
      for (double& x : result.values) x = static_cast<float>(x);
    return result;
  }

  Attribute prevailing(const Attribute& a) const {
    const auto n = static_cast<std::size_t>(a.components);
    struct Share {
      std::int32_t node;
      std::size_t cell;
      double volume;
    };
    std::vector<Share> shares;
    shares.reserve(4 * tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t)
      for (const std::int32_t v : tets_[t]) shares.push_back({v, cell_of_[t], volume(t)});
    std::ranges::stable_sort(shares, {}, &Share::node);
    Attribute result{a.name, a.components, Domain::vertex, std::vector<double>(n * volume_.points.size()),
                     a.type, a.labels};
    for (std::size_t begin = 0, end = 0; begin < shares.size(); begin = end) {
      std::map<std::vector<double>, double> volumes;
      for (end = begin; end < shares.size() && shares[end].node == shares[begin].node; ++end) {
        const double* value = &a.values[n * shares[end].cell];
        volumes[{value, value + n}] += shares[end].volume;
      }
      const auto most = std::ranges::max_element(volumes, {}, [](const auto& entry) { return entry.second; });
      std::ranges::copy(most->first, &result.values[n * static_cast<std::size_t>(shares[begin].node)]);
    }
    return result;
  }

  // --- nodes ---

  void leave_out_nodes() {
    std::vector<std::int32_t> number(volume_.points.size(), -1);
    for (const Tetrahedron& t : tets_)
      for (const std::int32_t v : t) number[static_cast<std::size_t>(v)] = 0;
    std::int32_t kept = 0;
    Tally unused;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) {
        unused.add(v);
        continue;
      }
      volume_.points[static_cast<std::size_t>(kept)] = volume_.points[v];
      for (Attribute& a : volume_.attributes)
        std::copy_n(a.values.begin() + a.components * static_cast<std::ptrdiff_t>(v), a.components,
                    a.values.begin() + a.components * static_cast<std::ptrdiff_t>(kept));
      number[v] = kept++;
    }
    if (unused.count == 0) return;
    note("unused-nodes", unused,
         counted(unused.count, "node") + " (the first is " + std::to_string(unused.first) + ") of no cell; left out",
         true);
    volume_.points.resize(static_cast<std::size_t>(kept));
    for (Attribute& a : volume_.attributes) a.values.resize(static_cast<std::size_t>(a.components * kept));
    for (Tetrahedron& t : tets_)
      for (std::int32_t& v : t) v = number[static_cast<std::size_t>(v)];
  }

  SolidCells cells_;
  std::vector<Finding>& findings_;
  TetMesh volume_;
  std::vector<Tetrahedron> tets_;
  std::vector<std::size_t> cell_of_;  ///< of each of them
  std::vector<LabelledTet> parts_;
  Tally turned_, warped_, flat_, copies_;
};

}  // namespace

TetMesh tets_of(SolidCells cells, std::vector<Finding>& findings) { return Cutter(std::move(cells), findings).cut(); }

}  // namespace pelage
