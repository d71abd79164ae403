#include "look/plot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "look/text.h"
#include "look/ticks.h"

namespace pelage {

namespace {

// Sizes in pixels, for a picture of 1600 x 1000 that is printed about 16 cm wide.
constexpr double title_size = 46, text_size = 34, small_size = 30;
constexpr double thin = 1.5, thick = 4.5;
constexpr Rectangle margins = {170, 150, 50, 130};

const Color ink = {0.012, 0.012, 0.014}, pale_ink = {0.12, 0.12, 0.13}, grid = {0.8, 0.8, 0.8}, paper = {1, 1, 1};

/// Where the segment a-b leaves and enters the box (Liang, Barsky 1984): the share of it that lies inside.
std::array<double, 2> share_inside(const Spot& a, const Spot& b, const Rectangle& box) {
  double from = 0, to = 1;
  const auto cut = [&](double direction, double room) {  // inside where direction * t <= room
    if (direction > 0) to = std::min(to, room / direction);
    if (direction < 0) from = std::max(from, room / direction);
    if (direction == 0 && room < 0) to = -1;
  };
  cut(a.x - b.x, a.x - box.left);
  cut(b.x - a.x, box.right - a.x);
  cut(a.y - b.y, a.y - box.top);
  cut(b.y - a.y, box.bottom - a.y);
  return {from, to};
}

void draw_axes(Canvas& canvas, const Plot& plot, const PlotFrame& frame) {
  const Rectangle& box = frame.box();
  for (const Tick& t : round_ticks(plot.x.low, plot.x.high, 9)) {
    const double x = frame.place(t.value, 0).x;
    canvas.line({{x, box.top}, {x, box.bottom}}, 1, grid);
    canvas.line({{x, box.bottom}, {x, box.bottom + 10}}, thin, ink);
    canvas.text(t.label, {x, box.bottom + 46}, {small_size, ink, Align::centre});
  }
  for (const Tick& t : round_ticks(plot.y.low, plot.y.high, 7)) {
    const double y = frame.place(0, t.value).y;
    canvas.line({{box.left, y}, {box.right, y}}, 1, grid);
    canvas.line({{box.left - 10, y}, {box.left, y}}, thin, ink);
    canvas.text(t.label, {box.left - 18, y + small_size / 3}, {small_size, ink, Align::right});
  }
}

void draw_frame(Canvas& canvas, const Plot& plot, const PlotFrame& frame) {
  const Rectangle& box = frame.box();
  if (plot.y.low < 0 && plot.y.high > 0) {
    const double zero = frame.place(0, 0).y;
    canvas.line({{box.left, zero}, {box.right, zero}}, 2, ink);
  }
  canvas.frame(box, 2, ink);
  const double right_end = plot.width - margins.right;
  canvas.text(fitted_text(plot.title, title_size, right_end - box.left), {box.left, 64}, {title_size, ink});
  canvas.text(fitted_text(plot.subtitle, small_size, right_end - box.left), {box.left, 114}, {small_size, pale_ink});
  canvas.text(plot.x_label, {(box.left + box.right) / 2, box.bottom + 104}, {text_size, ink, Align::centre});
  canvas.text(plot.y_label, {48, (box.top + box.bottom) / 2}, {text_size, ink, Align::centre, true});
}

void draw_curve(Canvas& canvas, const PlotCurve& curve, const std::vector<Spot>& spots) {
  if (curve.dashed)
    canvas.dashed_line(spots, thick - 1, curve.color, 18, 12);
  else
    canvas.line(spots, thick, curve.color);
}

bool crosses(const std::vector<Spot>& line, const Rectangle& box) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto [from, to] = share_inside(line[i - 1], line[i], box);
    if (from <= to) return true;
  }
  return false;
}

void draw_mark(Canvas& canvas, const PlotMark& mark, const std::vector<std::vector<Spot>>& lines,
               const PlotFrame& frame) {
  const Spot at = frame.place(mark.x, mark.y);
  canvas.dashed_line({{at.x, at.y}, {at.x, frame.box().bottom}}, 2, mark.color, 6, 8);
  canvas.disc(at, 11, paper);
  canvas.disc(at, 8, mark.color);
  constexpr double line = 1.25 * small_size;
  double width = 0;
  for (const std::string& words : mark.words) width = std::max(width, text_width(words, small_size));
  const Rectangle place =
      place_of_words(at, {width, line * static_cast<double>(mark.words.size())}, lines, frame.box());
  const bool leftwards = place.left < at.x;
  for (std::size_t i = 0; i < mark.words.size(); ++i)
    canvas.text(mark.words[i],
                {leftwards ? place.right : place.left, place.top + small_size + line * static_cast<double>(i)},
                {small_size, ink, leftwards ? Align::right : Align::left});
}

/// A row of samples with their names above the right end of the axes.
void draw_legend(Canvas& canvas, const Plot& plot, const Rectangle& box) {
  constexpr double sample = 60, gap = 34;
  double x = box.right;
  const double y = box.top - 14;
  const auto entry = [&](const std::string& label, auto&& draw_sample) {
    if (label.empty()) return;
    x -= text_width(label, small_size);
    canvas.text(label, {x, y}, {small_size, ink});
    x -= sample + 12;
    draw_sample(x, y - small_size / 3.4);
    x -= gap;
  };
  for (auto b = plot.bands.rbegin(); b != plot.bands.rend(); ++b)
    entry(b->label, [&](double left, double middle) {
      canvas.fill({left, middle - 12, left + sample, middle + 12}, b->color);
    });
  for (auto c = plot.curves.rbegin(); c != plot.curves.rend(); ++c)
    entry(c->label, [&](double left, double middle) {
      draw_curve(canvas, *c, {{left, middle}, {left + sample, middle}});
    });
}

}  // namespace

Rectangle place_of_words(const Spot& at, const Spot& size, const std::vector<std::vector<Spot>>& lines,
                         const Rectangle& box) {
  constexpr double gap = 20, above_axis = 10;
  std::optional<Rectangle> first;
  for (const double bottom : {box.bottom - above_axis, box.top + gap + size.y})
    for (const double left : {at.x + gap, at.x - gap - size.x}) {
      const Rectangle place{left, bottom - size.y, left + size.x, bottom};
      if (place.left < box.left || place.right > box.right) continue;
      if (std::ranges::none_of(lines, [&](const auto& line) { return crosses(line, place); })) return place;
      if (!first) first = place;
    }
  return first.value_or(
      Rectangle{box.left, box.bottom - above_axis - size.y, box.left + size.x, box.bottom - above_axis});
}

PlotFrame::PlotFrame(const Plot& plot)
    : box_{margins.left, margins.top + 60, plot.width - margins.right, plot.height - margins.bottom},
      x_(plot.x),
      y_(plot.y) {}

Spot PlotFrame::place(double x, double y) const {
  return {box_.left + (x - x_.low) / (x_.high - x_.low) * box_.width(),
          box_.bottom - (y - y_.low) / (y_.high - y_.low) * box_.height()};
}

std::vector<std::vector<Spot>> visible_parts(const PlotCurve& curve, const PlotFrame& frame) {
  std::vector<std::vector<Spot>> parts;
  bool inside = false;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const Spot a = frame.place(curve.points[i - 1][0], curve.points[i - 1][1]);
    const Spot b = frame.place(curve.points[i][0], curve.points[i][1]);
    const auto [from, to] = share_inside(a, b, frame.box());
    const auto at = [&, &p = a, &q = b](double t) { return Spot{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)}; };
    if (from > to) {
      inside = false;
      continue;
    }
    if (!inside || from > 0) parts.push_back({at(from)});
    parts.back().push_back(at(to));
    inside = to == 1;
  }
  return parts;
}

Image draw(const Plot& plot) {
  Canvas canvas(plot.width, plot.height, paper);
  const PlotFrame frame(plot);
  for (const PlotBand& band : plot.bands) {
    const double low = std::max(band.x.low, plot.x.low), high = std::min(band.x.high, plot.x.high);
    canvas.fill({frame.place(low, 0).x, frame.box().top, frame.place(high, 0).x, frame.box().bottom}, band.color);
  }
  draw_axes(canvas, plot, frame);
  std::vector<std::vector<Spot>> lines;
  for (const PlotCurve& curve : plot.curves)
    for (std::vector<Spot>& part : visible_parts(curve, frame)) {
      draw_curve(canvas, curve, part);
      lines.push_back(std::move(part));
    }
  for (const PlotMark& mark : plot.marks) draw_mark(canvas, mark, lines, frame);
  draw_frame(canvas, plot, frame);
  draw_legend(canvas, plot, frame.box());
  return canvas.image();
}

}  // namespace pelage
