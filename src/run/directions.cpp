#include "run/directions.h"

#include <array>
#include <string>

#include "base/box.h"
#include "direction/direction_field.h"
#include "pelage/error.h"
#include "shape/scalar_attributes.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// The attribute as three components: in one, or in three as PLY files have them.
std::optional<std::array<std::vector<double>, 3>> given_directions(const TriangleMesh& shape) {
  const VertexAttributes all = scalar_attributes(shape.attributes);
  for (const int first : {1, 0}) {
    std::array<std::vector<double>, 3> parts;
    bool complete = true;
    for (int k = 0; k < 3; ++k) {
      const auto found = all.find(direction_attribute + ("_" + std::to_string(first + k)));
      complete = complete && found != all.end();
      if (complete) parts[static_cast<std::size_t>(k)] = found->second;
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
