#include "run/forecast.h"

#include <algorithm>
#include <cmath>

#include "base/memory.h"
#include "base/number.h"
#include "shape/refine.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double area_of(const Triangle& t, const std::vector<Point>& points) {
  const Point& a = points[at(t[0])];
  return length(cross(difference(points[at(t[1])], a), difference(points[at(t[2])], a))) / 2;
}

/// Of even triangles with the edges that the pattern has there, on the shape's own: the limit surface is a little
/// smaller.
double even_triangles(const Program& program) {
  const TriangleMesh& shape = *program.shape;
  double sum = 0;
  for (const Triangle& t : shape.triangles) {
    double edge = program.edge;
    if (!program.edges.empty())
      edge = (program.edges[at(t[0])] + program.edges[at(t[1])] + program.edges[at(t[2])]) / 3;
    sum += area_of(t, shape.points) / (edge * edge);
  }
  return 4 / std::sqrt(3.0) * sum;
}

/// Every level halves the edges.
double split_triangles(const Program& program) {
  const TriangleMesh& shape = *program.shape;
  const double edge = prevailing_edge(shape.triangles, shape.points);
  const double levels = std::max(0.0, std::ceil(std::log2(edge / program.edge)));
  return std::pow(4.0, levels) * static_cast<double>(shape.triangles.size());
}

std::size_t most_species(const Program& program) {
  std::size_t most = 0;
  for (const StageProgram& stage : program.stages) most = std::max(most, stage.model.species_count());
  return most;
}

double nodes_of(const NodeShape& nodes) {
  struct Count {
    double operator()(const Atlas& atlas) const { return atlas.nodes; }
    double operator()(const Grid& grid) const { return static_cast<double>(grid.nodes()); }
    double operator()(const Cells& cells) const { return static_cast<double>(cells.nodes()); }
    double operator()(const TetMesh& volume) const { return static_cast<double>(volume.nodes()); }
  };
  return std::visit(Count{}, nodes);
}

/// Patterns twice as wide need a quarter of the nodes.
std::string remedy(const Program& program, double most_bytes, double bytes) {
  if (program.nodes) return "take a coarser shape";
  const double wider = std::sqrt(bytes / std::max(most_bytes, 1.0));
  return "a pattern " + number(1.05 * wider, 2) + " times as wide would fit";
}

}  // namespace

Forecast forecast(const Program& program) {
  Forecast f;
  if (program.nodes) {
    f.nodes = nodes_of(*program.nodes);
    f.triangles = static_cast<double>(program.shape->triangles.size());
  } else {
    f.triangles = program.method->own_mesh ? even_triangles(program) : split_triangles(program);
    f.nodes = f.triangles / 2;
  }
  const MemoryNeed& need = program.method->memory;
  f.bytes = f.nodes * (need.node + need.species * static_cast<double>(most_species(program)));
  return f;
}

void require_memory(const Program& program) {
  const Forecast f = forecast(program);
  const std::string what = "a growth on " + number(std::round(f.nodes)) + " nodes";
  require_memory(f.bytes, what, remedy(program, memory_left(), f.bytes));
}

}  // namespace pelage
