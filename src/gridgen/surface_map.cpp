#include "gridgen/surface_map.h"

#include <algorithm>

#include "base/parallel.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

class FormulaSurface : public SurfaceMap {
 public:
  explicit FormulaSurface(std::array<FormulaFunction, 3> coordinates) : coordinates_(std::move(coordinates)) {}

  SurfacePoints at(std::span<const Point> parameters) const override {
    const std::size_t n = parameters.size();
    std::vector<std::vector<double>> uv(2, std::vector<double>(n));
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < n; ++i) uv[k][i] = parameters[i][k];
    SurfacePoints s{std::vector<Point>(n), std::vector<Point>(n), std::vector<Point>(n)};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto values = coordinates_[k].with_gradient(uv);
      for (std::size_t i = 0; i < n; ++i) {
        s.x[i][k] = values[0][i];
        s.xu[i][k] = values[1][i];
        s.xv[i][k] = values[2][i];
      }
    }
    return s;
  }

 private:
  std::array<FormulaFunction, 3> coordinates_;
};

void add(double a, const Point& p, Point& sum) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += a * p[k];
}

/// A curve by the share of its length.
class ByLength {
 public:
  explicit ByLength(const Curve& curve) : samples_(sample(curve, 2000)) {}

  struct Place {
    Point x{}, slope{};  ///< slope: by the share
  };
  Place at(double share) const {
    const double along = share * samples_.total();
    const auto above = std::upper_bound(samples_.length.begin() + 1, samples_.length.end() - 1, along);
    const auto i = static_cast<std::size_t>(above - samples_.length.begin());
    const double piece = samples_.length[i] - samples_.length[i - 1], t = (along - samples_.length[i - 1]) / piece;
    Place place;
    add(1 - t, samples_.points[i - 1], place.x), add(t, samples_.points[i], place.x);
    add(samples_.total() / piece, difference(samples_.points[i], samples_.points[i - 1]), place.slope);
    return place;
  }

 private:
  CurveSamples samples_;
};

class CoonsSurface : public SurfaceMap {
 public:
  explicit CoonsSurface(const std::array<Curve, 4>& s) : south_(s[0]), east_(s[1]), north_(s[2]), west_(s[3]) {}

  SurfacePoints at(std::span<const Point> parameters) const override {
    const std::size_t n = parameters.size();
    SurfacePoints result{std::vector<Point>(n), std::vector<Point>(n), std::vector<Point>(n)};
    parallel_for(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        set(parameters[i][0], parameters[i][1], result.x[i], result.xu[i], result.xv[i]);
    });
    return result;
  }

 private:
  void set(double u, double v, Point& x, Point& xu, Point& xv) const {
    const auto s = south_.at(u), n = north_.at(u), w = west_.at(v), e = east_.at(v);
    add(1 - v, s.x, x), add(v, n.x, x), add(1 - u, w.x, x), add(u, e.x, x);
    add(1 - v, s.slope, xu), add(v, n.slope, xu), add(-1, w.x, xu), add(1, e.x, xu);
    add(-1, s.x, xv), add(1, n.x, xv), add(1 - u, w.slope, xv), add(u, e.slope, xv);
    for (const double a : {0.0, 1.0})
      for (const double b : {0.0, 1.0}) {  // what is counted twice
        const Point corner = (b == 0 ? south_ : north_).at(a).x;
        const double across = a == 0 ? 1 - u : u, along = b == 0 ? 1 - v : v;
        add(-across * along, corner, x);
        add((a == 0 ? 1 : -1) * along, corner, xu);
        add((b == 0 ? 1 : -1) * across, corner, xv);
      }
  }

  ByLength south_, east_, north_, west_;
};

}  // namespace

std::unique_ptr<SurfaceMap> formula_surface(std::array<FormulaFunction, 3> coordinates) {
  return std::make_unique<FormulaSurface>(std::move(coordinates));
}

std::unique_ptr<SurfaceMap> coons_surface(const std::array<Curve, 4>& sides) {
  return std::make_unique<CoonsSurface>(sides);
}

std::array<Curve, 4> coons_parameters(const std::array<Curve, 4>& sides) {
  std::array<Curve, 4> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const CurveSamples samples = sample(sides[k], 2000);
    std::vector<Point> points;
    for (const std::size_t knot : samples.knots) {
      const double share = samples.length[knot] / samples.total();
      points.push_back(k % 2 == 0 ? Point{share, k == 0 ? 0.0 : 1.0, 0} : Point{k == 3 ? 0.0 : 1.0, share, 0});
    }
    result[k] = polyline(std::move(points), sides[k].where);
  }
  return result;
}

}  // namespace pelage
