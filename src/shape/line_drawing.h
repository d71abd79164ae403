#pragma once
// Lines and regions, in a plane and in space, as files hold them.

#include <array>
#include <string>
#include <vector>

#include "pelage/point.h"

namespace pelage {

using PlanePoint = std::array<double, 2>;  ///< to the right and upwards

template <class Place>
struct Line {
  std::vector<Place> points;  ///< of a closed one the first is not repeated at the end
  bool closed = false;
};

/// What belongs together.
struct DrawnLines {
  std::string name;
  std::array<double, 3> color{};         ///< linear light
  std::vector<Line<PlanePoint>> lines;   ///< to be cut or stitched along
  std::vector<Line<PlanePoint>> region;  ///< closed; together, by the even-odd rule, what they enclose is filled
};

struct LineDrawing {
  PlanePoint low{}, high{};  ///< corners of the sheet
  bool millimetres = true;   ///< else coordinates of textures
  std::vector<DrawnLines> parts;
};

struct SpaceLines {
  std::string name;
  std::vector<Line<Point>> lines;
};

}  // namespace pelage
