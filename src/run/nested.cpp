#include "run/nested.h"

#include <algorithm>
#include <limits>

#include "base/report.h"
#include "shape/grid.h"

namespace pelage {

namespace {

std::array<std::int32_t, 3> place_of(const Grid& grid, std::size_t node) {
  const auto n = static_cast<std::int32_t>(node);
  return {n % grid.count[0], n / grid.count[0] % grid.count[1], n / (grid.count[0] * grid.count[1])};
}

int stride(const Grid& grid, int axis) { return grid.count[axis] > 1 ? 2 : 1; }

Attribute at_every_second_node(const Attribute& of, const Grid& grid, const Grid& coarse) {
  Attribute a = of;
  a.values.clear();
  const auto components = static_cast<std::size_t>(of.components);
  for (std::size_t n = 0; n < coarse.nodes(); ++n) {
    const auto p = place_of(coarse, n);
    const auto from =
        static_cast<std::size_t>(grid.node(p[0] * stride(grid, 0), p[1] * stride(grid, 1), p[2] * stride(grid, 2)));
    for (std::size_t c = 0; c < components; ++c) a.values.push_back(of.values[components * from + c]);
  }
  return a;
}

/// Linear between the nodes of the coarse grid.
Vector continued(const Vector& u, const Grid& coarse, const Grid& grid) {
  Vector result(static_cast<Eigen::Index>(grid.nodes()));
  for (std::size_t n = 0; n < grid.nodes(); ++n) {
    const auto p = place_of(grid, n);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      std::array<std::int32_t, 3> q{};
      for (int a = 0; a < 3; ++a) {
        const std::int32_t upper = corner >> a & 1;  // odd nodes lie between two others, even ones on one
        q[a] = stride(grid, a) == 1 ? 0 : (p[a] + p[a] % 2 * upper) / 2 % coarse.count[a];
      }
      sum += u[coarse.node(q[0], q[1], q[2])];
    }
    result[static_cast<Eigen::Index>(n)] = sum / 8;
  }
  return result;
}

/// The first stage of a program on a coarser grid.
Program on(const Grid& coarse, const Program& program) {
  Program p = program;
  Grid grid = coarse;
  for (const Attribute& a : program.shape->attributes)
    if (a.domain == Domain::vertex) grid.set(at_every_second_node(a, *as<Grid>(program.nodes), coarse));
  p.shape = std::make_shared<const TriangleMesh>(mesh_of(grid));
  p.nodes = std::make_shared<const NodeShape>(std::move(grid));
  p.stages.resize(1);
  return p;
}

bool resolves(const Grid& grid, double wavelength) {
  for (int a = 0; a < grid.dimension(); ++a)
    if (grid.spacing[static_cast<std::size_t>(a)] * least_nodes_per_wavelength > wavelength) return false;
  return true;
}

}  // namespace

std::optional<Grid> every_second_node(const Grid& grid) {
  if (!grid.even()) return std::nullopt;
  Grid coarse = grid;
  coarse.attributes.clear();
  for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dimension()); ++a) {
    const std::int32_t n = grid.count[a];
    if (n % 2 != (grid.periodic[a] ? 0 : 1)) return std::nullopt;
    coarse.count[a] = (n + 1) / 2;
    coarse.spacing[a] = 2 * grid.spacing[a];
    if (coarse.count[a] < (grid.periodic[a] ? 3 : 2)) return std::nullopt;
  }
  return coarse;
}

int grow_nested(Run& run, const Progress& progress) {
  const Program& program = run.program();
  const Grid* grid = as<Grid>(program.nodes);
  if (!grid) return 0;
  const std::optional<Grid> coarse = every_second_node(*grid);
  if (!coarse || !resolves(*coarse, program.stages[0].size)) return 0;
  Run first(on(*coarse, program));
  const int levels = grow_nested(first, progress);
  while (first.summary().status == RunStatus::running) {
    report(progress, "growing on a coarser grid", first.fraction());
    first.advance(1);
  }
  if (first.summary().status == RunStatus::failed) return 0;
  std::vector<Vector> fields;
  for (const Vector& u : first.coefficients()) fields.push_back(continued(u, *coarse, *grid));
  run.set_coefficients(std::move(fields));
  return levels + 1;
}

}  // namespace pelage
