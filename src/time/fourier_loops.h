// The passes of time/fourier.h for one instruction set (base/each_instruction_set.h).

template <class Real>
struct Lane {
  using type [[gnu::vector_size(4 * PELAGE_LANES), gnu::may_alias]] = Real;
};

/// One number of every line.
template <class Real>
struct Lanes {
  typename Lane<Real>::type re, im;
};

template <class Real>
PELAGE_TARGET inline void store_rotated(const Lanes<Real>& b, Real re, Real im, Lanes<Real>& y) {
  y.re = b.re * re - b.im * im;
  y.im = b.re * im + b.im * re;
}

template <class Real>
PELAGE_TARGET void pass_of_two(const FourierPass<Real>& pass, const Lanes<Real>* x, Lanes<Real>* y) {
  const std::size_t m = pass.m, s = pass.s;
  for (std::size_t p = 0; p < m; ++p) {
    const Real re = pass.twiddles[2 * p], im = pass.twiddles[2 * p + 1];
    for (std::size_t q = 0; q < s; ++q) {
      const Lanes<Real>&a = x[q + s * p], &b = x[q + s * (p + m)];
      const Lanes<Real> difference = {a.re - b.re, a.im - b.im};
      Lanes<Real>* out = y + q + s * 2 * p;
      out->re = a.re + b.re;
      out->im = a.im + b.im;
      store_rotated(difference, re, im, out[s]);
    }
  }
}

template <class Real>
PELAGE_TARGET void pass_of_four(const FourierPass<Real>& pass, const Lanes<Real>* x, Lanes<Real>* y) {
  const std::size_t m = pass.m, s = pass.s;
  for (std::size_t p = 0; p < m; ++p) {
    const Real* w = pass.twiddles.data() + 6 * p;
    for (std::size_t q = 0; q < s; ++q) {
      const Lanes<Real>&a = x[q + s * p], &b = x[q + s * (p + m)], &c = x[q + s * (p + 2 * m)],
            &d = x[q + s * (p + 3 * m)];
      const Lanes<Real> sum = {a.re + c.re, a.im + c.im}, difference = {a.re - c.re, a.im - c.im},
                        other_sum = {b.re + d.re, b.im + d.im},
                        turned = {b.im - d.im, d.re - b.re};  // (b - d) times -i
      Lanes<Real>* out = y + q + s * 4 * p;
      out->re = sum.re + other_sum.re;
      out->im = sum.im + other_sum.im;
      store_rotated(Lanes<Real>{difference.re + turned.re, difference.im + turned.im}, w[0], w[1], out[s]);
      store_rotated(Lanes<Real>{sum.re - other_sum.re, sum.im - other_sum.im}, w[2], w[3], out[2 * s]);
      store_rotated(Lanes<Real>{difference.re - turned.re, difference.im - turned.im}, w[4], w[5], out[3 * s]);
    }
  }
}

/// Of an odd radix: the elements j and r - j go together, as do the results k and r - k.
template <class Real>
PELAGE_TARGET void pass_of_odd(const FourierPass<Real>& pass, const Lanes<Real>* x, Lanes<Real>* y) {
  const std::size_t m = pass.m, s = pass.s, r = pass.radix, half = r / 2;
  Lanes<Real> sum[largest_radix / 2 + 1], difference[largest_radix / 2 + 1];
  for (std::size_t p = 0; p < m; ++p) {
    const Real* w = pass.twiddles.data() + 2 * (r - 1) * p;
    for (std::size_t q = 0; q < s; ++q) {
      const Lanes<Real>& first = x[q + s * p];
      Lanes<Real> all = first;
      for (std::size_t j = 1; j <= half; ++j) {
        const Lanes<Real>&a = x[q + s * (p + m * j)], &b = x[q + s * (p + m * (r - j))];
        sum[j] = {a.re + b.re, a.im + b.im};
        difference[j] = {a.re - b.re, a.im - b.im};
        all.re += sum[j].re;
        all.im += sum[j].im;
      }
      Lanes<Real>* out = y + q + s * r * p;
      *out = all;
      for (std::size_t k = 1; k <= half; ++k) {
        Lanes<Real> even = first, odd{};
        std::size_t turn = 0;
        for (std::size_t j = 1; j <= half; ++j) {
          turn += k;
          if (turn >= r) turn -= r;
          const Real c = pass.roots[2 * turn], i = pass.roots[2 * turn + 1];
          even.re += sum[j].re * c;
          even.im += sum[j].im * c;
          odd.re += difference[j].im * i;  // times -i
          odd.im -= difference[j].re * i;
        }
        store_rotated(Lanes<Real>{even.re + odd.re, even.im + odd.im}, w[2 * k - 2], w[2 * k - 1], out[s * k]);
        store_rotated(Lanes<Real>{even.re - odd.re, even.im - odd.im}, w[2 * (r - k) - 2], w[2 * (r - k) - 1],
                      out[s * (r - k)]);
      }
    }
  }
}

template <class Real>
PELAGE_TARGET void pass(const FourierPass<Real>& p, const Real* x, Real* y) {
  const auto* in = reinterpret_cast<const Lanes<Real>*>(x);
  auto* out = reinterpret_cast<Lanes<Real>*>(y);
  if (p.radix == 2) return pass_of_two(p, in, out);
  if (p.radix == 4) return pass_of_four(p, in, out);
  pass_of_odd(p, in, out);
}

template <class Real>
const FourierLoops<Real> loops = {4 * PELAGE_LANES / sizeof(Real), pass<Real>};
