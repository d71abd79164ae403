#pragma once
// Isolines of coats and the regions that they border, on the surface, on its uv and in views of it.

#include "look/palette.h"
#include "look/tessellation.h"
#include "pelage/up_axis.h"
#include "shape/line_drawing.h"

namespace pelage {

/// "b = 4", "a > b": the lines where both sides are equal, around where the left one is larger, or with "<" smaller;
/// "b": halfway between its lowest and highest values.
struct Isoline {
  std::string text;
  PlaceFormula value;
  bool halfway = false;
};

/// Formulas as in layers. Error(Fault::usage), located.
Isoline parse_isoline(const std::string& text, const std::vector<std::string>& species);

/// The paint with what the isolines read among its symbols.
Paint with_isolines(Paint paint, const std::vector<Isoline>& isolines);

/// A function at the vertices of a tessellation whose zeros are the lines; the region is where it is above 0.
struct CoatLines {
  std::string name;
  Color color{};
  std::vector<double> values;
};

/// Those that are asked for, black. Without any, the borders of the paint's layers in their colours, there where an
/// opacity is half of its range or a ramp is at its middle; without layers that have any, where the shown species is
/// halfway between the ends of its ramp. `paint`: as of with_isolines.
std::vector<CoatLines> coat_lines(const std::vector<Isoline>& isolines, const Paint& paint, const Tessellation& t,
                                  const std::vector<char>& uniform);

/// Whether there is any line.
bool crosses(const CoatLines& lines);

/// Along the surface of the tessellation.
std::vector<SpaceLines> lines_in_space(const Tessellation& t, const std::vector<CoatLines>& lines);

/// On its uv, cut where that is; first the borders of its charts as "outline". Error(Fault::usage) without uv.
LineDrawing lines_on_uv(const Tessellation& t, const std::vector<CoatLines>& lines);

enum class LineView { front, back, right, left, top, bottom };

/// From far away, hidden lines removed; first what is seen of silhouettes and borders as "outline". Coordinates count
/// from the lower left corner, `scale` to a unit of the surface.
LineDrawing lines_in_view(const Tessellation& t, const std::vector<CoatLines>& lines, LineView view, UpAxis up,
                          double scale);

}  // namespace pelage
