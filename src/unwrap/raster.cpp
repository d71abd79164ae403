#include "unwrap/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pelage {

namespace {

/// Cells are as much wider than they are, so that rounding loses none.
constexpr double slack = 1e-3;

/// Columns of a triangle between two heights.
std::pair<double, double> extent(const std::array<Flat, 3>& p, double low, double high) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const auto add = [&](double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat &a = p[k], &b = p[(k + 1) % 3];
    if (a[1] >= low && a[1] <= high) add(a[0]);
    for (const double y : {low, high})
      if ((a[1] < y) != (b[1] < y)) add(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
  }
  return {least, most};
}

std::int32_t cell(double x) { return static_cast<std::int32_t>(std::floor(std::max(x, 0.0))); }

}  // namespace

Mask::Mask(const std::vector<Triangle>& triangles, const std::vector<Flat>& places) {
  for (const Flat& p : places) {
    width_ = std::max(width_, cell(p[0] + slack) + 1);
    height_ = std::max(height_, cell(p[1] + slack) + 1);
  }
  std::vector<char> cells(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  for (const Triangle& t : triangles) {
    const std::array<Flat, 3> p = {places[t[0]], places[t[1]], places[t[2]]};
    const auto [low, high] = std::minmax({p[0][1], p[1][1], p[2][1]});
    for (std::int32_t y = cell(low - slack); y <= cell(high + slack); ++y) {
      const auto [least, most] = extent(p, y - slack, y + 1 + slack);
      if (least > most) continue;
      const auto row = cells.begin() + std::ptrdiff_t{y} * width_;
      std::fill(row + cell(least - slack), row + cell(most + slack) + 1, 1);
    }
  }
  for (std::int32_t y = 0; y < height_; ++y) {
    const auto row = cells.begin() + std::ptrdiff_t{y} * width_, row_end = row + width_;
    for (auto begin = std::find(row, row_end, 1); begin != row_end;) {
      const auto end = std::find(begin, row_end, 0);
      runs_.push_back({static_cast<std::int32_t>(begin - row), static_cast<std::int32_t>(end - row)});
      begin = std::find(end, row_end, 1);
    }
    start_.push_back(runs_.size());
  }
}

Raster::Raster(std::int32_t size, std::int32_t border)
    : size_(size), border_(border), taken_(at(0, size), 0), next_taken_(at(0, size)), next_free_(at(0, size)) {
  for (std::int32_t y = 0; y < size_; ++y) renew_row(y);
}

/// Behind the last column nothing is taken and all is free.
void Raster::renew_row(std::int32_t y) {
  next_taken_[at(size_, y)] = next_free_[at(size_, y)] = size_;
  for (std::int32_t x = size_ - 1; x >= 0; --x) {
    next_taken_[at(x, y)] = taken_[at(x, y)] ? x : next_taken_[at(x + 1, y)];
    next_free_[at(x, y)] = taken_[at(x, y)] ? next_free_[at(x + 1, y)] : x;
  }
}

/// The first column in which the mask's lowest row can stand at height y, -1 if there is none.
std::int32_t Raster::first_fit(const Mask& mask, std::int32_t y) const {
  std::int32_t x = border_, fitting = 0, row = 0;
  while (fitting < mask.height()) {
    if (x + mask.width() > size_ - border_) return -1;
    bool fits = true;
    for (const Mask::Run& run : mask.row(row)) {
      const std::int32_t taken = next_taken_[at(x + run.begin, y + row)];
      if (taken >= x + run.end) continue;
      x = next_free_[at(taken, y + row)] - run.begin;
      fits = false;
      break;
    }
    fitting = fits ? fitting + 1 : 0;
    if (fits) row = (row + 1) % mask.height();
  }
  return x;
}

std::optional<Raster::Spot> Raster::lowest_place(const Mask& mask) const {
  for (std::int32_t y = border_; y + mask.height() <= size_ - border_; ++y)
    if (const std::int32_t x = first_fit(mask, y); x >= 0) return Spot{x, y};
  return {};
}

void Raster::take(const Mask& mask, const Spot& spot, std::int32_t margin) {
  for (std::int32_t row = 0; row < mask.height(); ++row)
    for (const Mask::Run& run : mask.row(row)) {
      const std::int32_t begin = std::max(spot.x + run.begin - margin, 0);
      const std::int32_t end = std::min(spot.x + run.end + margin, size_);
      for (std::int32_t y = std::max(spot.y + row - margin, 0); y <= std::min(spot.y + row + margin, size_ - 1); ++y)
        std::fill(taken_.begin() + static_cast<std::ptrdiff_t>(at(begin, y)),
                  taken_.begin() + static_cast<std::ptrdiff_t>(at(end, y)), 1);
    }
  const std::int32_t last = std::min(spot.y + mask.height() + margin, size_);
  for (std::int32_t y = std::max(spot.y - margin, 0); y < last; ++y) renew_row(y);
}

}  // namespace pelage
