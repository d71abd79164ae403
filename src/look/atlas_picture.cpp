#include "look/atlas_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "look/canvas.h"

namespace pelage {

namespace {

constexpr Color background = {0.9, 0.9, 0.9}, border = {0.03, 0.03, 0.03};

/// Hues a golden section apart: neighbours in number differ, and all of many charts are even in lightness.
Color chart_color(std::int32_t chart) {
  const double hue = 2 * std::numbers::pi * std::fmod(chart * (std::numbers::phi - 1), 1.0);
  Color color = linear_from_oklab({0.75, 0.1 * std::cos(hue), 0.1 * std::sin(hue)});
  for (double& x : color) x = std::clamp(x, 0.0, 1.0);
  return color;
}

/// Sums of colours by the share of a pixel that faces cover: neighbours leave no gap.
class Coverage {
 public:
  explicit Coverage(int size) : size_(size), sum_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  /// By the even-odd rule, on lines a quarter of a pixel apart.
  void fill(const std::vector<Spot>& ring, const Color& color) {
    double low = size_, high = 0;
    for (const Spot& s : ring) {
      low = std::min(low, s.y);
      high = std::max(high, s.y);
    }
    const int first = static_cast<int>(std::ceil(lines * low - 0.5)), last = static_cast<int>(lines * high - 0.5);
    for (int line = std::max(first, 0); line <= std::min(last, lines * size_ - 1); ++line) fill_line(ring, line, color);
  }
  Image image() const {
    Image image{size_, size_, {}};
    image.rgb.reserve(3 * sum_.size());
    for (const auto& [r, g, b, share] : sum_) {
      const double left = std::max(0.0, 1 - share), scale = share > 1 ? 1 / share : 1;
      for (const auto& [sum, behind] : {std::pair(r, background[0]), {g, background[1]}, {b, background[2]}})
        image.rgb.push_back(static_cast<float>(scale * sum + left * behind));
    }
    return image;
  }

 private:
  static constexpr int lines = 4;

  void fill_line(const std::vector<Spot>& ring, int line, const Color& color) {
    const double y = (line + 0.5) / lines;
    std::vector<double> crossings;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Spot &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if ((a.y < y) != (b.y < y)) crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    std::ranges::sort(crossings);
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) span(crossings[k], crossings[k + 1], line / lines, color);
  }
  void span(double begin, double end, int y, const Color& color) {
    for (int x = std::max(static_cast<int>(begin), 0); x < std::min(end, 1.0 * size_); ++x) {
      const double share = (std::min(end, x + 1.0) - std::max(begin, 1.0 * x)) / lines;
      auto& pixel = sum_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x)];
      for (std::size_t k = 0; k < 3; ++k) pixel[k] += share * color[k];
      pixel[3] += share;
    }
  }

  int size_;
  std::vector<std::array<double, 4>> sum_;
};

std::vector<Spot> ring_of(const PolygonMesh& mesh, const Attribute& uv, std::size_t face, int size) {
  std::vector<Spot> ring;
  for (std::size_t c = mesh.face_begin(face); c < mesh.face_ends[face]; ++c)
    ring.push_back({size * uv.values[2 * c], size * (1 - uv.values[2 * c + 1])});
  return ring;
}

/// Edges that the rings of two faces do not share.
class Borders {
 public:
  void add(const std::vector<Spot>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Spot &a = ring[k], &b = ring[(k + 1) % ring.size()];
      ++count_[std::minmax({std::pair(a.x, a.y), std::pair(b.x, b.y)})];
    }
  }
  void draw(Canvas& canvas, double width) const {
    for (const auto& [ends, count] : count_)
      if (count == 1)
        canvas.line({{ends.first.first, ends.first.second}, {ends.second.first, ends.second.second}}, width, border);
  }

 private:
  using Place = std::pair<double, double>;
  std::map<std::pair<Place, Place>, int> count_;
};

}  // namespace

Image atlas_picture(const PolygonMesh& mesh, const std::vector<std::int32_t>& chart, int size) {
  const Attribute& uv = *mesh.find("uv");
  Coverage coverage(size);
  Borders borders;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (chart[f] < 0) continue;
    const std::vector<Spot> ring = ring_of(mesh, uv, f, size);
    coverage.fill(ring, chart_color(chart[f]));
    borders.add(ring);
  }
  Canvas canvas(size, size, background);
  canvas.picture(coverage.image(), 0, 0);
  borders.draw(canvas, std::max(1.0, size / 700.0));
  return canvas.image();
}

}  // namespace pelage
