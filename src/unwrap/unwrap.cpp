#include "pelage/unwrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/number.h"
#include "pelage/error.h"
#include "unwrap/charts.h"
#include "unwrap/pack.h"
#include "unwrap/stretch.h"

namespace pelage {

namespace {

void check(const UnwrapOptions& options) {
  if (options.resolution < 16 || options.resolution > 65536)
    throw Error(Fault::usage, "a resolution of " + std::to_string(options.resolution) + " is not between 16 and 65536");
  if (!(options.margin >= 0)) throw Error(Fault::usage, "a margin of " + number(options.margin) + " is not 0 or more");
}

UnwrapReport measured(const LinkedFaces& faces, const std::vector<Chart>& charts) {
  UnwrapReport report;
  StretchSum sum;
  for (const Chart& c : charts) {
    sum += stretch_of(faces, c);
    report.worst_stretch = std::max(report.worst_stretch, c.stretch);
  }
  report.charts = charts.size();
  report.stretch = sum.stretch();
  return report;
}

double doubled_area(const Chart& chart, const Triangle& t) {
  const Flat &a = chart.uv[t[0]], &b = chart.uv[t[1]], &c = chart.uv[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);  // exact for multiples of 2^-24
}

double covered(const std::vector<Chart>& charts) {
  double area = 0;
  for (const Chart& c : charts)
    for (const Triangle& t : c.triangles) area += doubled_area(c, t) / 2;
  return area;
}

/// Triangles that are too small for the steps of uv.
void note_lost(const LinkedFaces& faces, const std::vector<Chart>& charts, std::vector<Finding>& findings) {
  Finding lost{"too-fine", "", 0, 0, false};
  for (const Chart& c : charts)
    for (std::size_t t = 0; t < c.triangles.size(); ++t)
      if (!(doubled_area(c, c.triangles[t]) > 0) && lost.count++ == 0)
        lost.element = static_cast<std::size_t>(faces.face[c.source[t]]);
  if (lost.count == 0) return;
  lost.text = counted(lost.count, "triangle") + " (first: of face " + std::to_string(lost.element) +
              ") too small for an atlas of the whole mesh; no texel shows them";
  findings.push_back(lost);
}

/// The values of all corners of the file; those of left out triangles get what another corner at their place has, of
/// their own face if there is one.
class CornerValues {
 public:
  CornerValues(const PolygonMesh& mesh, const LinkedFaces& faces)
      : mesh_(mesh), faces_(faces), values_(2 * mesh.corners.size(), std::numeric_limits<double>::quiet_NaN()) {}

  void set(const Chart& chart) {
    for (std::size_t t = 0; t < chart.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        put(faces_.corner[3 * chart.source[t] + static_cast<std::int32_t>(k)], chart.uv[chart.triangles[t][k]]);
  }
  std::vector<double> complete() {
    std::map<std::int32_t, Flat> anywhere;
    for (std::size_t c = 0; c < mesh_.corners.size(); ++c)
      if (known(c)) anywhere.try_emplace(place(c), value(c));
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) complete_face(f, anywhere);
    return std::move(values_);
  }

 private:
  bool known(std::size_t c) const { return !std::isnan(values_[2 * c]); }
  Flat value(std::size_t c) const { return {values_[2 * c], values_[2 * c + 1]}; }
  std::int32_t place(std::size_t c) const { return faces_.place[mesh_.corners[c]]; }
  void put(std::size_t c, const Flat& uv) {
    values_[2 * c] = uv[0];
    values_[2 * c + 1] = uv[1];
  }
  void complete_face(std::size_t f, const std::map<std::int32_t, Flat>& anywhere) {
    const std::size_t begin = mesh_.face_begin(f), end = mesh_.face_ends[f];
    for (std::size_t c = begin; c < end; ++c) {
      if (known(c)) continue;
      std::size_t own = begin;
      while (own < end && (!known(own) || place(own) != place(c))) ++own;
      const auto other = anywhere.find(place(c));
      put(c, own < end ? value(own) : other != anywhere.end() ? other->second : Flat{0, 0});
    }
  }

  const PolygonMesh& mesh_;
  const LinkedFaces& faces_;
  std::vector<double> values_;
};

}  // namespace

Unwrapped unwrap(const PolygonMesh& mesh, const UnwrapOptions& options, const Progress& progress) {
  check(options);
  Unwrapped result;
  const LinkedFaces faces = link_faces(mesh, result.findings);
  std::vector<Chart> charts = make_charts(faces, progress);
  result.report = measured(faces, charts);
  result.report.scale = pack(charts, options.resolution, options.margin, progress) * faces.scale;
  result.report.efficiency = covered(charts);
  note_lost(faces, charts, result.findings);
  CornerValues values(mesh, faces);
  result.chart.assign(mesh.face_count(), -1);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    values.set(charts[c]);
    for (const std::int32_t t : charts[c].source) result.chart[faces.face[t]] = static_cast<std::int32_t>(c);
  }
  result.uv = {"uv", 2, Domain::corner, values.complete()};
  return result;
}

UnwrapOptions atlas_options(int size) { return {size, std::clamp(size / 512.0, 1.0, UnwrapOptions{}.margin)}; }

}  // namespace pelage
