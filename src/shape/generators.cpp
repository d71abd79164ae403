#include "shape/generators.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/suggest.h"
#include "pelage/error.h"
#include "shape/animal.h"

namespace pelage {

namespace {

using Vec = Eigen::Vector3d;
using std::numbers::pi;

constexpr std::string_view prefix = "builtin:";
constexpr int default_count = 10000;
constexpr int smallest_count = 100;     // below this a knot or an animal is no longer one
constexpr int largest_count = 4000000;  // about 1 GB in the course of meshing

Point to_point(const Vec& v) { return {v.x(), v.y(), v.z()}; }

/// The whole number nearest to sqrt(x).
int root(double x) { return static_cast<int>(std::lround(std::sqrt(x))); }

// --- grids ------------------------------------------------------------------------------------------------

/// Vertices of a triangular lattice on one face: (i, j) with 0 <= i, 0 <= j, i + j <= m, by rows of j.
int lattice_index(int m, int i, int j) { return j * (m + 1) - j * (j - 1) / 2 + i; }

/// Unites vertices at the same place, in the order of their first appearance.
void weld(TriangleMesh& mesh) {
  constexpr double cell = 1e-9;  // shapes are of size 1: rounding is far below, edges are far above
  std::vector<std::pair<std::array<std::int64_t, 3>, std::int32_t>> keys;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    std::array<std::int64_t, 3> key;
    for (int d = 0; d < 3; ++d) key[d] = std::llround(mesh.points[v][d] / cell);
    keys.emplace_back(key, static_cast<std::int32_t>(v));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> first(keys.size()), number(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    first[keys[i].second] = i > 0 && keys[i].first == keys[i - 1].first ? first[keys[i - 1].second] : keys[i].second;
  std::vector<Point> points;
  for (std::size_t v = 0; v < first.size(); ++v) {
    number[v] = first[v] == static_cast<std::int32_t>(v) ? static_cast<std::int32_t>(points.size()) : number[first[v]];
    if (first[v] == static_cast<std::int32_t>(v)) points.push_back(mesh.points[v]);
  }
  mesh.points = std::move(points);
  for (Triangle& t : mesh.triangles)
    for (auto& v : t) v = number[v];
}

/// A torus-like grid of nu x nv vertices (nv even), every other row shifted by half a step: place(u, v) with u and v
/// in turns, [0, 1). The outward side is that of du x dv.
template <class Place>
TriangleMesh closed_grid(int nu, int nv, Place place) {
  TriangleMesh mesh;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) mesh.points.push_back(to_point(place((i + 0.5 * (j % 2)) / nu, double(j) / nv)));
  auto at = [&](int i, int j) { return (j % nv) * nu + i % nu; };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int shift = j % 2;
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + shift, j + 1)});
      mesh.triangles.push_back({at(i + 1, j), at(i + 1 + shift, j + 1), at(i + shift, j + 1)});
    }
  return mesh;
}

/// Counts {nu, nv} of a grid of n nearly equilateral triangles pairs on a surface of the given sides; nv is even.
std::pair<int, int> grid_counts(int n, double length_u, double length_v) {
  const double row = std::sqrt(n * length_v / length_u * 2 / std::sqrt(3.0));  // rows are sqrt(3)/2 edges apart
  const int nv = std::max(4, 2 * static_cast<int>(std::lround(row / 2)));
  return {std::max(3, static_cast<int>(std::lround(double(n) / nv))), nv};
}

// --- shapes -----------------------------------------------------------------------------------------------

TriangleMesh sphere(int n) {
  const int m = std::max(1, root((n - 2) / 10.0));  // 10 m^2 + 2 vertices
  const double g = std::numbers::phi;
  const Vec corner[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  TriangleMesh mesh;
  for (const auto& [a, b, c] : faces) {
    const auto base = static_cast<int>(mesh.points.size());
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i + j <= m; ++i)
        mesh.points.push_back(to_point(((m - i - j) * corner[a] + i * corner[b] + j * corner[c]).normalized()));
    auto at = [&](int i, int j) { return base + lattice_index(m, i, j); };
    for (int j = 0; j < m; ++j)
      for (int i = 0; i + j < m; ++i) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < m) mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  weld(mesh);
  return mesh;
}

TriangleMesh torus(int n) {
  constexpr double major = 1, minor = 0.4;
  const auto [nu, nv] = grid_counts(n, major, minor);
  return closed_grid(nu, nv, [](double u, double v) {
    const double ring = major + minor * std::cos(2 * pi * v);
    return Vec(ring * std::cos(2 * pi * u), ring * std::sin(2 * pi * u), minor * std::sin(2 * pi * v));
  });
}

/// The (2,3) torus knot and the normal of its torus, which is a closed frame along it; t in turns.
struct KnotFrame {
  Vec centre, tangent, normal, binormal;  ///< tangent not normalised: the derivative by t
};

KnotFrame knot_frame(double t) {
  constexpr double major = 2, minor = 1;
  const double around = 2 * 2 * pi * t, across = 3 * 2 * pi * t;
  const Vec radial(std::cos(around), std::sin(around), 0), along(-std::sin(around), std::cos(around), 0);
  const double ring = major + minor * std::cos(across);
  KnotFrame f;
  f.centre = ring * radial + minor * std::sin(across) * Vec::UnitZ();
  f.normal = std::cos(across) * radial + std::sin(across) * Vec::UnitZ();
  f.tangent = 4 * pi * ring * along + 6 * pi * minor * (std::cos(across) * Vec::UnitZ() - std::sin(across) * radial);
  f.binormal = f.normal.cross(f.tangent.normalized());
  return f;
}

/// Steps along the knot are equally long, and the frame turns about the tangent as little as closing allows: otherwise
/// the triangles would be stretched and sheared.
TriangleMesh knot(int n) {
  constexpr double radius = 0.5;
  constexpr int samples = 6000;  // trapezoidal sums of smooth periodic functions: exact to rounding long before
  std::vector<double> length(samples + 1, 0.0), twist(samples + 1, 0.0);
  for (int i = 0; i < samples; ++i) {
    const KnotFrame f = knot_frame((i + 0.5) / samples);
    const Vec turn = (knot_frame((i + 1.0) / samples).normal - knot_frame(double(i) / samples).normal);
    length[i + 1] = length[i] + f.tangent.norm() / samples;
    twist[i + 1] = twist[i] - turn.dot(f.binormal);
  }
  const double excess = twist.back() - 2 * pi * std::round(twist.back() / (2 * pi));
  const auto [nu, nv] = grid_counts(n, length.back(), 2 * pi * radius);
  return closed_grid(nu, nv, [&](double u, double v) {
    const double s = u * length.back();
    const auto i =
        std::min<std::ptrdiff_t>(samples, std::upper_bound(length.begin(), length.end(), s) - length.begin());
    const double part = (s - length[i - 1]) / (length[i] - length[i - 1]);
    const KnotFrame f = knot_frame((static_cast<double>(i) - 1 + part) / samples);
    const double angle = 2 * pi * v + twist[i - 1] + part * (twist[i] - twist[i - 1]) - u * excess;
    return Vec(f.centre + radius * (std::cos(angle) * f.normal + std::sin(angle) * f.binormal));
  });
}

/// (m + 1)^2 vertices on the square origin + [0, 1] x + [0, 1] y, normal x cross y.
void add_square(TriangleMesh& mesh, int m, const Vec& origin, const Vec& x, const Vec& y) {
  const auto base = static_cast<int>(mesh.points.size());
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) mesh.points.push_back(to_point(origin + double(i) / m * x + double(j) / m * y));
  auto at = [&](int i, int j) { return base + j * (m + 1) + i; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

TriangleMesh cube(int n) {
  const int m = std::max(1, root((n - 2) / 6.0));  // 6 m^2 + 2 vertices
  TriangleMesh mesh;
  for (int d = 0; d < 3; ++d)
    for (double side : {-0.5, 0.5}) {
      Vec x = Vec::Unit((d + 1) % 3), y = Vec::Unit((d + 2) % 3);
      if (side < 0) std::swap(x, y);
      add_square(mesh, m, side * Vec::Unit(d) - 0.5 * x - 0.5 * y, x, y);
    }
  weld(mesh);
  return mesh;
}

TriangleMesh plane(int n) {
  TriangleMesh mesh;
  add_square(mesh, std::max(1, root(n) - 1), Vec::Zero(), Vec::UnitX(), Vec::UnitY());
  return mesh;
}

TriangleMesh cub(int n) { return animal(static_cast<std::size_t>(n)); }

// --- the text form ----------------------------------------------------------------------------------------

struct BuiltinShape {
  const char* name;
  TriangleMesh (*make)(int n);
};
constexpr BuiltinShape builtin_shapes[] = {{"animal", cub},  {"cube", cube},     {"knot", knot},
                                           {"plane", plane}, {"sphere", sphere}, {"torus", torus}};

[[noreturn]] void unknown(const std::string& what, const std::string& word, const std::vector<std::string>& known) {
  const std::string hint = did_you_mean(word, known);
  throw Error(Fault::usage, "unknown " + what + " \"" + word + "\"; " + (hint.empty() ? "" : hint + " ") +
                                "known: " + join_names(known));
}

int parse_count(const std::string& parameters) {
  const std::size_t equals = parameters.find('=');
  const std::string name = parameters.substr(0, equals);
  if (name != "n") unknown("parameter of a built-in shape", name, {"n"});
  const std::string text = equals == std::string::npos ? "" : parameters.substr(equals + 1);
  int n = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (fault != std::errc() || end != text.data() + text.size() || n < smallest_count || n > largest_count)
    throw Error(Fault::usage, "the vertex count n=" + text + " of a built-in shape must be a whole number from " +
                                  std::to_string(smallest_count) + " to " + std::to_string(largest_count));
  return n;
}

}  // namespace

std::vector<std::string> builtin_shape_names() {
  std::vector<std::string> names;
  for (const BuiltinShape& shape : builtin_shapes) names.emplace_back(shape.name);
  return names;
}

bool is_builtin_shape(std::string_view spec) { return spec.substr(0, prefix.size()) == prefix; }

namespace {

struct ShapeSpec {
  const BuiltinShape* shape;
  int count;
};

ShapeSpec parse_spec(const std::string& spec) {
  const std::string rest = spec.substr(is_builtin_shape(spec) ? prefix.size() : 0);
  const std::size_t question = rest.find('?');
  const std::string name = rest.substr(0, question);
  const auto shape = std::find_if(std::begin(builtin_shapes), std::end(builtin_shapes),
                                  [&](const BuiltinShape& s) { return name == s.name; });
  if (shape == std::end(builtin_shapes)) unknown("built-in shape", name, builtin_shape_names());
  return {shape, question == std::string::npos ? default_count : parse_count(rest.substr(question + 1))};
}

}  // namespace

void check_builtin_shape(const std::string& spec) { parse_spec(spec); }

TriangleMesh builtin_shape(const std::string& spec) {
  const ShapeSpec parsed = parse_spec(spec);
  TriangleMesh mesh = parsed.shape->make(parsed.count);
  mesh.metres_per_unit = 1;
  return mesh;
}

}  // namespace pelage
