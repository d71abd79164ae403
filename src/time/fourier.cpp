#include "time/fourier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {

namespace {

/// A prime factor p costs n p operations. Above this one, a convolution is cheaper.
constexpr std::size_t largest_radix = 61;

#define PELAGE_LOOPS "time/fourier_loops.h"
#include "base/each_instruction_set.h"
#undef PELAGE_LOOPS

template <class Real>
const FourierLoops<Real>* loops_of(InstructionSet instructions) {
  switch (instructions) {
    case InstructionSet::avx2:
      return &avx2::loops<Real>;
    case InstructionSet::avx512:
      return &avx512::loops<Real>;
    default:
      return &baseline::loops<Real>;
  }
}

/// exp(-2 pi i turn / n), real and imaginary part.
template <class Real>
void add_root(std::size_t turn, std::size_t n, std::vector<Real>& roots) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(turn % n) / static_cast<double>(n);
  roots.push_back(static_cast<Real>(std::cos(angle)));
  roots.push_back(static_cast<Real>(-std::sin(angle)));
}

/// Fours, then a two, then odd primes; empty where one of them is too large.
std::vector<std::size_t> factors_of(std::size_t n) {
  std::vector<std::size_t> factors;
  for (; n % 4 == 0; n /= 4) factors.push_back(4);
  for (; n % 2 == 0; n /= 2) factors.push_back(2);
  for (std::size_t p = 3; p <= largest_radix; p += 2)
    for (; n % p == 0; n /= p) factors.push_back(p);
  return n == 1 ? factors : std::vector<std::size_t>{};
}

}  // namespace

template <class Real>
Fourier<Real>::Fourier(std::size_t length, InstructionSet instructions)
    : length_(length), loops_(loops_of<Real>(instructions)) {
  make_passes();
  if (passes_.empty() && length_ > 1) make_chirp(instructions);
}

template <class Real>
void Fourier<Real>::make_passes() {
  std::size_t n = length_, s = 1;
  for (const std::size_t r : factors_of(length_)) {
    FourierPass<Real> pass{r, n / r, s, {}, {}};
    for (std::size_t p = 0; p < pass.m; ++p)
      for (std::size_t k = 1; k < r; ++k) add_root(p * k, n, pass.twiddles);
    if (r % 2)
      for (std::size_t j = 0; j < r; ++j) {
        add_root(j, r, pass.roots);
        pass.roots.back() = -pass.roots.back();
      }
    passes_.push_back(std::move(pass));
    n /= r;
    s *= r;
  }
}

template <class Real>
void Fourier<Real>::make_chirp(InstructionSet instructions) {
  std::size_t m = 1;
  while (m < 2 * length_ - 1) m *= 2;
  chirped_ = std::make_unique<const Fourier>(m, instructions);
  for (std::size_t j = 0; j < length_; ++j) add_root(j * j % (2 * length_), 2 * length_, chirp_);
  // The transform of the conjugate chirp, all lines alike.
  std::vector<Real> memory(2 * room() + 32);
  Real* x = memory.data();
  while (reinterpret_cast<std::uintptr_t>(x) % 64) ++x;
  const std::size_t lanes = this->lanes();
  for (std::size_t j = 0; j < length_; ++j)
    for (const std::size_t at : {j, (m - j) % m})
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        x[2 * lanes * at + lane] = chirp_[2 * j];
        x[2 * lanes * at + lanes + lane] = -chirp_[2 * j + 1];
      }
  const Real* y = chirped_->transform(x, x + room());
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t part = 0; part < 2; ++part)
      kernel_.push_back(y[2 * lanes * k + part * lanes] / static_cast<Real>(m));
}

/// Every element times a factor; `y` may be `x`.
template <class Real>
void Fourier<Real>::times(const std::vector<Real>& factors, const Real* x, Real* y) const {
  const std::size_t lanes = this->lanes();
  for (std::size_t j = 0; j < factors.size() / 2; ++j) {
    const Real re = factors[2 * j], im = factors[2 * j + 1];
    for (std::size_t lane = 2 * lanes * j; lane < 2 * lanes * j + lanes; ++lane) {
      const Real a = x[lane], b = x[lane + lanes];
      y[lane] = a * re - b * im;
      y[lane + lanes] = a * im + b * re;
    }
  }
}

/// The inverse transform of the product is the transform with real and imaginary parts exchanged.
template <class Real>
Real* Fourier<Real>::by_chirp(Real* x, Real* work) const {
  const std::size_t lanes = this->lanes(), m = chirped_->length();
  times(chirp_, x, x);
  std::fill(x + 2 * lanes * length_, x + 2 * lanes * m, Real{0});
  Real* y = chirped_->transform(x, work);
  times(kernel_, y, y);
  const auto exchange = [&](Real* z, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j)
      std::swap_ranges(z + 2 * lanes * j, z + 2 * lanes * j + lanes, z + 2 * lanes * j + lanes);
  };
  exchange(y, m);
  Real* z = chirped_->transform(y, y == x ? work : x);
  exchange(z, length_);
  times(chirp_, z, z);
  return z;
}

template <class Real>
Real* Fourier<Real>::transform(Real* x, Real* work) const {
  if (chirped_) return by_chirp(x, work);
  for (const FourierPass<Real>& pass : passes_) {
    loops_->pass(pass, x, work);
    std::swap(x, work);
  }
  return x;
}

template class Fourier<float>;
template class Fourier<double>;

}  // namespace pelage
