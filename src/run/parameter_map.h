#pragma once
// A model over a grid of two of its parameters: every cell is a small run on a flat square.
//
// The square has no flux through its sides. Mirrored at them it is a quarter of a flat torus of twice the side, so that
// cells see neither curvature nor a boundary that a pattern would notice.

#include <functional>
#include <optional>
#include <string>

#include "pelage/progress.h"
#include "react/stability.h"
#include "run/run.h"

namespace pelage {

struct MapAxis {
  std::string parameter;
  double from = 0, to = 0;  ///< values of the first and the last cell
  int count = 1;

  double at(int i) const { return count > 1 ? from + (to - from) * i / (count - 1) : from; }
};

struct MapRequest {
  ModelSource model;
  Overrides settings;  ///< parameters that are the same in all cells
  MapAxis x, y;
  std::optional<double> side;   ///< of the squares [model length]; default: five wavelengths of the model
  std::optional<double> until;  ///< model time; default: the model's suggestion
  std::size_t species = 0;      ///< whose contrast tells a pattern from a uniform state
  std::uint64_t seed = 1;

  std::size_t cell_count() const { return static_cast<std::size_t>(x.count) * static_cast<std::size_t>(y.count); }
};

enum class CellOutcome { pattern, uniform, failed };

struct MapCell {
  double x = 0, y = 0;  ///< the parameters
  CellOutcome outcome = CellOutcome::pattern;
  double contrast = 0;  ///< range of the species over its largest magnitude since the start
  RunSummary summary;   ///< with the message of a failure
  Stability linear;
  CoatFields fields;  ///< on the square [0, 1]^2
};

struct ParameterMap {
  double side = 0;             ///< model length
  std::vector<MapCell> cells;  ///< x runs fastest, from the lowest y
};

/// Where cells that have ended are kept, as bytes, so that a map goes on where it was cut off. Called from any thread.
struct MapParts {
  std::function<std::optional<std::string>(std::size_t cell)> find = {};
  std::function<void(std::size_t cell, const std::string& bytes)> keep = {};
};

/// Runs all cells, on all threads; the same bits for any number of them. A cell whose parameters are out of range, or
/// whose run cannot begin, fails with the message and leaves the others alone. Error(Fault::usage), before any work,
/// for faults of all cells (unknown parameters, say), models of which no length is known and squares too large for a
/// mesh; Error(Fault::cancelled).
ParameterMap run_map(const MapRequest& request, const Progress& progress = {}, const MapParts& parts = {});

}  // namespace pelage
