#pragma once
// Discs laid into the plane with little distortion, none of their triangles turned over.

#include <functional>

#include "unwrap/chart.h"

namespace pelage {

/// Sets uv and stretch of a disc: minimises the symmetric Dirichlet energy, the mean of |J|^2 + |J^-1|^2 (Smith,
/// Schaefer 2015), with a free border, from conformal coordinates (Levy, Petitjean, Ray, Maillot 2002), by Newton's
/// method on the positive parts of the triangles' Hessians (Smith, de Goes, Kim 2019). Areas as a whole are those in
/// space. False where triangles of the conformal map are turned over, which tells that the disc is far from flat, and
/// where `promising`, which is asked of the chart with that map, says so.
bool flatten(const LinkedFaces& faces, Chart& chart, const std::function<bool(const Chart&)>& promising = {});

/// Tutte's embedding alone: a convex border, so that nothing ever overlaps.
void embed(const LinkedFaces& faces, Chart& chart);

}  // namespace pelage
