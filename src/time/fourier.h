#pragma once
// Fourier transforms of lines, as many at once as a register has lanes.

#include <memory>
#include <vector>

#include "base/instruction_set.h"

namespace pelage {

/// One pass over all elements: m s transforms of a short length, between strides (Stockham). Of element q + s (p + m k)
/// it makes q + s (r p + k).
template <class Real>
struct FourierPass {
  std::size_t radix, m, s;
  std::vector<Real> twiddles;  ///< exp(-2 pi i p k / (m radix)) of p < m and 0 < k < radix: real and imaginary parts
  std::vector<Real> roots;     ///< of an odd radix: cos and sin of 2 pi j / radix
};

template <class Real>
struct FourierLoops {
  std::size_t lanes;
  void (*pass)(const FourierPass<Real>& pass, const Real* x, Real* y);
};

/// Transforms of one length, any but 0, in float or double. All instruction sets give the same bits, and a line does
/// not know of those beside it.
template <class Real>
class Fourier {
 public:
  explicit Fourier(std::size_t length, InstructionSet instructions = best_instruction_set());

  std::size_t length() const { return length_; }
  /// Complex lines that are transformed together.
  std::size_t lanes() const { return loops_->lanes; }
  /// The size of each array that transform() takes.
  std::size_t room() const { return 2 * lanes() * (chirped_ ? chirped_->length() : length_); }

  /// y_k = sum over j of x_j exp(-2 pi i j k / length). Element j holds the real parts of all lines and then the
  /// imaginary ones. Both arrays start at a multiple of 64 bytes; both are used up, and the one that is returned holds
  /// the result.
  Real* transform(Real* x, Real* work) const;

 private:
  void make_passes();
  void make_chirp(InstructionSet instructions);
  Real* by_chirp(Real* x, Real* work) const;
  void times(const std::vector<Real>& factors, const Real* x, Real* y) const;

  std::size_t length_;
  const FourierLoops<Real>* loops_;
  std::vector<FourierPass<Real>> passes_;
  // For lengths with large prime factors: a convolution with a chirp, of another length (Bluestein 1970).
  std::unique_ptr<const Fourier> chirped_;
  std::vector<Real> chirp_, kernel_;
};

extern template class Fourier<float>;
extern template class Fourier<double>;

}  // namespace pelage
