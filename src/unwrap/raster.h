#pragma once
// Charts as cells of a raster, and the raster on which they find their places.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "unwrap/chart.h"

namespace pelage {

/// The cells that a chart touches, row by row from the lowest.
class Mask {
 public:
  struct Run {
    std::int32_t begin, end;  ///< columns, the end not among them
  };
  /// Places in cells, none of them negative.
  Mask(const std::vector<Triangle>& triangles, const std::vector<Flat>& places);

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  std::span<const Run> row(std::int32_t y) const {
    return {runs_.data() + start_[static_cast<std::size_t>(y)], runs_.data() + start_[static_cast<std::size_t>(y) + 1]};
  }

 private:
  std::int32_t width_ = 0, height_ = 0;
  std::vector<Run> runs_;
  std::vector<std::size_t> start_{0};
};

/// A square of cells, some of them taken.
class Raster {
 public:
  struct Spot {
    std::int32_t x, y;  ///< of the lower left corner of a mask
  };
  /// Masks stay `border` cells away from the sides.
  Raster(std::int32_t size, std::int32_t border);

  /// The lowest place, and of the lowest the leftmost, with all its cells free.
  std::optional<Spot> lowest_place(const Mask& mask) const;
  /// Takes the cells of a mask, and those up to `margin` cells away in x and y.
  void take(const Mask& mask, const Spot& spot, std::int32_t margin);

 private:
  std::size_t at(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_ + 1) + static_cast<std::size_t>(x);
  }
  std::int32_t first_fit(const Mask& mask, std::int32_t y) const;
  void renew_row(std::int32_t y);

  std::int32_t size_, border_;
  std::vector<char> taken_;
  std::vector<std::int32_t> next_taken_, next_free_;  ///< per cell: the first such column from there on
};

}  // namespace pelage
