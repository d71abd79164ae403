#include "unwrap/charts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "base/dense.h"
#include "base/job_progress.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "shape/edges.h"
#include "shape/vectors.h"
#include "unwrap/flatten.h"
#include "unwrap/outline.h"
#include "unwrap/overlap.h"
#include "unwrap/segment.h"

namespace pelage {

namespace {

/// The L2 stretch up to which a chart is good: that of a cap of a sphere whose rim leans by 78 degrees.
constexpr double most_stretch = 1.02;

/// Regions to begin with: caps that lean by 65 degrees.
constexpr double first_spread = 0.29;

bool always(std::int32_t) { return true; }

/// Of the hull, what a chart fills; of the side of a square of the whole area, how long it may be: else the room around
/// it is lost. The smallest ones find a place in any shape, with such a share of the whole area.
constexpr double least_fill = 0.65, most_length = 0.8, small_share = 0.004;

/// Whether a chart is all that hangs together with it, so that cutting it is nothing but another seam.
bool is_alone(const LinkedFaces& faces, const Chart& chart) {
  for (std::size_t h = 0; h < chart.twin.size(); ++h) {
    const std::int32_t other = faces.twin[3 * chart.source[h / 3] + static_cast<std::int32_t>(h % 3)];
    if (chart.twin[h] < 0 && other >= 0 && !std::ranges::binary_search(chart.source, other / 3)) return false;
  }
  return true;
}

/// With `slack` for charts that are not yet what they will be.
bool packs_well(const LinkedFaces& faces, const Chart& chart, double whole_area, double slack = 1) {
  return chart.area < small_share * whole_area || is_alone(faces, chart) ||
         (chart.area * slack >= least_fill * area_of(convex_hull(chart.uv)) &&
          flat_box(in_smallest_box(chart.uv)).width() <= slack * most_length * std::sqrt(whole_area));
}

bool lies_well(const LinkedFaces& faces, Chart& chart, const std::function<bool(const Chart&)>& promising = {}) {
  return is_disc(chart) && flatten(faces, chart, promising) && chart.stretch <= most_stretch &&
         !border_meets_itself(chart);
}

/// Charts of the regions of a chart, in the order of their first triangles.
std::vector<Chart> parts_of(const LinkedFaces& faces, const Chart& chart, const FaceGraph& graph,
                            const std::vector<std::int32_t>& region) {
  const auto count = static_cast<std::size_t>(*std::ranges::max_element(region)) + 1;
  std::vector<std::vector<std::int32_t>> sources(count);
  for (std::size_t t = 0; t < chart.source.size(); ++t)
    sources[region[graph.of_triangle[t]]].push_back(chart.source[t]);
  std::vector<Chart> parts(count);
  parallel_chunks(count, [&](std::size_t k) { parts[k] = make_chart(faces, std::move(sources[k]), always); });
  return parts;
}

/// The chart if it lies well, else its halves, and so on; a single face is laid out in any case.
/// `report` is told which part is done, in [0, 1].
std::vector<Chart> settled(const LinkedFaces& faces, Chart chart, double whole_area,
                           const std::function<void(double)>& report) {
  const auto all = static_cast<double>(chart.source.size());
  double finished = 0;
  std::vector<Chart> open, done;
  open.push_back(std::move(chart));
  while (!open.empty()) {
    Chart next = std::move(open.back());
    open.pop_back();
    const bool lies = lies_well(faces, next);
    const bool single = faces.whole[next.source.front()] == faces.whole[next.source.back()];
    if (!lies && single) embed(faces, next);
    if (single || (lies && packs_well(faces, next, whole_area))) {
      finished += static_cast<double>(next.source.size());
      report(finished / all);
      done.push_back(std::move(next));
      continue;
    }
    const FaceGraph graph = face_graph(faces, next);
    for (Chart& part : parts_of(faces, next, graph, lies ? far_halves(graph) : halves(graph)))
      open.push_back(std::move(part));
  }
  return done;
}

std::vector<Chart> first_charts(const LinkedFaces& faces) {
  std::vector<std::int32_t> all(faces.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<std::int32_t>(t);
  const Chart whole = make_chart(faces, std::move(all), always);
  const FaceGraph graph = face_graph(faces, whole);
  return parts_of(faces, whole, graph, flat_regions(graph, first_spread));
}

/// Joins neighbours while what comes out lies well.
class Merger {
 public:
  Merger(const LinkedFaces& faces, std::vector<Chart> charts)
      : faces_(faces), charts_(std::move(charts)), chart_of_(faces.triangles.size()), joined_(faces.twin.size(), 0) {
    for (std::size_t c = 0; c < charts_.size(); ++c) {
      for (const std::int32_t t : charts_[c].source) chart_of_[t] = static_cast<std::int32_t>(c);
      spreads_.push_back(spread_of(charts_[c]));
      area_ += charts_[c].area;
    }
    for (std::size_t h = 0; h < joined_.size(); ++h)
      joined_[h] = faces.twin[h] >= 0 && chart_of_[faces.twin[h] / 3] == chart_of_[h / 3];
  }

  /// False where there is nothing left to try.
  bool merge_some();
  std::vector<Chart> take() {
    std::erase_if(charts_, [](const Chart& c) { return c.source.empty(); });
    return std::move(charts_);
  }
  /// Pairs that can still be tried.
  std::size_t candidates() const { return candidates_; }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;
  struct Seam {
    double length = 0;
    std::vector<HalfEdge> edges;  ///< of the first chart
  };
  struct Candidate {
    Pair pair;
    double worth = 0;
    std::vector<HalfEdge> arc;
  };
  /// Sums over normals, from which follows how far they are from lying in a plane.
  struct Spread {
    double area = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  };

  Spread spread_of(const Chart& chart) const;
  bool may_be_flat(const Pair& pair) const;
  std::map<Pair, Seam> seams(std::vector<double>& border) const;
  std::vector<HalfEdge> longest_arc(const Seam& seam) const;
  HalfEdge next_on_border(HalfEdge h) const;
  std::vector<Candidate> matching();
  Chart merged(const Candidate& candidate) const;
  void accept(const Candidate& candidate, Chart chart);
  double length_of(HalfEdge h) const {
    return length(difference(faces_.points[tail(faces_.triangles, h)], faces_.points[tip(faces_.triangles, h)]));
  }

  const LinkedFaces& faces_;
  std::vector<Chart> charts_;  ///< emptied where they have become part of another
  std::vector<Spread> spreads_;
  std::vector<std::int32_t> chart_of_;
  std::vector<char> joined_;  ///< per half-edge
  std::set<Pair> refused_;
  double area_ = 0;  ///< of all
  std::size_t candidates_ = 0;
};

Merger::Spread Merger::spread_of(const Chart& chart) const {
  Spread spread;
  for (const std::int32_t t : chart.source) {
    const Triangle& v = faces_.triangles[t];
    const Point n = cross(difference(faces_.points[v[1]], faces_.points[v[0]]),
                          difference(faces_.points[v[2]], faces_.points[v[0]]));
    const double area = length(n) / 2;
    if (!(area > 0)) continue;
    const Eigen::Vector3d normal = Eigen::Vector3d(n.data()) / (2 * area);
    spread.area += area;
    spread.sum += area * normal;
    spread.squares += area * normal * normal.transpose();
  }
  return spread;
}

/// The variance of normals in the direction in which they differ least: 0 on cylinders and cones, (1 - cos w)^2 / 12 on
/// caps whose rim leans by w.
constexpr double most_variance = 0.06;

bool Merger::may_be_flat(const Pair& pair) const {
  const Spread &a = spreads_[pair.first], &b = spreads_[pair.second];
  const double area = a.area + b.area;
  if (!(area > 0)) return true;
  const Eigen::Vector3d mean = (a.sum + b.sum) / area;
  return symmetric_modes((a.squares + b.squares) / area - mean * mean.transpose()).values[0] < most_variance;
}

std::map<Merger::Pair, Merger::Seam> Merger::seams(std::vector<double>& border) const {
  border.assign(charts_.size(), 0);
  std::map<Pair, Seam> seams;
  for (HalfEdge h = 0; h < std::ssize(joined_); ++h) {
    if (joined_[h]) continue;
    const std::int32_t chart = chart_of_[h / 3], other = faces_.twin[h] < 0 ? -1 : chart_of_[faces_.twin[h] / 3];
    const double l = length_of(h);
    border[chart] += l;
    if (other <= chart) continue;
    Seam& seam = seams[{chart, other}];
    seam.length += l;
    seam.edges.push_back(h);
  }
  return seams;
}

HalfEdge Merger::next_on_border(HalfEdge h) const {
  HalfEdge n = next_in_face(h);
  while (joined_[n]) n = next_in_face(faces_.twin[n]);
  return n;
}

/// Along one arc two discs make a disc. The last edge of a seam that goes all around is left out.
std::vector<HalfEdge> Merger::longest_arc(const Seam& seam) const {
  std::set<HalfEdge> open(seam.edges.begin(), seam.edges.end());
  const auto follows = [&](HalfEdge h, HalfEdge next) {
    return open.contains(next) && next_on_border(faces_.twin[next]) == faces_.twin[h];
  };
  std::map<HalfEdge, HalfEdge> after;
  std::set<HalfEdge> has_before;
  for (const HalfEdge h : seam.edges)
    if (const HalfEdge next = next_on_border(h); next != h && follows(h, next)) {
      after[h] = next;
      has_before.insert(next);
    }
  if (after.size() == seam.edges.size()) {  // all around
    has_before.erase(after.at(seam.edges.front()));
    after.erase(seam.edges.front());
  }
  std::vector<HalfEdge> best;
  double longest = 0;
  for (const HalfEdge first : seam.edges) {
    if (has_before.contains(first)) continue;
    std::vector<HalfEdge> arc{first};
    for (auto next = after.find(first); next != after.end(); next = after.find(arc.back())) arc.push_back(next->second);
    double l = 0;
    for (const HalfEdge h : arc) l += length_of(h);
    if (l <= longest) continue;
    longest = l;
    best = std::move(arc);
  }
  std::ranges::sort(best);
  return best;
}

/// Pairs that share no chart, those first whose seam is most of a border.
std::vector<Merger::Candidate> Merger::matching() {
  std::vector<double> border;
  const std::map<Pair, Seam> all = seams(border);
  std::vector<Candidate> candidates;
  for (const auto& [pair, seam] : all) {
    if (refused_.contains(pair) || !may_be_flat(pair)) continue;
    candidates.push_back({pair, seam.length / std::min(border[pair.first], border[pair.second]), {}});
  }
  candidates_ = candidates.size();
  std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) { return a.worth > b.worth; });
  std::set<std::int32_t> used;
  std::erase_if(candidates, [&](const Candidate& c) {
    if (used.contains(c.pair.first) || used.contains(c.pair.second)) return true;
    used.insert(c.pair.first);
    used.insert(c.pair.second);
    return false;
  });
  for (Candidate& c : candidates) c.arc = longest_arc(all.at(c.pair));
  return candidates;
}

Chart Merger::merged(const Candidate& candidate) const {
  std::vector<std::int32_t> source;
  std::ranges::merge(charts_[candidate.pair.first].source, charts_[candidate.pair.second].source,
                     std::back_inserter(source));
  return make_chart(faces_, std::move(source), [&](HalfEdge h) {
    return joined_[h] || std::ranges::binary_search(candidate.arc, h) ||
           std::ranges::binary_search(candidate.arc, faces_.twin[h]);
  });
}

void Merger::accept(const Candidate& candidate, Chart chart) {
  const std::int32_t kept = candidate.pair.first, gone = candidate.pair.second;
  for (const HalfEdge h : candidate.arc) joined_[h] = joined_[faces_.twin[h]] = 1;
  for (const std::int32_t t : chart.source) chart_of_[t] = kept;
  charts_[kept] = std::move(chart);
  charts_[gone] = {};
  spreads_[kept] = spread_of(charts_[kept]);
  std::erase_if(refused_, [&](const Pair& p) { return p.first == kept || p.second == kept; });
}

bool Merger::merge_some() {
  const std::vector<Candidate> tried = matching();
  std::vector<std::optional<Chart>> result(tried.size());
  // A conformal map stretches more than what becomes of it: a cap as above by 1.1.
  const auto promising = [&](const Chart& chart) {
    return chart.stretch < 1.2 && packs_well(faces_, chart, area_, 1.1);
  };
  parallel_chunks(tried.size(), [&](std::size_t k) {
    if (tried[k].arc.empty()) return;
    Chart chart = merged(tried[k]);
    if (lies_well(faces_, chart, promising) && packs_well(faces_, chart, area_)) result[k] = std::move(chart);
  });
  for (std::size_t k = 0; k < tried.size(); ++k) {
    if (result[k])
      accept(tried[k], std::move(*result[k]));
    else
      refused_.insert(tried[k].pair);
  }
  return !tried.empty();
}

void report(const Progress& progress, std::string_view what, double fraction) {
  if (progress && !progress(what, fraction)) throw Error(Fault::cancelled, "interrupted");
}

}  // namespace

std::vector<Chart> make_charts(const LinkedFaces& faces, const Progress& progress) {
  report(progress, "finding charts", 0);
  std::vector<Chart> first = first_charts(faces);
  std::vector<std::vector<Chart>> parts(first.size());
  double area = 0;
  for (const Chart& c : first) area += c.area;
  JobProgress jobs(progress, "flattening", first.size());
  parallel_chunks(first.size(), [&](std::size_t k) {
    parts[k] = settled(faces, std::move(first[k]), area, [&](double fraction) {
      if (!jobs.report(k, fraction)) throw Error(Fault::cancelled, "interrupted");
    });
  });
  std::vector<Chart> charts;
  for (std::vector<Chart>& p : parts) std::ranges::move(p, std::back_inserter(charts));
  Merger merger(faces, std::move(charts));
  for (std::size_t most = 0; merger.merge_some();) {
    most = std::max(most, merger.candidates());
    report(progress, "joining charts", 1 - static_cast<double>(merger.candidates()) / static_cast<double>(most));
  }
  return merger.take();
}

}  // namespace pelage
