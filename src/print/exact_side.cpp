#include "print/exact_side.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pelage {

namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// A number as the exact sum of doubles that do not overlap, small ones first (Shewchuk 1997, section 2).
class ExactNumber {
 public:
  ExactNumber() = default;
  static ExactNumber difference(double a, double b) {
    ExactNumber x;
    x.add(a);
    x.add(-b);
    return x;
  }

  ExactNumber operator+(const ExactNumber& other) const {
    ExactNumber sum = *this;
    for (const double y : other.parts_) sum.add(y);
    return sum;
  }
  ExactNumber operator-(const ExactNumber& other) const {
    ExactNumber sum = *this;
    for (const double y : other.parts_) sum.add(-y);
    return sum;
  }
  ExactNumber operator*(const ExactNumber& other) const {
    ExactNumber product;
    for (const double x : parts_)
      for (const double y : other.parts_) {
        const double rounded = x * y;
        product.add(std::fma(x, y, -rounded));
        product.add(rounded);
      }
    return product;
  }
  /// That of the largest part.
  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

 private:
  void add(double y) {
    std::vector<double> sum;
    for (const double x : parts_) {
      const double rounded = x + y, of_y = rounded - x, of_x = rounded - of_y;
      const double rest = (x - of_x) + (y - of_y);
      if (rest != 0) sum.push_back(rest);
      y = rounded;
    }
    if (y != 0) sum.push_back(y);
    parts_ = std::move(sum);
  }

  std::vector<double> parts_;
};

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

int exact_turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const auto part = [&](const PlanePoint& p, std::size_t k) { return ExactNumber::difference(p[k], a[k]); };
  return (part(b, 0) * part(c, 1) - part(b, 1) * part(c, 0)).sign();
}

int exact_side(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto part = [&](const Point& p, std::size_t k) { return ExactNumber::difference(p[k % 3], a[k % 3]); };
  ExactNumber sum;
  for (std::size_t k = 0; k < 3; ++k)
    sum = sum + (part(b, k + 1) * part(c, k + 2) - part(b, k + 2) * part(c, k + 1)) * part(d, k);
  return sum.sign();
}

}  // namespace

int turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double doubt = (3 + 16 * unit_roundoff) * unit_roundoff * (std::abs(left) + std::abs(right));
  return std::abs(left - right) >= doubt && doubt > 0 ? sign_of(left - right) : exact_turn(a, b, c);
}

int side(const Point& a, const Point& b, const Point& c, const Point& d) {
  double sum = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]), height = d[k] - a[k];
    sum += (left - right) * height;
    size += (std::abs(left) + std::abs(right)) * std::abs(height);
  }
  const double doubt = (7 + 56 * unit_roundoff) * unit_roundoff * size;
  return std::abs(sum) > doubt ? sign_of(sum) : exact_side(a, b, c, d);
}

}  // namespace pelage
