#include "look/canvas.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "look/text.h"

namespace pelage {

namespace {

Color encoded(const Color& linear) {
  return {srgb_from_linear(linear[0]), srgb_from_linear(linear[1]), srgb_from_linear(linear[2])};
}

/// How much of the pixel [i, i + 1] lies in [low, high].
double overlap(int i, double low, double high) {
  return std::clamp(std::min(high, i + 1.0) - std::max(low, i + 0.0), 0.0, 1.0);
}

double distance_to_segment(const Spot& p, const Spot& a, const Spot& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Pixels of a picture, or a part of them, by their ranges.
struct PixelRange {
  int left, top, right, bottom;  ///< right and bottom exclusive
};

PixelRange pixels_around(const Rectangle& box, double margin, int width, int height) {
  const auto clamped = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {clamped(std::floor(box.left - margin), width), clamped(std::floor(box.top - margin), height),
          clamped(std::ceil(box.right + margin), width), clamped(std::ceil(box.bottom + margin), height)};
}

Rectangle box_around(const std::vector<Spot>& spots) {
  Rectangle box{spots.front().x, spots.front().y, spots.front().x, spots.front().y};
  for (const Spot& s : spots)
    box = {std::min(box.left, s.x), std::min(box.top, s.y), std::max(box.right, s.x), std::max(box.bottom, s.y)};
  return box;
}

/// The part of a line of dashes from `from` to `to` along it.
std::vector<Spot> cut_out(const std::vector<Spot>& spots, double from, double to) {
  std::vector<Spot> part;
  double start = 0;
  for (std::size_t i = 1; i < spots.size() && start < to; ++i) {
    const Spot &a = spots[i - 1], &b = spots[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y), end = start + length;
    if (end > from && length > 0) {
      const auto at = [&](double s) {
        const double t = std::clamp((s - start) / length, 0.0, 1.0);
        return Spot{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
      };
      if (part.empty()) part.push_back(at(from));
      part.push_back(at(to));
    }
    start = end;
  }
  return part;
}

double length_of(const std::vector<Spot>& spots) {
  double length = 0;
  for (std::size_t i = 1; i < spots.size(); ++i)
    length += std::hypot(spots[i].x - spots[i - 1].x, spots[i].y - spots[i - 1].y);
  return length;
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background) : width_(width), height_(height) {
  const Color color = encoded(background);
  encoded_.reserve(std::size_t{3} * width * height);
  for (int i = 0; i < width * height; ++i)
    for (const double c : color) encoded_.push_back(static_cast<float>(c));
}

void Canvas::blend(int x, int y, const Color& color, double coverage) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  float* pixel = &encoded_[std::size_t{3} * (static_cast<std::size_t>(y) * width_ + x)];
  for (std::size_t k = 0; k < 3; ++k) pixel[k] += static_cast<float>(coverage * (color[k] - pixel[k]));
}

void Canvas::fill(const Rectangle& box, const Color& color, double opacity) {
  const Color value = encoded(color);
  const PixelRange range = pixels_around(box, 0, width_, height_);
  for (int y = range.top; y < range.bottom; ++y)
    for (int x = range.left; x < range.right; ++x)
      blend(x, y, value, opacity * overlap(x, box.left, box.right) * overlap(y, box.top, box.bottom));
}

void Canvas::line(const std::vector<Spot>& spots, double width, const Color& color) {
  const double margin = width / 2 + 1;
  const PixelRange all = pixels_around(box_around(spots), margin, width_, height_);
  const int columns = all.right - all.left;
  std::vector<double> mask(static_cast<std::size_t>(columns) * (all.bottom - all.top));
  for (std::size_t i = 1; i < spots.size(); ++i) {
    const PixelRange range = pixels_around(box_around({spots[i - 1], spots[i]}), margin, width_, height_);
    for (int y = range.top; y < range.bottom; ++y)
      for (int x = range.left; x < range.right; ++x) {
        const double away = distance_to_segment({x + 0.5, y + 0.5}, spots[i - 1], spots[i]);
        double& covered = mask[static_cast<std::size_t>((y - all.top) * columns + x - all.left)];
        covered = std::max(covered, std::clamp(width / 2 + 0.5 - away, 0.0, std::min(1.0, width)));
      }
  }
  const Color value = encoded(color);
  for (int y = all.top; y < all.bottom; ++y)
    for (int x = all.left; x < all.right; ++x)
      blend(x, y, value, mask[static_cast<std::size_t>((y - all.top) * columns + x - all.left)]);
}

void Canvas::dashed_line(const std::vector<Spot>& spots, double width, const Color& color, double dash, double gap) {
  const double length = length_of(spots);
  for (double from = 0; from < length; from += dash + gap)
    line(cut_out(spots, from, std::min(length, from + dash)), width, color);
}

void Canvas::frame(const Rectangle& b, double width, const Color& color) {
  line({{b.left, b.top}, {b.right, b.top}, {b.right, b.bottom}, {b.left, b.bottom}, {b.left, b.top}}, width, color);
}

void Canvas::disc(const Spot& centre, double radius, const Color& color) { line({centre, centre}, 2 * radius, color); }

void Canvas::text(const std::string& words, const Spot& spot, const TextStyle& style) {
  const double length = text_width(words, style.size);
  const double before = style.align == Align::left ? 0 : style.align == Align::centre ? length / 2 : length;
  const int x0 = static_cast<int>(std::lround(style.upwards ? spot.x : spot.x - before));
  const int y0 = static_cast<int>(std::lround(style.upwards ? spot.y + before : spot.y));
  const TextMask mask = rasterise_text(words, style.size);
  const Color value = encoded(style.color);
  for (int j = 0; j < mask.height; ++j)
    for (int i = 0; i < mask.width; ++i) {
      const float coverage = mask.coverage[static_cast<std::size_t>(j * mask.width + i)];
      const int along = mask.left + i, down = mask.top + j;
      if (style.upwards)
        blend(x0 + down, y0 - along - 1, value, coverage);
      else
        blend(x0 + along, y0 + down, value, coverage);
    }
}

void Canvas::picture(const Image& picture, int x, int y) {
  for (int j = 0; j < picture.height; ++j)
    for (int i = 0; i < picture.width; ++i) {
      const float* rgb = &picture.rgb[std::size_t{3} * (static_cast<std::size_t>(j) * picture.width + i)];
      blend(x + i, y + j, encoded({rgb[0], rgb[1], rgb[2]}), 1);
    }
}

Image Canvas::image() const {
  Image result{width_, height_, std::vector<float>(encoded_.size())};
  for (std::size_t i = 0; i < encoded_.size(); ++i)
    result.rgb[i] = static_cast<float>(linear_from_srgb(static_cast<double>(encoded_[i])));
  return result;
}

}  // namespace pelage
