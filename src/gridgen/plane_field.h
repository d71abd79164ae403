#pragma once
// Fields of a sheet in the plane, smooth at any place: what a grid is adapted to.

#include <array>
#include <string>
#include <vector>

#include "pelage/grid.h"

namespace pelage {

/// Attributes of a sheet, as formulas name them, as uniform cubic B-splines on a raster: means over about a step of it,
/// with continuous second derivatives. Beyond the sheet they go on as they are at its border.
class PlaneField {
 public:
  /// Nodes of an even sheet are the raster; others are put on one of 256 steps along the longer side of their box.
  /// Error(Fault::input) for what is no sheet in a plane z = const, or has no attribute of one of the `names`.
  PlaneField(const Grid& sheet, std::vector<std::string> names);

  const std::vector<std::string>& names() const { return names_; }
  /// Moves and stretches the sheet so that its nodes fill the box between two corners.
  void lay_between(const std::array<double, 2>& low, const std::array<double, 2>& high);

  struct Value {
    double value, dx, dy;
  };
  /// Of the attribute with that number among the names.
  Value at(std::size_t name, double x, double y) const;

 private:
  struct Axis {
    std::int32_t count = 1;
    bool periodic = false;
    double first = 0, step = 1;
  };
  struct Weights {
    std::array<std::size_t, 4> index;
    std::array<double, 4> value, slope;
  };
  static Weights weights(const Axis& axis, double x);

  std::vector<std::string> names_;
  std::array<Axis, 2> axis_;
  std::vector<std::vector<double>> values_;  ///< per name, along x first
};

/// The names among those of the sheet's attributes that a formula may read as attribute(NAME), by its text.
std::vector<std::string> names_read(const Grid& sheet, const std::string& formula);

}  // namespace pelage
