#include "gridgen/generate.h"

#include "base/number.h"
#include "gridgen/border.h"
#include "gridgen/free_nodes.h"
#include "gridgen/functional.h"
#include "gridgen/transfinite.h"
#include "gridgen/untangle.h"
#include "gridgen/volume.h"

namespace pelage {

namespace {

/// The nodes of one of the finer and finer grids, in the plane.
struct Level {
  Sheet sheet;
  std::vector<Point> nodes;
  double functional = 0;
  int iterations = 0;  ///< with those of all coarser ones
  bool unfolded = false, converged = false;
};

class Generator {
 public:
  Generator(const Region& region, const GenerateOptions& options)
      : region_(region), options_(options), sides_(order_sides(region, findings_)) {
    const bool flat = is_flat(sides_, region.ring);
    if (region.surface && !flat)
      throw Error(Fault::usage, "on a surface the border is given by u and v alone; leave out z", region.where);
    if (region.surface) {
      map_ = formula_surface(*region.surface);
    } else if (!flat) {
      map_ = coons_surface(sides_);
      sides_ = coons_parameters(sides_);
    }
  }

  /// On the surface that is spanned between these sides.
  Generator(const Region& region, const GenerateOptions& options, const Sides& sides)
      : region_(region), options_(options), sides_(coons_parameters(sides)), map_(coons_surface(sides)) {}

  GeneratedGrid run() {
    const Sheet sheet{options_.nodes.value_or(region_.nodes), region_.ring};
    require_enough_nodes(sheet);
    Level level = solve(sheet);
    if (!level.unfolded) refuse(level);
    return finish(level);
  }

 private:
  /// Grids with fewer cells than this along an axis start from their borders alone.
  static constexpr std::int32_t least_nodes = 12;

  void require_enough_nodes(const Sheet& sheet) const {
    if (sheet.count[0] < 2 || sheet.count[1] < 2 || (sheet.ring && sheet.count[0] < 3))
      throw Error(Fault::usage, "a grid needs two nodes along each axis, and a ring three around", region_.nodes_where);
    require_enough(region_, border(sheet), sheet.count);
  }

  Border border(const Sheet& sheet) const { return make_border(region_, sides_, sheet.count, map_.get()); }
  const NodeDensity* attract() const { return region_.attract ? &*region_.attract : nullptr; }

  std::optional<Level> coarser(const Sheet& sheet) const {
    const std::array<std::int32_t, 2> half = {(sheet.count[0] + 1) / 2, (sheet.count[1] + 1) / 2};
    if (half[0] < least_nodes || half[1] < least_nodes) return {};
    Level level = solve({half, sheet.ring});
    return level.unfolded ? std::optional(std::move(level)) : std::nullopt;
  }

  Level solve(const Sheet& sheet) const {
    const Border edge = border(sheet);
    Level level{sheet, transfinite(sheet, edge)};
    if (const auto coarse = coarser(sheet)) {
      level.nodes = refined(coarse->sheet, coarse->nodes, sheet, edge);
      level.iterations = coarse->iterations;
    }
    const Untangled untangled = untangle(sheet, level.nodes);
    level.iterations += untangled.iterations;
    level.unfolded = untangled.unfolded;
    if (level.unfolded) minimise_functional(level);
    return level;
  }

  void minimise_functional(Level& level) const {
    const SheetFunctional functional(level.sheet, level.nodes, region_.weights, attract(), map_.get());
    const Minimum minimum =
        minimise_inner(level.sheet, level.nodes, functional, {.most_iterations = options_.most_iterations});
    level.functional = minimum.value;
    level.iterations += minimum.iterations;
    level.converged = minimum.converged;
  }

  std::vector<Point> in_space(const std::vector<Point>& nodes) const { return map_ ? map_->at(nodes).x : nodes; }

  [[noreturn]] void refuse(const Level& level) const {
    const std::size_t cell = first_folded(level.sheet, level.nodes);
    const Point place = in_space({level.nodes[level.sheet.corners(cell)[0]]})[0];
    throw Error(Fault::numerics,
                "the grid cannot be unfolded near " + place_text(place) + "; take more nodes or other corners",
                region_.where);
  }

  GeneratedGrid finish(const Level& level) {
    const Sheet& sheet = level.sheet;
    GeneratedGrid result;
    result.grid.count = {sheet.count[0], sheet.count[1], 1};
    result.grid.periodic = {sheet.ring, false, false};
    result.grid.points = in_space(level.nodes);
    result.quality = grid_quality(sheet, level.nodes, result.grid.points);
    const std::vector<Point> start = transfinite(sheet, border(sheet));
    result.folded_start =
        static_cast<double>(grid_quality(sheet, start, in_space(start)).folded) / static_cast<double>(sheet.cells());
    result.functional = level.functional;
    result.iterations = level.iterations;
    result.converged = level.converged;
    result.findings = std::move(findings_);
    return result;
  }

  const Region& region_;
  const GenerateOptions& options_;
  std::vector<Finding> findings_;
  Sides sides_;
  std::unique_ptr<const SurfaceMap> map_;
};

}  // namespace

GeneratedGrid generate(const Region& region, const GenerateOptions& options) {
  return region.volume ? generate_volume(region, options) : Generator(region, options).run();
}

std::vector<Point> spanned_nodes(const Region& region, const std::array<Curve, 4>& sides,
                                 const std::array<std::int32_t, 2>& count) {
  return std::move(Generator(region, {.nodes = count}, sides).run().grid.points);
}

}  // namespace pelage
