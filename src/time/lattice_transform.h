#pragma once
// Fields on a lattice as sums of waves, and back: fast Fourier transforms along periodic axes, cosine transforms along
// closed ones.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "discretise/lattice.h"
#include "time/fourier.h"

namespace pelage {

/// Lines along an axis of an array: element j of line i + inner * o has the number (o * length + j) * inner + i.
struct LineNumbers {
  std::size_t outer, length, inner;
};

/// Waves of one lattice. Real is float or double. The functions may be called from several threads, and give the same
/// bits for any number of them.
template <class Real>
class LatticeTransform {
 public:
  explicit LatticeTransform(const Lattice& lattice);

  const Lattice& lattice() const { return lattice_; }
  /// Waves, of a pair of which that belong together one is stored.
  std::size_t waves() const { return stored_[0] * stored_[1] * stored_[2]; }
  /// Numbers per wave: 2, real and imaginary part, or 1 where no axis is periodic.
  std::size_t width() const { return first_periodic_ < 0 ? 1 : 2; }
  /// Numbers in all.
  std::size_t size() const { return waves() * width(); }

  /// `field`: a value per node; `waves`: size() numbers.
  void forward(const Real* field, Real* waves) const;
  /// What forward() was given; `waves` is used up.
  void inverse(Real* waves, Real* field) const;

  /// k . T k of every wave [1 / time] for a tensor T [world unit^2 / time]. Mixed terms are left out along closed axes,
  /// whose mirrors do not know them, and for the shortest wave of an even number of nodes, which has both directions.
  std::vector<double> quadratic_form(const Eigen::Matrix3d& tensor) const;

  /// The mean of the squares of the field over the nodes, those on closed borders counting half.
  double mean_square(std::span<const Real> waves) const;

 private:
  LineNumbers lines(int axis, const std::array<std::size_t, 3>& count, std::size_t width) const;
  std::size_t rows_of(std::size_t numbers) const;
  void other_axes(Real* waves, bool inverse) const;
  void real_forward(const Real* field, Real* waves) const;
  void real_inverse(const Real* waves, Real* field) const;
  double scale() const;

  Lattice lattice_;
  std::array<std::optional<Fourier<Real>>, 3> fourier_;  ///< of axes with an extent
  int first_periodic_ = -1;                              ///< along it the second half of the waves is left out
  std::array<std::size_t, 3> stored_{};                  ///< waves along each axis
};

extern template class LatticeTransform<float>;
extern template class LatticeTransform<double>;

}  // namespace pelage
