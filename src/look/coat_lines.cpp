#include "look/coat_lines.h"

#include <algorithm>
#include <cmath>

#include "base/box.h"
#include "base/quantile.h"
#include "look/comparison.h"
#include "pelage/error.h"
#include "shape/depth_index.h"
#include "shape/isolines.h"
#include "shape/refine.h"
#include "shape/split_corners.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// --- which lines ---------------------------------------------------------------------------------------

/// A few extreme values do not move what is halfway.
double middle(std::vector<double> values) {
  constexpr double share = 0.005;
  const double low = quantile(values, share), high = quantile(values, 1 - share);
  return (low + high) / 2;
}

std::vector<double> minus(std::vector<double> values, double level) {
  for (double& x : values) x -= level;
  return values;
}

CoatLines asked_lines(const Isoline& isoline, const Paint& paint, const Tessellation& t) {
  std::vector<double> values = formula_values(isoline.value, t.samples, paint);
  const double level = isoline.halfway ? middle(values) : 0;
  return {isoline.text, {}, minus(std::move(values), level)};
}

/// The border of a layer; values without a crossing where it has none.
CoatLines layer_lines(const PaintLayer& layer, std::size_t number, const Paint& paint, const Tessellation& t) {
  const Color color = layer.ramp ? (*layer.ramp)(1) : layer.color;
  CoatLines lines{"layer" + std::to_string(number), color, {}};
  if (layer.opacity) {
    std::vector<double> opacity = formula_values(*layer.opacity, t.samples, paint);
    for (double& x : opacity) x = std::clamp(x, 0.0, 1.0);
    const auto [low, high] = std::ranges::minmax(opacity);
    lines.values = minus(std::move(opacity), (low + high) / 2);
  } else if (layer.value) {
    lines.values = minus(formula_values(*layer.value, t.samples, paint), (layer.low + layer.high) / 2);
  }
  return lines;
}

CoatLines shown_lines(const Paint& paint, const Tessellation& t, const std::vector<char>& uniform) {
  const std::vector<double>& field = t.samples.fields[paint.shown];
  const Color color = paint.ramp(paint.invert ? 0 : 1);
  if (uniform[paint.shown]) return {paint.species[paint.shown], color, std::vector<double>(field.size(), 0)};
  return {paint.species[paint.shown], color, minus(field, middle(field))};
}

// --- lines of parts ------------------------------------------------------------------------------------

constexpr std::uint8_t silhouette = 2, hidden = 3, isoline_mark = 4;

template <class Place>
Line<Place> line_along(const Chain& chain, const std::vector<Place>& places) {
  Line<Place> line{{}, chain.closed};
  for (const std::int32_t v : chain.vertices)
    if (line.points.empty() || line.points.back() != places[at(v)]) line.points.push_back(places[at(v)]);
  if (line.closed && line.points.size() > 1 && line.points.front() == line.points.back()) line.points.pop_back();
  return line;
}

template <class Place, class Wanted>
std::vector<Line<Place>> lines_along(const SurfacePart& part, const std::vector<Place>& places, Wanted&& wanted) {
  std::vector<Line<Place>> lines;
  for (const Chain& chain : border_chains(part, wanted)) {
    Line<Place> line = line_along(chain, places);
    if (line.points.size() > (line.closed ? 2U : 1U)) lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<PlanePoint> flat(const std::vector<Point>& points) {
  std::vector<PlanePoint> result;
  for (const Point& p : points) result.push_back({p[0], p[1]});
  return result;
}

/// A surface as it lies in the plane of a drawing.
struct Sheet {
  SurfacePart part;
  std::vector<Point> places;                ///< of its vertices; z counts for nothing
  std::vector<std::vector<double>> values;  ///< per line, at its vertices

  /// What is left of it by a cut, with what is known at its vertices.
  Sheet cut(SurfacePart by) const {
    Sheet result{std::move(by), {}, {}};
    result.places = values_on(result.part, places);
    for (const std::vector<double>& v : values) result.values.push_back(values_on(result.part, v));
    return result;
  }
};

void add_lines(const Sheet& sheet, const std::vector<CoatLines>& lines, LineDrawing& drawing) {
  const auto is_outline = [](std::uint8_t mark) { return mark == own_border || mark == silhouette; };
  drawing.parts.push_back({"outline", {}, lines_along(sheet.part, flat(sheet.places), is_outline), {}});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const SurfacePart part = part_above(sheet.part, sheet.values[i], isoline_mark);
    const std::vector<PlanePoint> places = flat(values_on(part, sheet.places));
    drawing.parts.push_back({lines[i].name, lines[i].color,
                             lines_along(part, places, [](std::uint8_t mark) { return mark == isoline_mark; }),
                             lines_along(part, places, [](std::uint8_t) { return true; })});
    std::erase_if(drawing.parts.back().region, [](const Line<PlanePoint>& line) { return !line.closed; });
  }
}

// --- views ---------------------------------------------------------------------------------------------

/// To the right, upwards and towards the viewer.
using Axes = std::array<Point, 3>;

Axes axes_of(LineView view, UpAxis up) {
  static constexpr Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, left{-1, 0, 0}, down{0, -1, 0}, back{0, 0, -1};
  Axes axes{x, y, z};
  switch (view) {
    case LineView::front:
      break;
    case LineView::back:
      axes = {left, y, back};
      break;
    case LineView::right:
      axes = {back, y, x};
      break;
    case LineView::left:
      axes = {z, y, left};
      break;
    case LineView::top:
      axes = {x, back, y};
      break;
    case LineView::bottom:
      axes = {x, z, down};
      break;
  }
  if (up == UpAxis::z)
    for (Point& a : axes) a = {a[0], -a[2], a[1]};
  return axes;
}

/// Of the edges; what lies behind another part of the surface by no more belongs to the same fold.
double fold_depth(const std::vector<Triangle>& triangles, const std::vector<Point>& points) {
  return 2 * prevailing_edge(triangles, points);
}

/// The part of a sheet that nothing of the surface hides.
SurfacePart unhidden(const Sheet& sheet, const DepthIndex& index, double gap) {
  const auto seen = [&](const Point& p) { return !index.hides(p, gap); };
  std::vector<char> inside(sheet.places.size());
  for (std::size_t v = 0; v < inside.size(); ++v) inside[v] = seen(sheet.places[v]);
  const Crossing crossing = [&](std::int32_t in, std::int32_t out) {
    double low = 0, high = 1;
    for (int step = 0; step < 30; ++step) {
      const double t = (low + high) / 2;
      (seen(between(sheet.places[at(in)], sheet.places[at(out)], t)) ? low : high) = t;
    }
    return low;
  };
  return part_inside(sheet.part, inside, crossing, hidden);
}

double length_of(const Line<PlanePoint>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    sum += std::hypot(line.points[i][0] - line.points[i - 1][0], line.points[i][1] - line.points[i - 1][1]);
  return sum;
}

/// Along folds triangles look forward and backward by turns, which leaves ends of lines.
void drop_scraps(LineDrawing& drawing, double gap) {
  for (DrawnLines& part : drawing.parts)
    std::erase_if(part.lines, [gap](const auto& line) { return !line.closed && length_of(line) < gap; });
}

/// All of the surface as the view has it.
Sheet sheet_in_view(const Tessellation& t, const std::vector<CoatLines>& lines, const Axes& axes, double scale) {
  Sheet sheet{whole_surface(t.triangles, t.samples.size()), {}, {}};
  for (const Point& p : t.samples.position)
    sheet.places.push_back({scale * dot(axes[0], p), scale * dot(axes[1], p), scale * dot(axes[2], p)});
  for (const CoatLines& l : lines) sheet.values.push_back(l.values);
  return sheet;
}

}  // namespace

Isoline parse_isoline(const std::string& text, const std::vector<std::string>& species) {
  const Location where{"--isoline " + text};
  if (text.find_first_of("<>=") == std::string::npos) return {text, layer_formula({text, where}, species), true};
  const std::optional<ComparedFormulas> c = compared(text);
  if (!c)
    throw Error(Fault::usage,
                "expected a formula and a level, for example \"b = 4\", \"b < 4\" or \"a > b\", or \"b\" for halfway",
                where);
  const bool below = c->sign == '<';
  const std::string &more = below ? c->right : c->left, &less = below ? c->left : c->right;
  return {text, layer_formula({"(" + more + ") - (" + less + ")", where}, species), false};
}

Paint with_isolines(Paint paint, const std::vector<Isoline>& isolines) {
  for (const Isoline& isoline : isolines) {
    PaintLayer clear;
    clear.opacity = isoline.value;
    paint.layers.push_back(std::move(clear));
  }
  return paint;
}

std::vector<CoatLines> coat_lines(const std::vector<Isoline>& isolines, const Paint& paint, const Tessellation& t,
                                  const std::vector<char>& uniform) {
  std::vector<CoatLines> all;
  for (const Isoline& isoline : isolines) all.push_back(asked_lines(isoline, paint, t));
  if (!isolines.empty()) return all;
  for (std::size_t i = 0; i < paint.layers.size(); ++i) {
    CoatLines lines = layer_lines(paint.layers[i], i + 1, paint, t);
    if (crosses(lines)) all.push_back(std::move(lines));
  }
  if (all.empty()) all.push_back(shown_lines(paint, t, uniform));
  return all;
}

bool crosses(const CoatLines& lines) {
  const auto inside = std::ranges::count_if(lines.values, [](double x) { return x > 0; });
  return inside > 0 && inside < static_cast<std::ptrdiff_t>(lines.values.size());
}

std::vector<SpaceLines> lines_in_space(const Tessellation& t, const std::vector<CoatLines>& lines) {
  const SurfacePart whole = whole_surface(t.triangles, t.samples.size());
  std::vector<SpaceLines> all;
  for (const CoatLines& l : lines) {
    const SurfacePart part = part_above(whole, l.values, isoline_mark);
    all.push_back({l.name, lines_along(part, values_on(part, t.samples.position),
                                       [](std::uint8_t mark) { return mark == isoline_mark; })});
  }
  return all;
}

LineDrawing lines_on_uv(const Tessellation& t, const std::vector<CoatLines>& lines) {
  const auto uv = std::ranges::find(t.attributes, "uv", &Attribute::name);
  if (uv == t.attributes.end())
    throw Error(Fault::usage, "the shape has no uv to draw lines on; pelage unwrap gives it some, or take a view");
  TriangleMesh mesh{t.samples.position, t.triangles, {}, {}, {}};
  mesh.set(*uv);
  for (std::size_t i = 0; i < lines.size(); ++i)
    mesh.set({"line" + std::to_string(i), 1, Domain::vertex, lines[i].values});
  mesh = split_corners(mesh);
  Sheet sheet{whole_surface(mesh.triangles, mesh.points.size()), {}, {}};
  const std::vector<double>& places = mesh.find("uv")->values;
  Box box;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    sheet.places.push_back({places[2 * v], places[2 * v + 1], 0});
    box.add(sheet.places.back());
  }
  for (std::size_t i = 0; i < lines.size(); ++i) sheet.values.push_back(mesh.find("line" + std::to_string(i))->values);
  LineDrawing drawing{{}, {}, false, {}};
  for (std::size_t d = 0; d < 2; ++d) {  // whole tiles
    constexpr double rounding = 1e-6;
    drawing.low[d] = std::min(0.0, std::floor(box.low[d] + rounding));
    drawing.high[d] = std::max(1.0, std::ceil(box.high[d] - rounding));
  }
  add_lines(sheet, lines, drawing);
  return drawing;
}

LineDrawing lines_in_view(const Tessellation& t, const std::vector<CoatLines>& lines, LineView view, UpAxis up,
                          double scale) {
  const Axes axes = axes_of(view, up);
  const Sheet all = sheet_in_view(t, lines, axes, scale);
  std::vector<double> facing;
  for (const Point& n : t.samples.normal) facing.push_back(dot(n, axes[2]));
  const Sheet front = all.cut(part_above(all.part, facing, silhouette));
  const DepthIndex index(t.triangles, all.places);
  const double gap = fold_depth(t.triangles, all.places);
  Sheet seen = front.cut(unhidden(front, index, gap));
  const Box box = box_of(seen.places);
  if (!(box.high[0] > box.low[0] && box.high[1] > box.low[1]))
    throw Error(Fault::usage, "nothing of the surface is seen from that side; take another --lines-view");
  for (Point& p : seen.places) p = difference(p, box.low);
  LineDrawing drawing{{0, 0}, {box.high[0] - box.low[0], box.high[1] - box.low[1]}, true, {}};
  add_lines(seen, lines, drawing);
  drop_scraps(drawing, gap);
  return drawing;
}

}  // namespace pelage
