// What a grown mesh shows: how many spots, how far apart, and how far from a reference on the same surface.
//   measure grown.ply --species v,u --against reference.ply

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "linear_elements.h"
#include "pelage/io.h"
#include "shape/vectors.h"

namespace plain {
namespace {

using pelage::Point;
using pelage::TriangleMesh;
using Json = nlohmann::ordered_json;

/// PLY files of Pelage call a species u_ where u would be a texture coordinate.
const std::vector<double>& field(const TriangleMesh& mesh, const std::string& species) {
  for (const std::string& name : {species, species + "_"})
    if (const pelage::Attribute* a = mesh.find(name)) return a->values;
  throw std::runtime_error("the mesh has no field " + species);
}

double mean(const Elements& e, const std::vector<double>& u) {
  double sum = 0, area = 0;
  for (int i = 0; i < e.size(); ++i) {
    sum += e.mass[i] * u[i];
    area += e.mass[i];
  }
  return sum / area;
}

/// 2 pi / k with k^2 the Rayleigh quotient of the deviation from the mean, over the mean of lumped and consistent mass:
/// on even triangles its error is of fourth order in the edge.
double wavelength(const TriangleMesh& mesh, const Elements& e, const std::vector<double>& u) {
  const double middle = mean(e, u);
  double energy = 0, lumped = 0, consistent = 0;
  for (int i = 0; i < e.size(); ++i) {
    lumped += e.mass[i] * (u[i] - middle) * (u[i] - middle);
    for (int s = e.begin[i]; s < e.begin[i + 1]; ++s) energy += u[i] * e.stiffness[s] * u[e.column[s]];
  }
  for (const pelage::Triangle& t : mesh.triangles) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double area = pelage::length(pelage::cross(pelage::difference(b, a), pelage::difference(c, a))) / 2;
    double sum = 0, squares = 0;
    for (const int v : t) {
      sum += u[v] - middle;
      squares += (u[v] - middle) * (u[v] - middle);
    }
    consistent += area / 12 * (sum * sum + squares);
  }
  return 2 * std::numbers::pi * std::sqrt((lumped + consistent) / 2 / energy);
}

/// Connected regions beyond the middle of the range: of the rarer side, which is that of the spots.
int spots(const Elements& e, const std::vector<double>& u) {
  const auto [low, high] = std::ranges::minmax(u);
  const double middle = (low + high) / 2;
  const bool above = mean(e, u) < middle;
  std::vector<char> left(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) left[i] = (u[i] > middle) == above;
  int count = 0;
  std::vector<int> region;
  for (int first = 0; first < e.size(); ++first) {
    if (!std::exchange(left[first], 0)) continue;
    ++count;
    region = {first};
    while (!region.empty()) {
      const int v = region.back();
      region.pop_back();
      for (int s = e.begin[v]; s < e.begin[v + 1]; ++s)
        if (std::exchange(left[e.column[s]], 0)) region.push_back(e.column[s]);
    }
  }
  return count;
}

/// A field on a fine mesh, at any place near it.
class Reference {
 public:
  explicit Reference(const TriangleMesh& mesh) : mesh_(mesh), triangles_at_(mesh.points.size()) {
    double edges = 0;
    for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
      const pelage::Triangle& t = mesh.triangles[f];
      for (const int v : t) triangles_at_[v].push_back(f);
      edges += pelage::length(pelage::difference(mesh.points[t[1]], mesh.points[t[0]]));
    }
    cell_ = 1.5 * edges / static_cast<double>(mesh.triangles.size());
    for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) cells_[key(mesh.points[v], {0, 0, 0})].push_back(v);
  }

  struct Place {
    std::array<int, 3> vertex;
    std::array<double, 3> weight;
  };
  /// The triangle at the nearest vertex that holds the point best.
  Place find(const Point& p) const {
    Place best{};
    double least = -1e300;
    for (const int f : triangles_at_[nearest(p)]) {
      const pelage::Triangle& t = mesh_.triangles[f];
      const std::array<double, 3> w = barycentric(p, t);
      if (const double smallest = std::min({w[0], w[1], w[2]}); smallest > least) {
        least = smallest;
        best = {t, w};
      }
    }
    return best;
  }

  /// Gradients of a field at the vertices: those of the triangles around, weighted by area.
  std::vector<Point> gradients(const std::vector<double>& u) const {
    std::vector<Point> sum(u.size(), Point{});
    std::vector<double> areas(u.size(), 0);
    for (const pelage::Triangle& t : mesh_.triangles) {
      const Point n = normal(t);
      const double twice_area = pelage::length(n);
      for (int k = 0; k < 3; ++k) {
        const Point across =
            pelage::cross(n, pelage::difference(mesh_.points[t[(k + 2) % 3]], mesh_.points[t[(k + 1) % 3]]));
        for (const int v : t)
          for (int d = 0; d < 3; ++d) sum[v][d] += u[t[k]] * across[d] / twice_area;
        areas[t[k]] += twice_area;
      }
    }
    for (std::size_t v = 0; v < sum.size(); ++v)
      for (double& component : sum[v]) component /= areas[v];
    return sum;
  }

  /// Half of every corner's tangent plane beside its value: exact for quadratic fields.
  double value(const Place& place, const Point& p, const std::vector<double>& u,
               const std::vector<Point>& gradient) const {
    double value = 0;
    for (int k = 0; k < 3; ++k) {
      const int v = place.vertex[k];
      const Point away = pelage::difference(p, mesh_.points[v]);
      value += place.weight[k] * (u[v] + pelage::dot(gradient[v], away) / 2);
    }
    return value;
  }

 private:
  using Key = std::array<int, 3>;
  Key key(const Point& p, const Key& shift) const {
    Key k;
    for (int d = 0; d < 3; ++d) k[d] = static_cast<int>(std::floor(p[d] / cell_)) + shift[d];
    return k;
  }
  int nearest(const Point& p) const {
    int best = -1;
    double least = 1e300;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto cell = cells_.find(key(p, {x, y, z}));
          if (cell == cells_.end()) continue;
          for (const int v : cell->second)
            if (const double far = pelage::length(pelage::difference(p, mesh_.points[v])); far < least) {
              least = far;
              best = v;
            }
        }
    if (best < 0) throw std::runtime_error("the mesh and the reference lie on different surfaces");
    return best;
  }
  Point normal(const pelage::Triangle& t) const {
    const Point &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    return pelage::cross(pelage::difference(b, a), pelage::difference(c, a));
  }
  std::array<double, 3> barycentric(const Point& p, const pelage::Triangle& t) const {
    const Point n = normal(t);
    std::array<double, 3> w;
    for (int k = 0; k < 3; ++k) {
      const Point &a = mesh_.points[t[(k + 1) % 3]], &b = mesh_.points[t[(k + 2) % 3]];
      w[k] = pelage::dot(n, pelage::cross(pelage::difference(b, a), pelage::difference(p, a))) / pelage::dot(n, n);
    }
    return w;
  }

  const TriangleMesh& mesh_;
  std::vector<std::vector<int>> triangles_at_;
  std::map<Key, std::vector<int>> cells_;
  double cell_ = 0;
};

/// Of the species that is worst: the L2 norm of the difference over that of the reference's deviation from its mean,
/// both over the vertices of the mesh.
double error(const TriangleMesh& mesh, const Elements& e, const TriangleMesh& fine,
             const std::vector<std::string>& species) {
  const Reference reference(fine);
  std::vector<Reference::Place> places;
  for (const Point& p : mesh.points) places.push_back(reference.find(p));
  double worst = 0;
  for (const std::string& name : species) {
    const std::vector<double>&u = field(mesh, name), &r = field(fine, name);
    const std::vector<Point> gradients = reference.gradients(r);
    std::vector<double> at(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) at[i] = reference.value(places[i], mesh.points[i], r, gradients);
    const double middle = mean(e, at);
    double off = 0, deviation = 0;
    for (int i = 0; i < e.size(); ++i) {
      off += e.mass[i] * (u[i] - at[i]) * (u[i] - at[i]);
      deviation += e.mass[i] * (at[i] - middle) * (at[i] - middle);
    }
    worst = std::max(worst, std::sqrt(off / deviation));
  }
  return worst;
}

Json measure(const std::string& path, const std::vector<std::string>& species, const std::string& against) {
  const TriangleMesh mesh = pelage::load_shape(path);
  const Elements e = assemble(mesh);
  Json json{{"vertices", mesh.points.size()},
            {"spots", spots(e, field(mesh, species.back()))},
            {"wavelength", wavelength(mesh, e, field(mesh, species.front()))}};
  if (!against.empty()) json["error"] = error(mesh, e, pelage::load_shape(against), species);
  return json;
}

}  // namespace
}  // namespace plain

int main(int argc, char** argv) {
  CLI::App app("Says what a grown mesh shows as JSON: spots, wavelength [units of the file], error.");
  std::string mesh, against;
  std::vector<std::string> species;
  app.add_option("mesh", mesh)->required();
  app.add_option("--species", species, "Of the first the wavelength, of the last the spots, of all the error")
      ->required()
      ->delimiter(',');
  app.add_option("--against", against, "A reference on the same surface, finer");
  CLI11_PARSE(app, argc, argv);
  try {
    std::cout << plain::measure(mesh, species, against).dump(2) << '\n';
  } catch (const std::exception& e) {
    std::cerr << "measure: error: " << e.what() << '\n';
    return 1;
  }
}
