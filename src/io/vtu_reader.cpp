#include "io/vtu_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/checked.h"
#include "io/vtk_attributes.h"
#include "io/vtk_document.h"

namespace pelage {

namespace {

/// A kind of cells of VTK.
struct VtkCell {
  int type;
  const char* name;
  int dimension;
  std::optional<CellShape> shape;  ///< of volumes
  int nodes;                       ///< of one; 0: the corners and any number of others
};

constexpr auto tetrahedron = CellShape::tetrahedron, pyramid = CellShape::pyramid, wedge = CellShape::wedge,
               hexahedron = CellShape::hexahedron;
constexpr int voxel = 11;

constexpr VtkCell kinds[] = {
    {0, "empty cell", 0, {}, 0},
    {1, "vertex", 0, {}, 0},
    {2, "poly-vertex", 0, {}, 0},
    {3, "line", 1, {}, 0},
    {4, "polyline", 1, {}, 0},
    {5, "triangle", 2, {}, 0},
    {6, "triangle strip", 2, {}, 0},
    {7, "polygon", 2, {}, 0},
    {8, "pixel", 2, {}, 0},
    {9, "quadrangle", 2, {}, 0},
    {10, "tetrahedron", 3, tetrahedron, 4},
    {voxel, "voxel", 3, hexahedron, 8},
    {12, "hexahedron", 3, hexahedron, 8},
    {13, "wedge", 3, wedge, 6},
    {14, "pyramid", 3, pyramid, 5},
    {21, "quadratic line", 1, {}, 0},
    {22, "quadratic triangle", 2, {}, 0},
    {23, "quadratic quadrangle", 2, {}, 0},
    {24, "quadratic tetrahedron", 3, tetrahedron, 10},
    {25, "quadratic hexahedron", 3, hexahedron, 20},
    {26, "quadratic wedge", 3, wedge, 15},
    {27, "quadratic pyramid", 3, pyramid, 13},
    {28, "biquadratic quadrangle", 2, {}, 0},
    {29, "triquadratic hexahedron", 3, hexahedron, 27},
    {30, "quadratic-linear quadrangle", 2, {}, 0},
    {31, "quadratic-linear wedge", 3, wedge, 12},
    {32, "biquadratic wedge", 3, wedge, 18},
    {33, "biquadratic hexahedron", 3, hexahedron, 24},
    {34, "biquadratic triangle", 2, {}, 0},
    {35, "cubic line", 1, {}, 0},
    {36, "quadratic polygon", 2, {}, 0},
    {37, "triquadratic pyramid", 3, pyramid, 19},
    {68, "Lagrange curve", 1, {}, 0},
    {69, "Lagrange triangle", 2, {}, 0},
    {70, "Lagrange quadrangle", 2, {}, 0},
    {71, "Lagrange tetrahedron", 3, tetrahedron, 0},
    {72, "Lagrange hexahedron", 3, hexahedron, 0},
    {73, "Lagrange wedge", 3, wedge, 0},
    {74, "Lagrange pyramid", 3, pyramid, 0},
    {75, "Bezier curve", 1, {}, 0},
    {76, "Bezier triangle", 2, {}, 0},
    {77, "Bezier quadrangle", 2, {}, 0},
    {78, "Bezier tetrahedron", 3, tetrahedron, 0},
    {79, "Bezier hexahedron", 3, hexahedron, 0},
    {80, "Bezier wedge", 3, wedge, 0},
    {81, "Bezier pyramid", 3, pyramid, 0},
};

const VtkCell* find_kind(double type) {
  const auto* found = std::ranges::find_if(kinds, [&](const VtkCell& kind) { return kind.type == type; });
  return found == std::end(kinds) ? nullptr : found;
}

class VtuReader {
 public:
  VtuReader(std::string_view bytes, const std::string& path, std::vector<Finding>& findings)
      : document_(bytes, path), findings_(findings) {}

  SolidCells read() {
    pieces_ = document_.pieces("UnstructuredGrid", "volumes are read from UnstructuredGrid (.vtu), in one file");
    data_ = document_.root().child("UnstructuredGrid");
    for (const pugi::xml_node piece : pieces_) {
      document_.refuse_hidden(piece, cells_of(piece));
      read_points(piece);
      read_cells(piece);
    }
    note_cells();
    read_attributes();
    if (pieces_.size() > 1) join_nodes();
    return std::move(result_);
  }

 private:
  std::size_t count(pugi::xml_node piece, const char* attribute) const {
    if (!piece.attribute(attribute)) document_.fail(piece, std::string("the piece has no ") + attribute);
    return static_cast<std::size_t>(document_.whole(piece, attribute, 0, 0, 2147483647));
  }
  std::size_t points_of(pugi::xml_node piece) const { return count(piece, "NumberOfPoints"); }
  std::size_t cells_of(pugi::xml_node piece) const { return count(piece, "NumberOfCells"); }

  void read_points(pugi::xml_node piece) {
    first_point_.push_back(result_.points.size());
    const std::vector<Point> points = document_.points(piece, points_of(piece));
    result_.points.insert(result_.points.end(), points.begin(), points.end());
    checked_count<std::int32_t>(result_.points.size(), "nodes");
  }

  pugi::xml_node cell_array(pugi::xml_node piece, const char* name) const {
    const pugi::xml_node array = piece.child("Cells").find_child_by_attribute("Name", name);
    if (!array) document_.fail(piece, std::string("the cells of the piece have no array \"") + name + "\"");
    return array;
  }

  void read_cells(pugi::xml_node piece) {
    const std::size_t n = cells_of(piece);
    taken_.emplace_back();
    if (n == 0) return;
    const pugi::xml_node end_array = cell_array(piece, "offsets"), type_array = cell_array(piece, "types"),
                         corner_array = cell_array(piece, "connectivity");
    const std::vector<double> ends = document_.values(end_array, n), types = document_.values(type_array, n);
    check_ends(end_array, ends);
    const std::vector<double> corners = document_.values(corner_array, static_cast<std::size_t>(ends.back()));
    for (std::size_t c = 0; c < n; ++c) {
      const auto begin = static_cast<std::size_t>(c > 0 ? ends[c - 1] : 0);
      const VtkCell& kind = kind_of(type_array, types[c], c);
      ++seen_[&kind];
      if (!kind.shape) continue;
      const auto size = static_cast<std::size_t>(ends[c]) - begin;
      check_size(end_array, kind, size, c);
      add_cell(corner_array, kind, &corners[begin], points_of(piece), c);
      taken_.back().push_back(c);
    }
  }

  void check_ends(pugi::xml_node array, const std::vector<double>& ends) const {
    constexpr double most = 1e12;  // of the size that an array may have there is no doubt
    double before = 0;
    for (std::size_t c = 0; c < ends.size(); before = ends[c++])
      if (!(ends[c] >= before && ends[c] <= most && ends[c] == std::floor(ends[c])))
        document_.fail(array, "the offset of cell " + std::to_string(c) + " does not follow those before it");
  }

  const VtkCell& kind_of(pugi::xml_node array, double type, std::size_t c) const {
    if (const VtkCell* kind = find_kind(type)) return *kind;
    document_.fail(array, "cell " + std::to_string(c) + " is of the kind " +
                              std::to_string(saturated<std::int64_t>(type)) + (type == 42 ? " (a polyhedron)" : "") +
                              ", which is not known here; ParaView's \"Tetrahedralize\" makes tetrahedra of it");
  }

  void check_size(pugi::xml_node array, const VtkCell& kind, std::size_t size, std::size_t c) const {
    const auto least = static_cast<std::size_t>(kind.nodes > 0 ? kind.nodes : static_cast<int>(*kind.shape));
    if (size < least || (kind.nodes > 0 && size > least))
      document_.fail(array,
                     "cell " + std::to_string(c) + " is a " + kind.name + " with " + std::to_string(size) + " nodes");
  }

  void add_cell(pugi::xml_node array, const VtkCell& kind, const double* corners, std::size_t points, std::size_t c) {
    SolidCell cell{*kind.shape, {}};
    for (std::size_t k = 0; k < static_cast<std::size_t>(*kind.shape); ++k) {
      if (!(corners[k] >= 0 && corners[k] < static_cast<double>(points)) || corners[k] != std::floor(corners[k]))
        document_.fail(array, "cell " + std::to_string(c) + " has the node " +
                                  std::to_string(saturated<std::int64_t>(corners[k])) + ", but there are " +
                                  std::to_string(points));
      cell.corner[k] = static_cast<std::int32_t>(first_point_.back() + static_cast<std::size_t>(corners[k]));
    }
    if (kind.type == voxel) {  // whose corners go along the axes, not around
      std::swap(cell.corner[2], cell.corner[3]);
      std::swap(cell.corner[6], cell.corner[7]);
    }
    result_.cells.push_back(cell);
  }

  void note_cells() {
    for (const VtkCell& kind : kinds) {
      const auto seen = seen_.find(&kind);
      if (seen == seen_.end()) continue;
      const auto [_, n] = *seen;
      if (!kind.shape)
        findings_.push_back(
            {"left-out", counted(n, kind.name) + " beside the cells of the volume; left out", n, 0, false});
      else if (kind.nodes != static_cast<int>(*kind.shape))
        findings_.push_back({"higher-order", "of " + counted(n, kind.name) + " the corners are taken", n, 0, false});
    }
  }

  // --- values ---

  void read_attributes() {
    const VtkAttributes reader(document_, pieces_, findings_);
    result_.at_nodes =
        reader.read("PointData", Domain::vertex, [&](std::size_t components, const VtkAttributes::Find& find) {
          std::vector<double> all;
          for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const std::vector<double> part = document_.values(find(p), components * points_of(pieces_[p]));
            all.insert(all.end(), part.begin(), part.end());
          }
          return all;
        });
    result_.in_cells =
        reader.read("CellData", Domain::face, [&](std::size_t components, const VtkAttributes::Find& find) {
          std::vector<double> all;
          for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const std::vector<double> part = document_.values(find(p), components * cells_of(pieces_[p]));
            for (const std::size_t c : taken_[p])
              all.insert(all.end(), &part[components * c], &part[components * c] + components);
          }
          return all;
        });
    const std::size_t nodal = result_.at_nodes.size();
    std::vector<Attribute> all = std::move(result_.at_nodes);
    std::ranges::move(result_.in_cells, std::back_inserter(all));
    reader.read_field_data(data_, all, result_.metres_per_unit,
                           [](pugi::xml_node, const std::string&) { return false; });
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(nodal);
    result_.at_nodes = {all.begin(), middle};
    result_.in_cells = {middle, all.end()};
  }

  /// Nodes of a piece take the place of those of earlier ones in exactly the same place.
  void join_nodes() {
    std::map<Point, std::int32_t> earlier;
    std::vector<std::int32_t> number(result_.points.size());
    std::size_t joined = 0;
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const std::size_t begin = first_point_[p], end = p + 1 < pieces_.size() ? first_point_[p + 1] : number.size();
      for (std::size_t v = begin; v < end; ++v) {
        const auto found = earlier.find(result_.points[v]);
        number[v] = found == earlier.end() ? static_cast<std::int32_t>(v) : found->second;
        joined += found == earlier.end() ? 0 : 1;
      }
      for (std::size_t v = begin; v < end; ++v) earlier.try_emplace(result_.points[v], number[v]);
    }
    if (joined == 0) return;
    for (SolidCell& cell : result_.cells)
      for (std::size_t k = 0; k < static_cast<std::size_t>(cell.shape); ++k)
        cell.corner[k] = number[static_cast<std::size_t>(cell.corner[k])];
    findings_.push_back(
        {"joined-pieces",
         counted(joined, "node") + " in the same place as one of an earlier piece: the pieces are joined", joined, 0,
         true});
  }

  VtkDocument document_;
  std::vector<Finding>& findings_;
  SolidCells result_;
  pugi::xml_node data_;
  std::vector<pugi::xml_node> pieces_;
  std::vector<std::size_t> first_point_;         ///< of each piece
  std::vector<std::vector<std::size_t>> taken_;  ///< the cells of each piece that are volumes
  std::map<const VtkCell*, std::size_t> seen_;   ///< how many of each kind
};

}  // namespace

SolidCells read_vtu(std::string_view bytes, const std::string& path, std::vector<Finding>& findings) {
  return VtuReader(bytes, path, findings).read();
}

}  // namespace pelage
