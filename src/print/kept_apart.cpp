#include "print/kept_apart.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "print/self_meeting.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr int most_rounds = 12;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Point normal(const Triangle& t, const std::vector<Point>& points) {
  return cross(difference(points[at(t[1])], points[at(t[0])]), difference(points[at(t[2])], points[at(t[0])]));
}

class SharesApart {
 public:
  SharesApart(const std::vector<Triangle>& triangles, const Departure& departure, const std::vector<char>& given)
      : triangles_(triangles), departure_(departure), given_(given), share_(departure.from.size(), 1.0) {
    for (const Point& way : departure.way) longest_ = std::max(longest_, length(way));
    for (const Triangle& t : triangles) before_.push_back(normal(t, departure.from));
    find_neighbours();
  }

  std::vector<double> find() {
    std::vector<char> asked(triangles_.size(), 1);
    for (int round = 0; round < most_rounds && longest_ > 0; ++round) {
      const std::vector<std::int32_t> stuck = find_stuck(asked);
      if (stuck.empty()) break;
      const std::vector<double> earlier = share_;
      halve_at(stuck);
      spread();
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        asked[t] = std::ranges::any_of(triangles_[t], [&](auto v) { return share_[at(v)] != earlier[at(v)]; });
    }
    return std::move(share_);
  }

 private:
  void find_neighbours() {
    first_.assign(share_.size() + 1, 0);
    for (const Triangle& t : triangles_)
      for (const std::int32_t v : t) first_[at(v) + 1] += 2;
    for (std::size_t v = 0; v < share_.size(); ++v) first_[v + 1] += first_[v];
    neighbour_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t other : {1, 2}) neighbour_[next[at(t[k])]++] = t[(k + other) % 3];
  }

  /// Triangles that meet others or have turned over.
  std::vector<std::int32_t> find_stuck(const std::vector<char>& asked) const {
    const std::vector<Point> now = moved(departure_, share_);
    std::vector<std::int32_t> stuck;
    for (const Meeting& m : self_meetings(triangles_, now, asked))
      if (!given_[at(m.first)] || !given_[at(m.second)]) stuck.insert(stuck.end(), {m.first, m.second});
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (asked[t] && !given_[t] && turned_over(t, now)) stuck.push_back(static_cast<std::int32_t>(t));
    return stuck;
  }

  /// Its normal, or an edge: behind both centres of curvature the normal is what it was.
  bool turned_over(std::size_t t, const std::vector<Point>& now) const {
    if (dot(normal(triangles_[t], now), before_[t]) < 0) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = at(triangles_[t][k]), b = at(triangles_[t][(k + 1) % 3]);
      if (dot(difference(now[b], now[a]), difference(departure_.from[b], departure_.from[a])) < 0) return true;
    }
    return false;
  }

  void halve_at(const std::vector<std::int32_t>& stuck) {
    std::vector<char> once(share_.size(), 0);
    for (const std::int32_t t : stuck)
      for (const std::int32_t v : triangles_[at(t)])
        if (!std::exchange(once[at(v)], 1) && length(departure_.way[at(v)]) > 0) share_[at(v)] /= 2;
  }

  /// No share is larger than that of a neighbour and the distance from it.
  void spread() {
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::size_t v = 0; v < share_.size(); ++v)
      if (share_[v] < 1) open.emplace(share_[v], static_cast<std::int32_t>(v));
    while (!open.empty()) {
      const auto [share, v] = open.top();
      open.pop();
      if (share > share_[at(v)]) continue;
      for (std::size_t k = first_[at(v)]; k < first_[at(v) + 1]; ++k) {
        const std::int32_t w = neighbour_[k];
        const double limit = share + length(difference(departure_.from[at(w)], departure_.from[at(v)])) / longest_;
        if (limit >= share_[at(w)] || !(length(departure_.way[at(w)]) > 0)) continue;
        share_[at(w)] = limit;
        open.emplace(limit, w);
      }
    }
  }

  const std::vector<Triangle>& triangles_;
  const Departure& departure_;
  const std::vector<char>& given_;
  std::vector<double> share_;
  double longest_ = 0;         ///< way
  std::vector<Point> before_;  ///< normals
  std::vector<std::size_t> first_;
  std::vector<std::int32_t> neighbour_;  ///< of vertex after vertex, some of them twice
};

}  // namespace

std::vector<Point> moved(const Departure& departure, const std::vector<double>& share) {
  std::vector<Point> points = departure.from;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d) points[v][d] += share[v] * departure.way[v][d];
  return points;
}

std::vector<double> shares_apart(const std::vector<Triangle>& triangles, const Departure& departure,
                                 const std::vector<char>& given) {
  return SharesApart(triangles, departure, given).find();
}

}  // namespace pelage
