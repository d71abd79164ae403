#pragma once
// Grids as pictures, one pixel per node. Colours are 3 numbers per node, linear light.

#include <cstdint>
#include <vector>

#include "pelage/grid.h"
#include "pelage/image.h"

namespace pelage {

/// A sheet with y upwards; a line as one row; of a block cut_planes.
Image grid_image(const Grid& grid, const std::vector<double>& colors);

/// The three planes through the middle of a block: x and y below on the left, x and z above it, z and y beside it;
/// white between.
Image cut_planes(const Grid& grid, const std::vector<double>& colors);

/// A line in the course of time: a row for each moment, the first one at the top; all are of one length.
Image space_time_image(const std::vector<std::vector<double>>& colors);

/// Every pixel as a block of pixels.
Image zoomed(const Image& image, int across, int down);

/// The picture so many times beside and above itself: what a tile looks like where it is laid.
Image replicated(const Image& image, int across, int down);

/// Numbers as greys of 16 bits: `low` is black, `high` white; 0 where they are equal.
std::vector<std::uint16_t> greys(const std::vector<double>& values, double low, double high);

}  // namespace pelage
