#include "shape/tet_places.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/box.h"
#include "base/parallel.h"
#include "shape/locate.h"
#include "shape/soup_edges.h"
#include "shape/tet_mesh.h"
#include "shape/tet_quality.h"

namespace pelage {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Cubes of space with the tetrahedra that reach into them.
class TetBins {
 public:
  explicit TetBins(const TetMesh& volume) : volume_(volume), box_(box_of(volume.points)) {
    lay_out();
    first_.assign(at(count_[0] * count_[1] * count_[2]) + 1, 0);
    for_all([&](std::size_t bin, std::int32_t) { ++first_[bin + 1]; });
    for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
    tet_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_all([&](std::size_t bin, std::int32_t t) { tet_[next[bin]++] = t; });
  }

  std::optional<TetPlace> find(const Point& p) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (!(p[d] >= box_.low[d] && p[d] <= box_.high[d])) return {};
    const std::size_t bin = bin_of({along(p, 0), along(p, 1), along(p, 2)});
    for (std::size_t k = first_[bin]; k < first_[bin + 1]; ++k)
      if (const auto place = place_in(at(tet_[k]), p)) return place;
    return {};
  }

 private:
  /// As many bins as tetrahedra, about.
  void lay_out() {
    const double diagonal = box_.diagonal();
    double space = 1;
    for (std::size_t d = 0; d < 3; ++d) space *= std::max(box_.high[d] - box_.low[d], 1e-3 * diagonal);
    size_ = std::cbrt(space / static_cast<double>(volume_.tets.size()));
    for (std::size_t d = 0; d < 3; ++d) count_[d] = 1 + static_cast<std::int64_t>((box_.high[d] - box_.low[d]) / size_);
  }
  std::int64_t along(const Point& p, std::size_t d) const {
    return std::clamp(static_cast<std::int64_t>((p[d] - box_.low[d]) / size_), std::int64_t{0}, count_[d] - 1);
  }
  std::size_t bin_of(const std::array<std::int64_t, 3>& i) const {
    return at(i[0] + count_[0] * (i[1] + count_[1] * i[2]));
  }
  const Point& corner(std::size_t t, std::size_t c) const { return volume_.points[at(volume_.tets[t][c])]; }

  template <class Visit>
  void for_all(const Visit& visit) const {
    for (std::size_t t = 0; t < volume_.tets.size(); ++t) {
      Point low = corner(t, 0), high = low;
      for (std::size_t c = 1; c < 4; ++c)
        for (std::size_t d = 0; d < 3; ++d) {
          low[d] = std::min(low[d], corner(t, c)[d]);
          high[d] = std::max(high[d], corner(t, c)[d]);
        }
      for (std::int64_t k = along(low, 2); k <= along(high, 2); ++k)
        for (std::int64_t j = along(low, 1); j <= along(high, 1); ++j)
          for (std::int64_t i = along(low, 0); i <= along(high, 0); ++i)
            visit(bin_of({i, j, k}), static_cast<std::int32_t>(t));
    }
  }

  std::optional<TetPlace> place_in(std::size_t t, const Point& p) const {
    const auto shares = shares_in({corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)}, p);
    constexpr double slack = 1e-9;
    if (std::ranges::any_of(shares, [](double s) { return !(s >= -slack); })) return {};
    return TetPlace{volume_.tets[t], shares};
  }

  const TetMesh& volume_;
  Box box_;
  double size_ = 1;
  std::array<std::int64_t, 3> count_{};
  std::vector<std::size_t> first_;  ///< per bin + 1
  std::vector<std::int32_t> tet_;
};

TetPlace on_skin(const TriangleMesh& skin, const SurfaceWalk& walk, const Point& p) {
  const MeshPlace place = walk.search({p[0], p[1], p[2]}, Eigen::Vector3d::Zero());
  const Triangle& t = skin.triangles[at(place.face)];
  return {{t[0], t[1], t[2], t[0]}, {1 - place.v - place.w, place.v, place.w, 0}};
}

}  // namespace

std::vector<TetPlace> places_in(const TetMesh& volume, const std::vector<Point>& places) {
  const TetBins bins(volume);
  const TriangleMesh skin = mesh_of(volume);
  const SurfaceWalk walk(soup_topology(skin.points.size(), skin.triangles), skin.points);
  std::vector<TetPlace> result(places.size());
  parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto inside = bins.find(places[v]);
      result[v] = inside ? *inside : on_skin(skin, walk, places[v]);
    }
  });
  return result;
}

}  // namespace pelage
