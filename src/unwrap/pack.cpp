#include "unwrap/pack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "base/number.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/finding.h"
#include "unwrap/outline.h"
#include "unwrap/raster.h"

namespace pelage {

namespace {

constexpr int turns = 8;

/// The places of a chart when it is turned by k parts of a circle.
std::vector<Flat> in_turn(const Chart& chart, int k, double scale) {
  const double angle = 2 * std::numbers::pi * k / turns;
  return turned(chart.uv, scale * std::cos(angle), scale * std::sin(angle));
}

/// A chart turned by k parts of a circle, at its lowest free place.
struct Candidate {
  std::optional<Mask> mask;
  std::optional<Raster::Spot> spot;

  Candidate() = default;
  Candidate(const Chart& chart, int k, double scale, const Raster& raster)
      : mask(std::in_place, chart.triangles, in_turn(chart, k, scale)), spot(raster.lowest_place(*mask)) {}
  std::int32_t top() const { return spot ? spot->y + mask->height() : std::numeric_limits<std::int32_t>::max(); }
};

struct Place {
  int turn = 0;
  Raster::Spot spot{};
};

class Packer {
 public:
  Packer(const std::vector<Chart>& charts, std::int32_t cells, std::int32_t margin, const Progress& progress)
      : charts_(charts), progress_(progress), cells_(cells), margin_(margin), order_(charts.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::vector<double> size;
    for (const Chart& c : charts) size.push_back(flat_box(c.uv).height() + flat_box(c.uv).width());
    std::ranges::stable_sort(order_, [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
    for (const Chart& c : charts) area_ += c.area;
  }

  /// Fills in the places and returns the scale, in cells.
  double pack(std::vector<Place>& places);

 private:
  double scale_of(double share) const { return cells_ * std::sqrt(share / area_); }
  bool fits(double scale, std::vector<Place>& places) const;

  const std::vector<Chart>& charts_;
  const Progress& progress_;
  std::int32_t cells_, margin_;
  std::vector<std::size_t> order_;  ///< largest first
  double area_ = 0;
};

bool Packer::fits(double scale, std::vector<Place>& places) const {
  Raster raster(cells_, (margin_ + 1) / 2);
  places.assign(charts_.size(), {});
  for (const std::size_t c : order_) {
    if (progress_ && !progress_("packing", -1)) throw Error(Fault::cancelled, "interrupted");
    std::array<Candidate, turns> candidates;
    parallel_chunks(turns,
                    [&](std::size_t k) { candidates[k] = Candidate(charts_[c], static_cast<int>(k), scale, raster); });
    const auto best = std::ranges::min_element(candidates, {}, &Candidate::top);
    if (!best->spot) return false;
    places[c] = {static_cast<int>(best - candidates.begin()), *best->spot};
    raster.take(*best->mask, *best->spot, margin_);
  }
  return true;
}

/// Down in steps until all charts fit, then by halving between what fits and what does not.
double Packer::pack(std::vector<Place>& places) {
  constexpr double step = 0.92, least = 1e-9;
  constexpr int halvings = 4;
  double fitting = 0.8, failing = fitting / step;
  for (; !fits(scale_of(fitting), places); fitting *= fitting > 0.2 ? step : step / 4) {
    if (fitting < least)
      throw Error(Fault::usage, counted(charts_.size(), "chart") +
                                    " with their margins do not fit the atlas; take a "
                                    "higher resolution or a smaller margin");
    failing = fitting;
  }
  for (int k = 0; k < halvings; ++k) {
    const double middle = (fitting + failing) / 2;
    std::vector<Place> found;
    if (fits(scale_of(middle), found)) {
      fitting = middle;
      places = std::move(found);
    } else {
      failing = middle;
    }
  }
  return scale_of(fitting);
}

/// More cells than that take time and save little room.
constexpr int most_cells = 1024;

constexpr double steps_of_uv = 1 << 24;

}  // namespace

double pack(std::vector<Chart>& charts, int resolution, double margin, const Progress& progress) {
  const std::int32_t cells = std::min(resolution, most_cells);
  const double wanted = std::ceil(margin * cells / resolution);
  if (wanted >= cells)
    throw Error(Fault::usage, "a margin of " + number(margin) + " texels is as wide as the atlas; take a smaller one");
  parallel_chunks(charts.size(), [&](std::size_t c) { charts[c].uv = in_smallest_box(charts[c].uv); });
  std::vector<Place> places;
  const double scale = Packer(charts, cells, static_cast<std::int32_t>(wanted), progress).pack(places);
  parallel_chunks(charts.size(), [&](std::size_t c) {
    charts[c].uv = in_turn(charts[c], places[c].turn, scale);
    for (Flat& p : charts[c].uv) {
      p[0] = std::round((p[0] + places[c].spot.x) / cells * steps_of_uv) / steps_of_uv;
      p[1] = std::round((p[1] + places[c].spot.y) / cells * steps_of_uv) / steps_of_uv;
    }
  });
  return scale / cells;
}

}  // namespace pelage
