#include "time/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "base/random.h"

namespace pelage {
namespace {

/// Arrays that begin at a multiple of 64 bytes.
template <class Real>
class Aligned {
 public:
  explicit Aligned(std::size_t n) : memory_(n + 64 / sizeof(Real)), begin_(memory_.data()) {
    while (reinterpret_cast<std::uintptr_t>(begin_) % 64) ++begin_;
  }
  Real* data() { return begin_; }

 private:
  std::vector<Real> memory_;
  Real* begin_;
};

std::complex<double> value(std::size_t line, std::size_t j) {
  return {uniform(line, j) - 0.3, uniform(100 + line, j) - 0.6};
}

/// Of lines with such values: result k of line l at l + lanes k.
template <class Real>
std::vector<std::complex<double>> transformed(const Fourier<Real>& fourier, std::size_t first_line = 0) {
  Aligned<Real> x(fourier.room()), work(fourier.room());
  const std::size_t lanes = fourier.lanes();
  for (std::size_t j = 0; j < fourier.length(); ++j)
    for (std::size_t l = 0; l < lanes; ++l) {
      x.data()[2 * lanes * j + l] = static_cast<Real>(value(first_line + l, j).real());
      x.data()[2 * lanes * j + lanes + l] = static_cast<Real>(value(first_line + l, j).imag());
    }
  const Real* y = fourier.transform(x.data(), work.data());
  std::vector<std::complex<double>> result;
  for (std::size_t k = 0; k < fourier.length(); ++k)
    for (std::size_t l = 0; l < lanes; ++l) result.emplace_back(y[2 * lanes * k + l], y[2 * lanes * k + lanes + l]);
  return result;
}

template <class Real>
void expect_definition(double tolerance) {
  for (const std::size_t n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 30, 61, 64, 67, 105, 122, 128, 134, 201}) {
    const Fourier<Real> fourier(n);
    const auto y = transformed(fourier);
    for (std::size_t l : {std::size_t{0}, fourier.lanes() - 1})
      for (std::size_t k = 0; k < n; ++k) {
        std::complex<double> sum = 0;
        for (std::size_t j = 0; j < n; ++j)
          sum += value(l, j) *
                 std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(j * k % n) / static_cast<double>(n));
        ASSERT_LT(std::abs(y[k * fourier.lanes() + l] - sum), tolerance * std::sqrt(static_cast<double>(n)))
            << n << " " << k;
      }
  }
}

TEST(Fourier, IsTheSumOfItsDefinition) {
  expect_definition<double>(1e-14);
  expect_definition<float>(5e-6);
}

/// A line has the same bits in every lane of every instruction set.
template <class Real>
void expect_same_bits() {
  for (const std::size_t n : {60, 67, 128}) {
    const Fourier<Real> plain(n, InstructionSet::baseline);
    const auto expected = transformed(plain);
    for (const InstructionSet set : instruction_sets()) {
      const Fourier<Real> fourier(n, set);
      const auto y = transformed(fourier);
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < plain.lanes(); ++l)
          ASSERT_EQ(y[k * fourier.lanes() + l], expected[k * plain.lanes() + l]) << n;
    }
  }
  const Fourier<Real> fourier(60);
  const auto a = transformed(fourier, 0), b = transformed(fourier, 1);
  for (std::size_t k = 0; k < 60; ++k) ASSERT_EQ(a[k * fourier.lanes() + 1], b[k * fourier.lanes()]);
}

TEST(Fourier, EveryInstructionSetHasTheSameBits) {
  expect_same_bits<double>();
  expect_same_bits<float>();
}

}  // namespace
}  // namespace pelage
