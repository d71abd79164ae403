#include "run/directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/box.h"
#include "base/suggest.h"
#include "direction/direction_field.h"
#include "pelage/error.h"
#include "run/cell_lines.h"
#include "run/space_lines.h"
#include "shape/finding.h"
#include "shape/normals.h"
#include "shape/scalar_attributes.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

/// A vector whose tangential part is a smaller share of it says nothing: normals of two programs differ by more.
constexpr double least_tangent = 0.02;

using Names = std::array<std::string, 3>;

/// The attributes that hold a component each, set by set.
std::vector<Names> component_names(const VertexAttributes& all) {
  std::vector<std::string> names;
  for (const auto& [name, values] : all) names.push_back(name);
  std::vector<Names> sets;
  for (const auto& ends : {std::array{"_1", "_2", "_3"}, {"_0", "_1", "_2"}, {"_x", "_y", "_z"}}) {
    Names found;
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::string* name = matching_name(std::string(direction_attribute) + ends[k], names)) found[k] = *name;
    if (std::ranges::none_of(found, &std::string::empty)) sets.push_back(found);
  }
  return sets;
}

/// What a shape brings along.
struct GivenDirections {
  std::string name;            ///< of the attributes
  std::vector<Point> vectors;  ///< per vertex; 0 where nothing is wished
  std::size_t free = 0;        ///< so many vertices
};

/// The attribute that has them all, or their own names.
std::string name_of(const Names& names, const TriangleMesh& shape) {
  const std::string whole = names[0].substr(0, names[0].size() - 2);
  return shape.find(whole) ? whole : names[0] + ", " + names[1] + ", " + names[2];
}

bool wishes(const Point& vector, const Point& normal) {
  const double size = length(vector);
  return std::isfinite(size) && length(cross(normal, vector)) > least_tangent * size;
}

/// Whether all components of a vector count, as there is no surface.
bool is_spatial(const NodeShape& nodes) {
  const Grid* grid = std::get_if<Grid>(&nodes);
  return grid ? grid->dimension() != 2 : std::holds_alternative<TetMesh>(nodes);
}

std::size_t clear_free(std::vector<Point>& vectors, const TriangleMesh& shape, bool spatial) {
  const std::vector<Point> normals = spatial ? std::vector<Point>() : vertex_normals(shape);
  std::size_t free = 0;
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    const double size = length(vectors[v]);
    if (spatial ? std::isfinite(size) && size > 0 : wishes(vectors[v], normals[v])) continue;
    vectors[v] = {};
    ++free;
  }
  return free;
}

/// Where the shape says nothing, the smoothest field between the vertices where it does.
void complete(std::vector<Point>& directions, const Connection& c) {
  std::vector<Guide> guides;
  for (std::size_t v = 0; v < directions.size(); ++v)
    if (length(directions[v]) > 0)
      guides.push_back({static_cast<Index>(v), directions[v], std::numeric_limits<double>::infinity()});
  const DirectionField field = direction_field(c, 2, guides);
  for (std::size_t v = 0; v < directions.size(); ++v)
    if (!(length(directions[v]) > 0)) directions[v] = field.direction[v];
}

std::optional<GivenDirections> given_directions(const TriangleMesh& shape, bool spatial = false) {
  const VertexAttributes all = scalar_attributes(shape);
  const std::vector<Names> sets = component_names(all);
  if (sets.empty()) {
    if (shape.find(direction_attribute))
      throw Error(Fault::input, std::string("the attribute \"") + direction_attribute +
                                    "\" of the mesh must be a vector of 3 components per vertex");
    return std::nullopt;
  }
  GivenDirections given{name_of(sets[0], shape), {}};
  const auto &x = all.at(sets[0][0]), &y = all.at(sets[0][1]), &z = all.at(sets[0][2]);
  for (std::size_t v = 0; v < x.size(); ++v) given.vectors.push_back({x[v], y[v], z[v]});
  given.free = clear_free(given.vectors, shape, spatial);
  return given;
}

std::vector<Point> directions(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                              const Topology& topology) {
  const auto given = wish ? std::nullopt : given_directions(shape);
  if (!given) {
    const Connection c = make_connection(topology, shape.points);
    const double diagonal = box_of(shape.points).diagonal();
    return direction_field(c, 2, find_guides(wish.value_or(FieldWish{}), c, shape.points, diagonal)).direction;
  }
  std::vector<Point> list;
  for (const Point& d : given->vectors) list.push_back(unit(d));
  if (given->free > 0) complete(list, make_connection(topology, shape.points));
  return list;
}

/// The names of all sets behind the first `used`.
std::string not_followed(const TriangleMesh& shape, std::size_t used) {
  const std::vector<Names> sets = component_names(scalar_attributes(shape));
  std::string text;
  for (std::size_t s = used; s < sets.size(); ++s)
    text += "; " + name_of(sets[s], shape) + " of the shape: not followed";
  return text;
}

}  // namespace

std::vector<Tensor> vertex_lines(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                 const Topology& topology) {
  std::vector<Tensor> lines;
  for (const Point& d : directions(shape, wish, topology)) lines.push_back(line_tensor(d));
  return lines;
}

std::vector<std::string> direction_attributes(const TriangleMesh& shape) {
  std::vector<std::string> names;
  for (const Names& set : component_names(scalar_attributes(shape))) {
    const std::string whole = name_of(set, shape);
    if (shape.find(whole))
      names.push_back(whole);
    else
      names.insert(names.end(), set.begin(), set.end());
  }
  return names;
}

namespace {

/// From the node before along the first axis to the one behind.
Point along_first_axis(const Grid& grid, std::int32_t node) {
  if (grid.even()) return {1, 0, 0};
  const std::int32_t n = grid.count[0], i = node % n;
  const bool wraps_back = i == 0, wraps_on = i == n - 1;
  const bool joined = grid.periodic[0];
  Point before = grid.point(!wraps_back ? node - 1 : joined ? node + n - 1 : node);
  Point behind = grid.point(!wraps_on ? node + 1 : joined ? node - n + 1 : node);
  for (std::size_t d = 0; d < 3 && joined; ++d) {
    if (wraps_back) before[d] -= grid.period[0][d];
    if (wraps_on) behind[d] += grid.period[0][d];
  }
  return difference(behind, before);
}

/// Needs no surface to be followed.
bool is_plain(const FieldWish& wish) {
  return wish.axis.has_value() != wish.centre.has_value() && !wish.curvature && wish.from.empty() && wish.to.empty() &&
         wish.strokes.empty();
}

/// What such a wish asks for at a place; at the centre itself any direction will do.
Point plain_direction(const FieldWish& wish, const Point& place) {
  if (wish.axis) return unit(*wish.axis);
  const Point away = difference(place, *wish.centre);
  return length(away) > 0 ? unit(away) : Point{1, 0, 0};
}

/// On an even grid; across an axis that is along the sheet, or the plane across it in a block.
Tensor axis_on(const Grid& grid, const FieldWish& wish) {
  Point along = *wish.axis;
  if (grid.dimension() < 2) return line_tensor({1, 0, 0});
  if (grid.dimension() == 2) along = {along[0], along[1], 0};
  if (!(length(along) > 0)) along = {1, 0, 0};
  along = unit(along);
  if (!wish.across) return line_tensor(along);
  return grid.dimension() == 2 ? line_tensor({-along[1], along[0], 0}) : plane_tensor(along);
}

Point tangential(const Point& vector, const Point& normal) {
  const double along = dot(vector, normal);
  return unit({vector[0] - along * normal[0], vector[1] - along * normal[1], vector[2] - along * normal[2]});
}

/// Without a surface: what is wished, or the vectors that the shape brings along; else along x.
std::vector<Tensor> lines_in_space(const Space& space, const TriangleMesh& shape,
                                   const std::optional<FieldWish>& wish) {
  if (wish) return wished_in_space(space, shape.points, *wish);
  const std::optional<GivenDirections> given = given_directions(shape, true);
  return given ? given_in_space(space, given->vectors)
               : std::vector<Tensor>(shape.points.size(), line_tensor({1, 0, 0}));
}

std::vector<Tensor> plain_lines_on_sheet(const TriangleMesh& shape, const FieldWish& wish) {
  const std::vector<Point> normals = vertex_normals(shape.triangles, shape.points);
  std::vector<Tensor> lines;
  for (std::size_t v = 0; v < shape.points.size(); ++v) {
    const Point along = tangential(plain_direction(wish, shape.points[v]), normals[v]);
    lines.push_back(line_tensor(wish.across ? cross(normals[v], along) : along));
  }
  return lines;
}

std::vector<Tensor> lines_on_cells(const Cells& cells, const TriangleMesh& shape,
                                   const std::optional<FieldWish>& wish) {
  const std::optional<GivenDirections> given = wish ? std::nullopt : given_directions(shape);
  std::vector<Tensor> lines;
  for (const Point& d :
       wish ? wished_lines(cells, *wish) : completed_lines(cells, given ? given->vectors : std::vector<Point>{}))
    lines.push_back(line_tensor(d));
  return lines;
}

std::vector<Tensor> grid_lines(const Grid& grid, const Space& space, const TriangleMesh& shape,
                               const std::optional<FieldWish>& wish) {
  if (!wish && component_names(scalar_attributes(shape)).empty()) {
    if (grid.even()) return {line_tensor({1, 0, 0})};
    std::vector<Tensor> lines;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(grid.nodes()); ++v)
      lines.push_back(line_tensor(unit(along_first_axis(grid, v))));
    return lines;
  }
  if (wish && wish->axis && is_plain(*wish) && grid.even()) return {axis_on(grid, *wish)};
  if (grid.dimension() != 2) return lines_in_space(space, shape, wish);
  if (wish && is_plain(*wish)) return plain_lines_on_sheet(shape, *wish);
  return vertex_lines(shape, wish, make_topology(shape.points.size(), shape.triangles));
}

}  // namespace

std::vector<Tensor> node_lines(const NodeShape& nodes, const Space& space, const TriangleMesh& shape,
                               const std::optional<FieldWish>& wish) {
  if (const Grid* grid = std::get_if<Grid>(&nodes)) return grid_lines(*grid, space, shape, wish);
  if (const Cells* cells = std::get_if<Cells>(&nodes)) return lines_on_cells(*cells, shape, wish);
  if (std::holds_alternative<Atlas>(nodes))
    return vertex_lines(shape, wish, make_topology(shape.points.size(), shape.triangles));
  return lines_in_space(space, shape, wish);
}

FollowedDirections followed_directions(const TriangleMesh& shape, const std::optional<FieldWish>& wish,
                                       const NodeShape* nodes) {
  const std::string smoothest = nodes && std::holds_alternative<Grid>(*nodes)      ? "the first axis of the grid"
                                : nodes && std::holds_alternative<TetMesh>(*nodes) ? "the x axis"
                                                                                   : "the smoothest field of lines";
  if (wish) return {"the directions of the recipe" + not_followed(shape, 0), ""};
  const auto given = given_directions(shape, nodes && is_spatial(*nodes));
  if (!given) return {smoothest, ""};
  if (given->free == given->vectors.size())
    return {smoothest, given->name +
                           " of the shape says nothing: it is 0, not finite or along the normal everywhere; " +
                           smoothest + " takes its place"};
  std::string text = given->name + " of the shape";
  if (given->free > 0)
    text += "; " + std::to_string(given->free) + " of " + counted(given->vectors.size(), "vertex") +
            " without a direction get the smoothest field between the others";
  return {text + not_followed(shape, 1), ""};
}

}  // namespace pelage
