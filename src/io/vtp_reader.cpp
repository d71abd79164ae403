#include "io/vtp_reader.h"

#include <algorithm>
#include <cmath>

#include "base/checked.h"
#include "base/number.h"
#include "io/vtk_attributes.h"
#include "io/vtk_document.h"

namespace pelage {

namespace {

class VtpReader {
 public:
  VtpReader(std::string_view bytes, const std::string& path) : document_(bytes, path) {}

  RawShape read() {
    pieces_ = document_.pieces("PolyData", "surfaces and clouds are read from PolyData (.vtp), in one file");
    data_ = document_.root().child("PolyData");
    for (const pugi::xml_node piece : pieces_) {
      document_.refuse_hidden(piece, cells_of(piece));
      read_polygons(piece);  // counts from the points before
      read_points(piece);
    }
    note_others();
    read_attributes();
    return std::move(shape_);
  }

 private:
  std::size_t count(pugi::xml_node piece, const char* attribute) const {
    return static_cast<std::size_t>(document_.whole(piece, attribute, 0, 0, 2147483647));
  }
  std::size_t points_of(pugi::xml_node piece) const { return count(piece, "NumberOfPoints"); }
  std::size_t polygons_of(pugi::xml_node piece) const { return count(piece, "NumberOfPolys"); }
  /// The order in which cells have their values.
  std::size_t cells_before_polygons(pugi::xml_node piece) const {
    return count(piece, "NumberOfVerts") + count(piece, "NumberOfLines");
  }
  std::size_t cells_of(pugi::xml_node piece) const {
    return cells_before_polygons(piece) + polygons_of(piece) + count(piece, "NumberOfStrips");
  }

  void read_points(pugi::xml_node piece) {
    const std::vector<Point> points = document_.points(piece, points_of(piece));
    if (VtkDocument::type_of(piece.child("Points").child("DataArray")) == NumberType::float64)
      shape_.mesh.position_type = NumberType::float64;
    shape_.mesh.points.insert(shape_.mesh.points.end(), points.begin(), points.end());
    checked_count<std::int32_t>(shape_.mesh.points.size(), "points");
  }

  pugi::xml_node polygon_array(pugi::xml_node piece, const char* name) const {
    const pugi::xml_node array = piece.child("Polys").find_child_by_attribute("Name", name);
    if (!array) document_.fail(piece, std::string("the polygons of the piece have no array \"") + name + "\"");
    return array;
  }

  void read_polygons(pugi::xml_node piece) {
    const std::size_t n = polygons_of(piece);
    if (n == 0) return;
    const pugi::xml_node end_array = polygon_array(piece, "offsets"),
                         corner_array = polygon_array(piece, "connectivity");
    const std::vector<double> ends = document_.values(end_array, n);
    check_ends(end_array, ends);
    const std::size_t points = points_of(piece), first = shape_.mesh.points.size();
    PolygonMesh& mesh = shape_.mesh;
    std::size_t face = 0;
    const std::vector<double> corners = document_.values(corner_array, static_cast<std::size_t>(ends.back()));
    for (std::size_t c = 0; c < corners.size(); ++c) {
      for (; static_cast<double>(c) >= ends[face]; ++face) mesh.end_face();
      if (!(corners[c] >= 0 && corners[c] < static_cast<double>(points)) || corners[c] != std::floor(corners[c]))
        document_.fail(corner_array, "polygon " + std::to_string(face) + " has the point " + number(corners[c]) +
                                         ", but there are " + std::to_string(points));
      mesh.corners.push_back(static_cast<std::int32_t>(first + static_cast<std::size_t>(corners[c])));
    }
    for (; face < n; ++face) mesh.end_face();
  }

  void check_ends(pugi::xml_node array, const std::vector<double>& ends) const {
    constexpr double most = 1e12;  // of the size that an array may have there is no doubt
    double before = 0;
    for (std::size_t f = 0; f < ends.size(); before = ends[f++])
      if (!(ends[f] >= before && ends[f] <= most && ends[f] == std::floor(ends[f])))
        document_.fail(array, "the offset of polygon " + std::to_string(f) + " does not follow those before it");
  }

  void note(const char* attribute, const std::string& what) {
    std::size_t n = 0;
    for (const pugi::xml_node piece : pieces_) n += count(piece, attribute);
    if (n > 0) shape_.findings.push_back({"left-out", counted(n, what) + "; left out", n, 0, false});
  }

  /// Vertices alone only say that the points are to be seen.
  void note_others() {
    if (!shape_.mesh.face_ends.empty()) note("NumberOfVerts", "vertex cell");
    note("NumberOfLines", "line");
    note("NumberOfStrips", "triangle strip");
  }

  void read_attributes() {
    const VtkAttributes reader(document_, pieces_, shape_.findings);
    std::vector<Attribute> all =
        reader.read("PointData", Domain::vertex, [&](std::size_t components, const VtkAttributes::Find& find) {
          std::vector<double> values;
          for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const std::vector<double> part = document_.values(find(p), components * points_of(pieces_[p]));
            values.insert(values.end(), part.begin(), part.end());
          }
          return values;
        });
    const auto of_polygons = [&](std::size_t components, const VtkAttributes::Find& find) {
      std::vector<double> values;
      for (std::size_t p = 0; p < pieces_.size(); ++p) {
        const std::vector<double> part = document_.values(find(p), components * cells_of(pieces_[p]));
        const double* first = part.data() + components * cells_before_polygons(pieces_[p]);
        values.insert(values.end(), first, first + components * polygons_of(pieces_[p]));
      }
      return values;
    };
    if (!shape_.mesh.face_ends.empty())
      for (Attribute& a : reader.read("CellData", Domain::face, of_polygons)) add_of_faces(std::move(a), all);
    reader.read_field_data(data_, all, shape_.metres_per_unit,
                           [](pugi::xml_node, const std::string&) { return false; });
    shape_.mesh.attributes = std::move(all);
  }

  /// As properties of faces are called that have the name of one of the vertices.
  static void add_of_faces(Attribute a, std::vector<Attribute>& all) {
    const auto taken = [&](const Attribute& other) { return other.name == a.name; };
    if (std::ranges::any_of(all, taken)) a.name = "face_" + a.name;
    if (std::ranges::none_of(all, taken)) all.push_back(std::move(a));
  }

  VtkDocument document_;
  RawShape shape_;
  pugi::xml_node data_;
  std::vector<pugi::xml_node> pieces_;
};

}  // namespace

RawShape read_vtp(std::string_view bytes, const std::string& path) { return VtpReader(bytes, path).read(); }

}  // namespace pelage
