#include "run/directions.h"

#include <array>
#include <string>

#include "base/box.h"
#include "base/suggest.h"
#include "direction/direction_field.h"
#include "pelage/error.h"
#include "shape/scalar_attributes.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// The attribute as three components: in one, or in three as PLY files have them; DIRECTION counts as well.
std::optional<std::array<std::vector<double>, 3>> given_directions(const TriangleMesh& shape) {
  const VertexAttributes all = scalar_attributes(shape);
  std::vector<std::string> names;
  for (const auto& [name, values] : all) names.push_back(name);
  for (const auto& ends : {std::array{"_1", "_2", "_3"}, {"_0", "_1", "_2"}, {"_x", "_y", "_z"}}) {
    std::array<std::vector<double>, 3> parts;
    bool complete = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string* name = matching_name(std::string(direction_attribute) + ends[k], names);
      complete = complete && name;
      if (complete) parts[k] = all.at(*name);
    }
    if (complete) return parts;
  }
  if (shape.find(direction_attribute))
    throw Error(Fault::input, std::string("the attribute \"") + direction_attribute +
                                  "\" of the mesh must be a vector of 3 components per vertex");
  return std::nullopt;
}

std::vector<Point> directions(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                              const Topology& topology) {
  const auto given = wish ? std::nullopt : given_directions(shape);
  if (!given) {
    const Connection c = make_connection(topology, shape.points);
    const double diagonal = box_of(shape.points).diagonal();
    return direction_field(c, 2, find_guides(wish.value_or(FieldWish{}), c, shape.points, diagonal)).direction;
  }
  const auto& [x, y, z] = *given;
  std::vector<Point> list;
  for (std::size_t i = 0; i < x.size(); ++i) list.push_back(unit({x[i], y[i], z[i]}));
  return list;
}

}  // namespace

std::vector<Tensor> vertex_lines(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                 const Topology& topology) {
  std::vector<Tensor> lines;
  for (const Point& d : directions(shape, wish, topology)) lines.push_back(line_tensor(d));
  return lines;
}

}  // namespace pelage
