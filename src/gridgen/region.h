#pragma once
// Regions that grids are generated for: their borders, and what is wanted of the grid. docs/regions.md has the format.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gridgen/curve.h"
#include "gridgen/node_density.h"

namespace pelage {

/// Of the functional (gridgen/functional.h). Only their proportions matter.
struct GridWeights {
  double length = 0.1, smoothness = 0.3, area = 0.3, orthogonality = 0.3;
};

/// Sides by their numbers: south and north run along the first axis of the grid, from west to east, west and east along
/// the second one, from south to north.
enum class GridSide { south, east, north, west };
inline constexpr std::array<const char*, 4> side_names = {"south", "east", "north", "west"};

/// One closed curve to be cut into four sides (gridgen/outline.h).
struct Outline {
  /// A place on the curve: a parameter from 0 to 1, or the point of the curve nearest to one.
  struct Corner {
    std::optional<double> parameter;
    Point point{};
    Location where;
  };
  Curve curve;
  std::vector<Corner> corners;  ///< four, anticlockwise from the south-western one, or none: they are looked for
};

/// Between a bottom and a top of four sides each, in space. Once ordered, all edges run along their axes.
struct Volume {
  std::array<Curve, 4> bottom, top;           ///< in the order of GridSide
  std::array<std::optional<Curve>, 4> given;  ///< the edges from the corners of the bottom, or straight ones
  std::array<Curve, 4> pillars;               ///< the same, once ordered
  std::int32_t nodes = 21;                    ///< from bottom to top
  Location where;
};
inline constexpr std::array<const char*, 4> pillar_names = {"south-west", "south-east", "north-east", "north-west"};

struct Region {
  std::string name, summary;
  Location where;
  std::array<std::int32_t, 2> nodes{41, 41};
  Location nodes_where;
  bool ring = false;  ///< the first axis is periodic: south and north are closed, and there is no west and east
  std::array<std::optional<Curve>, 4> sides{};  ///< in the order of GridSide; they may run either way
  std::optional<Volume> volume;                 ///< instead of sides
  std::optional<Outline> outline;               ///< instead of sides
  GridWeights weights;
  std::optional<NodeDensity> attract;
  std::optional<std::array<FormulaFunction, 3>> surface;  ///< of u and v, in which the borders are then given
};

/// Reads a region. Error(usage), located, for what is not one; whether its sides meet shows when the grid is made.
Region parse_region(std::string_view text, const std::string& file);

}  // namespace pelage
