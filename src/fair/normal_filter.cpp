#include "fair/normal_filter.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/quantile.h"

namespace pelage {

namespace {

/// Radius of a neighbourhood in distances between centroids, as in the original; twice the width of the Gaussian.
constexpr double disc_radius = 2;
/// The guidance weighs the patches with this power of 1 / roughness: 0 is a plain mean, infinity the original choice.
constexpr double selectivity = 1.5;
/// Range of the normals in medians of the guidance's differences across edges, and its limits.
constexpr double range_factor = 4, smallest_range = 0.15, largest_range = 0.6;
/// Share of the zeroth moment that is added to the second ones: one-sided neighbourhoods at sharp edges then do not
/// extrapolate.
constexpr double ridge = 0.3;
/// Roughness that does not count, so that exactly flat patches can be weighed.
constexpr double rounding = 1e-9;
constexpr std::size_t chunk = 256;  // faces

template <class Body>
void for_each_face(std::size_t count, Body&& body) {
  parallel_for(
      count,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) body(f);
      },
      chunk);
}

double largest_difference(std::span<const Index> patch, const std::vector<Vector3>& normal) {
  double square = 0;
  for (std::size_t a = 0; a < patch.size(); ++a)
    for (std::size_t b = a + 1; b < patch.size(); ++b)
      square = std::max(square, (normal[patch[a]] - normal[patch[b]]).squaredNorm());
  return std::sqrt(square);
}

/// The share of the sharpest inner edge in the sum over all inner edges of a patch: near 1 if one edge divides it.
double dominance(const Topology& topology, std::span<const Index> patch, const std::vector<Vector3>& normal) {
  double sum = 0, largest = 0;
  for (Index f : patch)
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index other = topology.twin[h] / 3;
      if (topology.twin[h] < h || !std::binary_search(patch.begin(), patch.end(), other)) continue;
      const double difference = (normal[f] - normal[other]).norm();
      sum += difference;
      largest = std::max(largest, difference);
    }
  return largest / (rounding + sum);
}

}  // namespace

NormalFilter::NormalFilter(const Topology& topology, const std::vector<Point>& points) : topology_(topology) {
  const FaceGeometry faces = face_geometry(topology.triangles, points);
  neighbour_ = neighbours(topology, faces_of_vertices(topology));
  spacing_ = centroid_spacing(topology, neighbour_, faces.centroid, 3);
  std::vector<double> radius = spacing_;
  for (double& r : radius) r *= disc_radius;
  disc_ = discs(neighbour_, faces.centroid, radius);
}

void NormalFilter::rate_patches(const FaceGeometry& faces) {
  roughness_.resize(faces.normal.size());
  patch_normal_.resize(faces.normal.size());
  for_each_face(faces.normal.size(), [&](std::size_t f) {
    const auto patch = neighbour_[f];
    roughness_[f] = largest_difference(patch, faces.normal) * dominance(topology_, patch, faces.normal);
    Vector3 sum = Vector3::Zero();
    for (Index g : patch) sum += faces.area[g] * faces.normal[g];
    patch_normal_[f] = sum.normalized();
  });
}

void NormalFilter::make_guidance() {
  guidance_.resize(patch_normal_.size());
  for_each_face(guidance_.size(), [&](std::size_t f) {
    double smoothest = roughness_[f];
    for (Index g : neighbour_[f]) smoothest = std::min(smoothest, roughness_[g]);
    Vector3 sum = Vector3::Zero();
    for (Index g : neighbour_[f])
      sum += std::pow((smoothest + rounding) / (roughness_[g] + rounding), selectivity) * patch_normal_[g];
    guidance_[f] = sum.normalized();
  });
}

double NormalFilter::guidance_range() const {
  std::vector<double> difference;
  for (Index h = 0; h < static_cast<Index>(topology_.twin.size()); ++h)
    if (topology_.twin[h] > h) difference.push_back((guidance_[h / 3] - guidance_[topology_.twin[h] / 3]).norm());
  if (difference.empty()) return largest_range;
  return std::clamp(range_factor * quantile(difference, 0.5), smallest_range, largest_range);
}

/// The value at the face of the linear function through the weighted normals around it.
Vector3 NormalFilter::fit(const FaceGeometry& faces, std::size_t f) const {
  const double width = disc_radius * spacing_[f] / 2;
  if (!(width > 0)) return faces.normal[f];
  const Vector3 x = guidance_[f].unitOrthogonal(), y = guidance_[f].cross(x);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero(), sums = Eigen::Matrix3d::Zero();
  for (Index g : disc_[f]) {
    const Vector3 d = (faces.centroid[g] - faces.centroid[f]) / width;
    const double range = (guidance_[g] - guidance_[f]).squaredNorm() / (range_ * range_);
    const double weight = faces.area[g] * std::exp(-(d.squaredNorm() + range) / 2);
    const Vector3 basis(1, d.dot(x), d.dot(y));
    moments += weight * basis * basis.transpose();
    sums += weight * basis * faces.normal[g].transpose();
  }
  const double total = moments(0, 0);
  if (!(total > 0)) return faces.normal[f];
  moments(1, 1) += ridge * total;
  moments(2, 2) += ridge * total;
  const Vector3 value = (moments.inverse() * sums).row(0).transpose();
  return value.norm() > 0 ? value.normalized().eval() : faces.normal[f];
}

std::vector<Vector3> NormalFilter::filter(const FaceGeometry& faces) {
  rate_patches(faces);
  make_guidance();
  range_ = guidance_range();
  std::vector<Vector3> filtered(faces.normal.size());
  for_each_face(filtered.size(), [&](std::size_t f) { filtered[f] = fit(faces, f); });
  return filtered;
}

}  // namespace pelage
