#include "io/vtk_grid_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/checked.h"
#include "io/vtk_attributes.h"
#include "io/vtk_document.h"
#include "pelage/error.h"
#include "shape/grid.h"
#include "shape/repair.h"

namespace pelage {

namespace {

using Matrix = std::array<Point, 3>;  // rows
constexpr Matrix identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A box of nodes: the first and the last along each axis.
struct Extent {
  std::array<std::int64_t, 3> first, last;
  std::int64_t count(std::size_t d) const { return last[d] - first[d] + 1; }
  std::size_t nodes() const { return static_cast<std::size_t>(count(0) * count(1) * count(2)); }
  std::size_t cells() const {
    std::int64_t cells = 1;
    for (std::size_t d = 0; d < 3; ++d) cells *= std::max<std::int64_t>(1, count(d) - 1);
    return static_cast<std::size_t>(cells);
  }
  bool operator==(const Extent&) const = default;
};

struct Piece {
  pugi::xml_node element;
  Extent extent;
};

class GridReader {
 public:
  GridReader(std::string_view bytes, const std::string& path) : document_(bytes, path) {}

  GridFile read() {
    find_data();
    whole_ = extent(data_, "WholeExtent");
    find_pieces();
    place_nodes();
    read_attributes();
    note_cell_data();
    leave_out_flat_axes();
    clear_non_finite_attributes(file_.grid.attributes, file_.findings);
    return std::move(file_);
  }

 private:
  void note(const std::string& kind, const std::string& text, std::size_t count = 1) {
    file_.findings.push_back({kind, text, count, 0, false});
  }

  void find_data() {
    const std::string kind = document_.root().attribute("type").as_string();
    even_ = kind == "ImageData";
    if (!even_ && kind != "StructuredGrid")
      document_.fail(document_.root(), "holds " + (kind.empty() ? "no kind of data that is named" : kind) +
                                           "; grids are read from ImageData (.vti) and StructuredGrid (.vts)");
    data_ = document_.root().child(kind.c_str());
    if (!data_) document_.fail(document_.root(), "has no element " + kind);
  }

  Extent extent(pugi::xml_node element, const char* attribute) const {
    const std::vector<double> ends = document_.numbers(element, attribute, 6);
    Extent result{};
    double nodes = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      constexpr double most = 2147483647.0;
      const double low = ends[2 * d], high = ends[2 * d + 1];
      if (!(std::abs(low) < most && std::abs(high) < most && low <= high && std::floor(low) == low &&
            std::floor(high) == high))
        document_.fail(element, std::string(attribute) + " \"" + element.attribute(attribute).as_string() +
                                    "\" is no box of nodes");
      result.first[d] = static_cast<std::int64_t>(low);
      result.last[d] = static_cast<std::int64_t>(high);
      nodes *= high - low + 1;
      if (nodes > most) document_.fail(element, std::string(attribute) + " has more nodes than can be counted");
    }
    return result;
  }

  void find_pieces() {
    std::size_t nodes = 0;
    for (const pugi::xml_node element : data_.children("Piece")) {
      pieces_.push_back({element, extent(element, "Extent")});
      const Extent& e = pieces_.back().extent;
      for (std::size_t d = 0; d < 3; ++d)
        if (e.first[d] < whole_.first[d] || e.last[d] > whole_.last[d])
          document_.fail(element, "the piece reaches beyond the whole extent");
      nodes += e.nodes();
    }
    if (nodes < whole_.nodes())
      document_.fail(data_, "the pieces have " + std::to_string(nodes) + " of " + std::to_string(whole_.nodes()) +
                                " nodes; save the grid as one file");
    require_something();
    if (!one_piece()) require_cover();
  }

  bool one_piece() const { return pieces_.size() == 1 && pieces_[0].extent == whole_; }

  /// A file without values may claim any number of nodes; what grows there takes the memory.
  void require_something() const {
    constexpr std::size_t most = std::size_t{1} << 24;  // 4096 x 4096, 256 x 256 x 256
    if (whole_.nodes() <= most || !even_ || pieces_[0].element.child("PointData").child("DataArray")) return;
    document_.fail(data_, "has " + std::to_string(whole_.nodes()) + " nodes without any values; at most " +
                              std::to_string(most) + " are taken then");
  }

  void require_cover() const {
    std::vector<char> covered(whole_.nodes());
    for (const Piece& piece : pieces_)
      for_each_row(piece.extent, [&](std::size_t, std::size_t to, std::size_t n) {
        std::fill_n(covered.begin() + static_cast<std::ptrdiff_t>(to), n, 1);
      });
    if (std::ranges::count(covered, 0) > 0)
      document_.fail(data_, "the pieces leave nodes out; save the grid as one file");
  }

  /// Calls visit(first node in the piece, first node in the whole, nodes) for the rows of a piece.
  template <class Visit>
  void for_each_row(const Extent& e, Visit&& visit) const {
    const auto row = static_cast<std::size_t>(e.count(0));
    std::size_t from = 0;
    for (std::int64_t k = e.first[2]; k <= e.last[2]; ++k)
      for (std::int64_t j = e.first[1]; j <= e.last[1]; ++j, from += row)
        visit(
            from,
            static_cast<std::size_t>(e.first[0] - whole_.first[0] +
                                     whole_.count(0) * (j - whole_.first[1] + whole_.count(1) * (k - whole_.first[2]))),
            row);
  }

  /// The values of an array that every piece has; find(number of the piece) gives it.
  template <class Find>
  std::vector<double> joined(std::size_t components, Find&& find) const {
    if (one_piece()) return document_.values(find(0), components * whole_.nodes());
    std::vector<std::vector<double>> parts;  // before the whole takes memory
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      parts.push_back(document_.values(find(p), components * pieces_[p].extent.nodes()));
    std::vector<double> whole(components * whole_.nodes());
    for (std::size_t p = 0; p < parts.size(); ++p)
      for_each_row(pieces_[p].extent, [&](std::size_t from, std::size_t to, std::size_t n) {
        std::copy_n(parts[p].begin() + static_cast<std::ptrdiff_t>(components * from), components * n,
                    whole.begin() + static_cast<std::ptrdiff_t>(components * to));
      });
    return whole;
  }

  // --- places ---

  void place_nodes() {
    for (std::size_t d = 0; d < 3; ++d) file_.grid.count[d] = static_cast<std::int32_t>(whole_.count(d));
    if (even_)
      read_lattice();
    else
      read_points();
  }

  Point triple(const char* attribute, const Point& otherwise) const {
    if (!data_.attribute(attribute)) return otherwise;
    const std::vector<double> values = document_.numbers(data_, attribute, 3);
    return {values[0], values[1], values[2]};
  }

  void read_lattice() {
    const Point origin = triple("Origin", {0, 0, 0});
    spacing_ = triple("Spacing", {1, 1, 1});
    if (data_.attribute("Direction")) {
      const std::vector<double> d = document_.numbers(data_, "Direction", 9);
      turn_ = {{{d[0], d[1], d[2]}, {d[3], d[4], d[5]}, {d[6], d[7], d[8]}}};
    }
    for (std::size_t d = 0; d < 3; ++d)
      file_.grid.origin[d] = origin[d] + turned({spacing_[0] * static_cast<double>(whole_.first[0]),
                                                 spacing_[1] * static_cast<double>(whole_.first[1]),
                                                 spacing_[2] * static_cast<double>(whole_.first[2])})[d];
    for (std::size_t d = 0; d < 3; ++d)
      if (whole_.count(d) == 1) spacing_[d] = 1;  // some programs write 0
    file_.grid.spacing = spacing_;
    if (turn_ == identity) return;
    note("turned-image", "the image is turned (Direction): its nodes are taken where they lie");
  }

  Point turned(const Point& p) const {
    Point q{};
    for (std::size_t r = 0; r < 3; ++r) q[r] = turn_[r][0] * p[0] + turn_[r][1] * p[1] + turn_[r][2] * p[2];
    return q;
  }

  Point step(std::size_t axis) const {
    Point along{};
    along[axis] = spacing_[axis];
    return turned(along);
  }

  /// The nodes of an image one by one.
  void lay_points() {
    Grid& grid = file_.grid;
    std::vector<Point> points;
    points.reserve(grid.nodes());
    const Point a = step(0), b = step(1), c = step(2);
    for (std::int32_t k = 0; k < grid.count[2]; ++k)
      for (std::int32_t j = 0; j < grid.count[1]; ++j)
        for (std::int32_t i = 0; i < grid.count[0]; ++i) {
          Point p = grid.origin;
          for (std::size_t d = 0; d < 3; ++d) p[d] += i * a[d] + j * b[d] + k * c[d];
          points.push_back(p);
        }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t d = 0; d < 3; ++d) grid.period[axis][d] = grid.count[axis] * step(axis)[d];
    grid.points = std::move(points);
  }

  void read_points() {
    const std::vector<double> values = joined(3, [&](std::size_t p) {
      const Piece& piece = pieces_[p];
      const pugi::xml_node array = piece.element.child("Points").child("DataArray");
      if (!array) document_.fail(piece.element, "the piece has no points");
      return array;
    });
    file_.grid.points.resize(whole_.nodes());
    for (std::size_t i = 0; i < values.size(); ++i) file_.grid.points[i / 3][i % 3] = values[i];
  }

  /// Grids have their extent along their first axes.
  void leave_out_flat_axes() {
    Grid& grid = file_.grid;
    std::vector<std::size_t> axes;
    for (std::size_t d = 0; d < 3; ++d)
      if (whole_.count(d) > 1) axes.push_back(d);
    bool moved = false, mirrored = false;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      moved = moved || axes[i] != i;
      mirrored = mirrored || spacing_[axes[i]] < 0;
    }
    if (even_ && (moved || mirrored || turn_ != identity)) lay_points();
    if (!moved) return;
    const Grid before = grid;
    grid.count = {1, 1, 1};
    grid.periodic = {};
    grid.period = {};
    for (std::size_t i = 0; i < axes.size(); ++i) {
      grid.count[i] = before.count[axes[i]];
      grid.periodic[i] = before.periodic[axes[i]];
      grid.period[i] = before.period[axes[i]];
    }
  }

  // --- values ---

  void read_attributes() {
    for (const pugi::xml_node array : pieces_[0].element.child("PointData").children())
      if (array.attribute("Name").as_string() == std::string_view(vtk_ghosts)) refuse_hidden(array, 2, whole_.nodes());
    std::vector<pugi::xml_node> elements;
    for (const Piece& piece : pieces_) elements.push_back(piece.element);
    const VtkAttributes reader(document_, elements, file_.findings);
    Grid& grid = file_.grid;
    grid.attributes =
        reader.read("PointData", Domain::vertex,
                    [&](std::size_t components, const VtkAttributes::Find& find) { return joined(components, find); });
    reader.read_field_data(data_, grid.attributes, grid.metres_per_unit,
                           [&](pugi::xml_node array, const std::string& name) { return take_field(array, name); });
  }

  void refuse_hidden(pugi::xml_node array, unsigned bit, std::size_t count) const {
    if (!one_piece()) return;  // bits of pieces are about their overlaps
    for (const double flags : document_.values(array, count))
      if ((saturated<unsigned>(flags) & bit) != 0)
        document_.fail(array,
                       "a part of the grid is hidden (vtkGhostType); extract the part that is meant, or unhide all");
  }

  void note_cell_data() {
    for (const pugi::xml_node array : pieces_[0].element.child("CellData").children()) {
      const std::string name = array.attribute("Name").as_string();
      constexpr unsigned hidden = 32;
      if (name == vtk_ghosts)
        refuse_hidden(array, hidden, whole_.cells());
      else
        note("cell-data", "the cell data \"" + name +
                              "\" are left out: values belong to nodes here (ParaView's \"Cell Data "
                              "to Point Data\" makes such)");
    }
  }

  /// Whether it is one of those that our files of grids have.
  bool take_field(pugi::xml_node array, const std::string& name) {
    Grid& grid = file_.grid;
    if (name == "periodic") {
      const std::vector<double> flags = document_.values(array, 3);
      for (std::size_t d = 0; d < 3; ++d) grid.periodic[d] = flags[d] != 0;
    } else if (name == "period") {
      const std::vector<double> values = document_.values(array, 9);
      for (std::size_t i = 0; i < 9; ++i) grid.period[i / 3][i % 3] = values[i];
    } else {
      return false;
    }
    return true;
  }

  VtkDocument document_;
  GridFile file_;
  pugi::xml_node data_;
  bool even_ = true;
  Extent whole_{};
  std::vector<Piece> pieces_;
  Point spacing_{1, 1, 1};
  Matrix turn_ = identity;
};

}  // namespace

GridFile read_vtk_grid(std::string_view bytes, const std::string& path) {
  GridFile file = GridReader(bytes, path).read();
  try {
    require_sound(file.grid);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  return file;
}

}  // namespace pelage
