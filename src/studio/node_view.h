#pragma once
// A coat at the nodes of its run: coarser than what files get, and painted in milliseconds, for a screen that follows
// the growth.

#include <cstdint>

#include "look/palette.h"
#include "run/run.h"

namespace pelage {

struct NodeView {
  std::vector<Triangle> triangles;
  CoatSamples samples;  ///< at their vertices: the nodes, or of shapes without a surface through them what they show
  bool moves = false;   ///< whether positions may be others after every step
};

/// With all that the paint reads.
NodeView view_nodes(const Run& run, const Paint& paint);

/// Brings fields, and positions where they move, to where the run is.
void refresh(NodeView& view, const Run& run, const Paint& paint);

/// Four bytes a vertex, sRGB and an alpha of 255.
std::vector<std::uint8_t> view_colors(const NodeView& view, const Paint& paint, const std::vector<char>& uniform);

/// Values by three, as screens take them.
std::vector<float> as_floats(const std::vector<Point>& points);
std::vector<std::uint32_t> as_indices(const std::vector<Triangle>& triangles);
std::vector<std::uint8_t> as_bytes(const std::vector<double>& linear_colors);

}  // namespace pelage
