// The loops of time/paired_nodes.h for one instruction set (base/each_instruction_set.h).

constexpr std::size_t lanes = PELAGE_LANES;
// Two loads make a register of four; where it takes more instructions to fill a wider one, nothing is gained by it.
constexpr std::size_t gathered_lanes = lanes == 8 ? 4 : lanes;
constexpr std::size_t pairs = gathered_lanes / 2;  // in a register
constexpr std::size_t parts = slice_rows / pairs;  // registers for a slice

template <class T, std::size_t n>
using Register [[gnu::vector_size(sizeof(T) * n)]] = T;
using Gathered = Register<float, gathered_lanes>;

template <class Column>
PELAGE_TARGET inline double pair_at(const float* x, Column row) {
  double pair;
  std::memcpy(&pair, x + 2 * static_cast<std::ptrdiff_t>(row), sizeof pair);
  return pair;
}

template <class V, class T>
PELAGE_TARGET inline void load(const T* x, V& out) {
  std::memcpy(&out, x, sizeof out);
}
template <class V, class T>
PELAGE_TARGET inline void store(const V& value, T* x) {
  std::memcpy(x, &value, sizeof value);
}

/// The pairs of some rows.
template <class Column>
PELAGE_TARGET inline void gather(const float* x, const Column* row, Gathered& out) {
#if PELAGE_LANES < 16
  const Register<double, 2> bits = {pair_at(x, row[0]), pair_at(x, row[1])};
#else
  const Register<double, 8> bits = {pair_at(x, row[0]), pair_at(x, row[1]), pair_at(x, row[2]), pair_at(x, row[3]),
                                    pair_at(x, row[4]), pair_at(x, row[5]), pair_at(x, row[6]), pair_at(x, row[7])};
#endif
  out = reinterpret_cast<Gathered>(bits);
}

/// Each number twice.
PELAGE_TARGET inline void twice(const float* value, Gathered& out) {
#if PELAGE_LANES < 16
  out = Gathered{value[0], value[0], value[1], value[1]};
#else
  Register<float, 8> v;
  load(value, v);
  out = __builtin_shufflevector(v, v, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
#endif
}

// Loops over nodes go by `lanes` nodes, two registers of pairs; fields end in whole steps of that kind.
using Full = Register<float, lanes>;

/// u, v = a + b.
PELAGE_TARGET inline void take_apart(const float* a, const float* b, float* u, float* v) {
  Full x[2], y[2];
  load(a, x[0]);
  load(a + lanes, x[1]);
  if (b) {
    load(b, y[0]);
    load(b + lanes, y[1]);
    x[0] += y[0];
    x[1] += y[1];
  }
#if PELAGE_LANES == 4
  store(__builtin_shufflevector(x[0], x[1], 0, 2, 4, 6), u);
  store(__builtin_shufflevector(x[0], x[1], 1, 3, 5, 7), v);
#elif PELAGE_LANES == 8
  // In halves of a register, which no processor is slow with.
  Register<float, 4> h[4];
  for (std::size_t k = 0; k < 2; ++k) {
    h[2 * k] = __builtin_shufflevector(x[k], x[k], 0, 1, 2, 3);
    h[2 * k + 1] = __builtin_shufflevector(x[k], x[k], 4, 5, 6, 7);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    store(__builtin_shufflevector(h[2 * k], h[2 * k + 1], 0, 2, 4, 6), u + 4 * k);
    store(__builtin_shufflevector(h[2 * k], h[2 * k + 1], 1, 3, 5, 7), v + 4 * k);
  }
#else
  store(__builtin_shufflevector(x[0], x[1], 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30), u);
  store(__builtin_shufflevector(x[0], x[1], 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31), v);
#endif
}

/// The reverse, for `lanes` nodes.
PELAGE_TARGET inline void put_together(const float* u, const float* v, Full& first, Full& second) {
#if PELAGE_LANES == 4
  Full a, b;
  load(u, a);
  load(v, b);
  first = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  second = __builtin_shufflevector(a, b, 2, 6, 3, 7);
#elif PELAGE_LANES == 8
  Register<float, 4> a, b;
  Full* const out[2] = {&first, &second};
  for (std::size_t k = 0; k < 2; ++k) {
    load(u + 4 * k, a);
    load(v + 4 * k, b);
    *out[k] = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 4, 1, 5),
                                      __builtin_shufflevector(a, b, 2, 6, 3, 7), 0, 1, 2, 3, 4, 5, 6, 7);
  }
#else
  Full a, b;
  load(u, a);
  load(v, b);
  first = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  second = __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
#endif
}

/// `step`: between what the columns of one slice and the next are counted from. `twin`: values for either species.
template <bool twin, class Column>
PELAGE_TARGET void multiply_from(const SlicedMatrix& matrix, const Column* column, std::size_t step,
                                 const float* values, const float* x, const float* base, const float* scale,
                                 std::size_t first, std::size_t last, float* out) {
  Gathered factor;
  for (std::size_t k = 0; k < gathered_lanes; ++k) factor[k] = scale[k % 2];
  const std::size_t* const start = matrix.start.data();
  for (std::size_t s = first; s < last; ++s) {
    Gathered own[parts], sum[parts];
    for (std::size_t p = 0; p < parts; ++p) {
      load(x + 2 * slice_rows * s + p * gathered_lanes, own[p]);
      sum[p] = Gathered{};
    }
    const float* const from = x + 2 * step * s;
    for (std::size_t e = start[s]; e < start[s + 1]; ++e)
#pragma GCC unroll 4
      for (std::size_t p = 0; p < parts; ++p) {
        Gathered other, value;
        gather(from, column + slice_rows * e + p * pairs, other);
        if constexpr (twin)
          load(values + 2 * slice_rows * e + p * gathered_lanes, value);
        else
          twice(values + slice_rows * e + p * pairs, value);
        sum[p] += value * (other - own[p]);
      }
    for (std::size_t p = 0; p < parts; ++p) {
      const std::size_t at = 2 * slice_rows * (s - first) + p * gathered_lanes;
      Gathered result = factor * sum[p];
      if (base) {
        Gathered b;
        load(base + at, b);
        result = b + result;
      }
      store(result, out + at);
    }
  }
}

template <bool twin>
PELAGE_TARGET void multiply(const SlicedMatrix& matrix, const float* values, const float* x, const float* base,
                            const float* scale, std::size_t first, std::size_t last, float* out) {
  if (matrix.column.empty())
    multiply_from<twin>(matrix, matrix.near.data(), slice_rows, values, x, base, scale, first, last, out);
  else
    multiply_from<twin>(matrix, matrix.column.data(), 0, values, x, base, scale, first, last, out);
}

/// The number of node i along an axis of n nodes: around the ends, or as in mirrors on the first and the last node.
PELAGE_TARGET inline std::size_t node_within(std::ptrdiff_t i, std::size_t n, bool periodic) {
  const auto end = static_cast<std::ptrdiff_t>(n);
  if (end == 1) return 0;
  while (i < 0 || i >= end) {
    if (periodic)
      i += i < 0 ? end : -end;
    else
      i = i < 0 ? -i : 2 * (end - 1) - i;
  }
  return static_cast<std::size_t>(i);
}

/// The two neighbours of a node, and their weight.
struct OppositeRows {
  const float *after, *before;
  Full weight;
};

/// `width` registers of nodes; `shift`: of what the neighbours are counted from.
template <std::size_t width>
PELAGE_TARGET inline void stencil_nodes(const OppositeRows* neighbours, std::size_t count, std::size_t shift,
                                        const float* own, const Full& scale, float* out) {
  Full twice[width], sum[width];
#pragma GCC unroll 4
  for (std::size_t p = 0; p < width; ++p) {
    load(own + p * lanes, twice[p]);
    twice[p] += twice[p];
    sum[p] = Full{};
  }
  for (std::size_t n = 0; n < count; ++n) {
    const float *after = neighbours[n].after + shift, *before = neighbours[n].before + shift;
#pragma GCC unroll 4
    for (std::size_t p = 0; p < width; ++p) {
      Full a, b;
      load(after + p * lanes, a);
      load(before + p * lanes, b);
      sum[p] += neighbours[n].weight * ((a + b) - twice[p]);
    }
  }
#pragma GCC unroll 4
  for (std::size_t p = 0; p < width; ++p) store(scale * sum[p], out + p * lanes);
}

constexpr std::size_t register_nodes = lanes / 2;
/// Two lines along each axis and four along the diagonals between two, of two steps each.
constexpr std::size_t most_neighbours = 18;

/// At most a register of nodes from x on, in a row's end: their neighbours are put together first.
PELAGE_TARGET inline void stencil_end(const PairedStencil& s, const OppositeRows* rows, const float* own,
                                      const Full& scale, std::size_t x, std::size_t nodes, float* out) {
  constexpr std::size_t reach = 2;
  const std::size_t count = s.neighbours.size();
  std::size_t column[register_nodes + 2 * reach];  // from x - reach on; behind the last node anything
  for (std::size_t k = 0; k < register_nodes + 2 * reach; ++k)
    column[k] = 2 * node_within(static_cast<std::ptrdiff_t>(x + k) - static_cast<std::ptrdiff_t>(reach), s.count[0],
                                s.periodic[0]);
  OppositeRows near[most_neighbours];
  float values[most_neighbours][2][lanes], mine[lanes], result[lanes];
  for (std::size_t k = 0; k < register_nodes; ++k) std::memcpy(mine + 2 * k, own + column[k + reach], sizeof(double));
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t* const after = column + reach + s.neighbours[n].step[0];
    const std::size_t* const before = column + reach - s.neighbours[n].step[0];
    for (std::size_t k = 0; k < register_nodes; ++k) {
      std::memcpy(values[n][0] + 2 * k, rows[n].after + after[k], sizeof(double));
      std::memcpy(values[n][1] + 2 * k, rows[n].before + before[k], sizeof(double));
    }
    near[n] = {values[n][0], values[n][1], rows[n].weight};
  }
  stencil_nodes<1>(near, count, 0, mine, scale, result);
  std::memcpy(out, result, 2 * nodes * sizeof(float));
}

/// Nodes [x, end) of the row of the grid to which `own` points; `rows`: those of their neighbours.
PELAGE_TARGET inline void stencil_row(const PairedStencil& s, const OppositeRows* rows, const float* own,
                                      const Full& scale, std::size_t x, std::size_t end, float* out) {
  constexpr std::size_t reach = 2, wide = 4 * register_nodes;
  const std::size_t count = s.neighbours.size(), begin = x;
  OppositeRows near[most_neighbours];  // of the node 0
  for (std::size_t n = 0; n < count; ++n) {
    const std::ptrdiff_t step = 2 * s.neighbours[n].step[0];
    near[n] = {rows[n].after + step, rows[n].before - step, rows[n].weight};
  }
  while (x < end) {
    float* const to = out + 2 * (x - begin);
    const std::size_t left = x < reach || x + reach >= s.count[0] ? 0 : std::min(end, s.count[0] - reach) - x;
    if (left >= wide) {
      stencil_nodes<4>(near, count, 2 * x, own + 2 * x, scale, to);
      x += wide;
    } else if (left >= register_nodes) {
      stencil_nodes<1>(near, count, 2 * x, own + 2 * x, scale, to);
      x += register_nodes;
    } else {
      const std::size_t nodes = std::min(end - x, register_nodes);
      stencil_end(s, rows, own, scale, x, nodes, to);
      x += nodes;
    }
  }
}

PELAGE_TARGET void multiply_stencil(const SlicedMatrix& matrix, const float* x, const float* scale, std::size_t first,
                                    std::size_t last, float* out) {
  const PairedStencil& s = *matrix.stencil;
  const std::size_t nx = s.count[0], ny = s.count[1], nz = s.count[2];
  const std::size_t begin = first * slice_rows, stop = last * slice_rows, end = std::min(stop, matrix.rows);
  OppositeRows rows[most_neighbours];
  Full factor;
  for (std::size_t k = 0; k < lanes; ++k) factor[k] = scale[k % 2];
  for (std::size_t n = 0; n < s.neighbours.size(); ++n)
    for (std::size_t k = 0; k < lanes; ++k) rows[n].weight[k] = s.neighbours[n].weight[k % 2];
  for (std::size_t node = begin; node < end;) {
    const std::size_t row = node / nx, column = node % nx, count = std::min(nx - column, end - node);
    const auto row_at = [&](std::ptrdiff_t j, std::ptrdiff_t k) {
      return x + 2 * nx *
                     (node_within(static_cast<std::ptrdiff_t>(row % ny) + j, ny, s.periodic[1]) +
                      ny * node_within(static_cast<std::ptrdiff_t>(row / ny) + k, nz, s.periodic[2]));
    };
    for (std::size_t n = 0; n < s.neighbours.size(); ++n) {
      const std::array<int, 3>& step = s.neighbours[n].step;
      rows[n].after = row_at(step[1], step[2]);
      rows[n].before = row_at(-step[1], -step[2]);
    }
    stencil_row(s, rows, x + 2 * nx * row, factor, column, column + count, out + 2 * (node - begin));
    node += count;
  }
  for (std::size_t k = 2 * (std::max(begin, end) - begin); k < 2 * (stop - begin); ++k) out[k] = 0;
}

PELAGE_TARGET void diffuse(const SlicedMatrix& matrix, const float* x, const float* scale, std::size_t first,
                           std::size_t last, float* out) {
  if (matrix.stencil) return multiply_stencil(matrix, x, scale, first, last, out);
  const auto times = matrix.twin ? multiply<true> : multiply<false>;
  times(matrix, matrix.diffusion.data(), x, nullptr, scale, first, last, out);
}

PELAGE_TARGET void correct(const SlicedMatrix& matrix, const float* x, const float* base, const float* scale,
                           std::size_t first, std::size_t last, float* out) {
  multiply<false>(matrix, matrix.correction.data(), x, base, scale, first, last, out);
}

PELAGE_TARGET void separate(const float* __restrict a, const float* __restrict b, std::size_t count,
                            float* __restrict u, float* __restrict v) {
  for (std::size_t k = 0; k < count; k += lanes) take_apart(a + 2 * k, b ? b + 2 * k : nullptr, u + k, v + k);
}

PELAGE_TARGET void stage(const StageTerms& terms, const float* __restrict y0, const float* __restrict before,
                         const float* __restrict g0, const float* __restrict q, const float* __restrict f0,
                         const float* __restrict r0, const float* __restrict r1, std::size_t count,
                         float* __restrict d) {
  const StageTerms t = terms;
  Full lower, upper;
  for (std::size_t p = 0; p < lanes; ++p) {
    lower[p] = t.lower[p % 2];
    upper[p] = t.upper[p % 2];
  }
  for (std::size_t k = 0; k < count; k += lanes) {
    Full r[2];
    put_together(r0 + k, r1 + k, r[0], r[1]);
    for (std::size_t h = 0; h < 2; ++h) {
      const std::size_t at = 2 * k + h * lanes;
      Full b, g, p, f, old, from;
      load(y0 + at, from);
      load(before + at, b);
      load(g0 + at, g);
      load(q + at, p);
      load(f0 + at, f);
      load(d + at, old);
      Full next = ((t.mu * b + t.nu * old) + t.first * f) + t.rate * ((g + p) + r[h]);
      const Full down = lower - from, up = upper - from;
      next = next < down ? down : next;
      next = next > up ? up : next;
      store(next, d + at);
    }
  }
}

PELAGE_TARGET void first_stage(const StageTerms& terms, const float* __restrict y0, const float* __restrict f0,
                               std::size_t count, float* __restrict d) {
  Full lower, upper;
  for (std::size_t p = 0; p < lanes; ++p) {
    lower[p] = terms.lower[p % 2];
    upper[p] = terms.upper[p % 2];
  }
  for (std::size_t k = 0; k < 2 * padded(count); k += lanes) {
    Full from, next;
    load(y0 + k, from);
    load(f0 + k, next);
    next = terms.rate * next;
    const Full down = lower - from, up = upper - from;
    next = next < down ? down : next;
    next = next > up ? up : next;
    store(next, d + k);
  }
}

PELAGE_TARGET void add_rates(const float* __restrict q, const float* __restrict r0, const float* __restrict r1,
                             std::size_t count, float* __restrict f) {
  for (std::size_t k = 0; k < count; k += lanes) {
    Full r[2], p;
    put_together(r0 + k, r1 + k, r[0], r[1]);
    for (std::size_t h = 0; h < 2; ++h) {
      load(q + 2 * k + h * lanes, p);
      store(p + r[h], f + 2 * k + h * lanes);
    }
  }
}

PELAGE_TARGET void join(const float* __restrict u, const float* __restrict v, std::size_t count, float* __restrict x) {
  for (std::size_t k = 0; k < count; k += lanes) {
    Full pair[2];
    put_together(u + k, v + k, pair[0], pair[1]);
    for (std::size_t h = 0; h < 2; ++h) store(pair[h], x + 2 * k + h * lanes);
  }
}

// Sums have eight parts, whatever the registers: node k belongs to part k % 8. Loops go by eight nodes; of those behind
// the last node nothing is counted.
constexpr std::size_t sum_parts = 8;
constexpr std::size_t wide = lanes / 2;  // doubles in a register
using Wide = Register<double, wide>;

PELAGE_TARGET inline void widen(const float* x, Wide& out) {
#if PELAGE_LANES == 4
  out = Wide{static_cast<double>(x[0]), static_cast<double>(x[1])};
#else
  Register<float, wide> narrow;
  load(x, narrow);
  out = __builtin_convertvector(narrow, Wide);
#endif
}

PELAGE_TARGET inline void narrow_to(const Wide& x, float* out) {
#if PELAGE_LANES == 4
  out[0] = static_cast<float>(x[0]);
  out[1] = static_cast<float>(x[1]);
#else
  store(__builtin_convertvector(x, Register<float, wide>), out);
#endif
}

struct SpeciesParts {
  Wide low, high, largest, deviation, squared, change;
};

template <bool clamped>
PELAGE_TARGET inline void finish_some(const SpeciesLimits& l, const double* before, const float* d, const Wide& weight,
                                      double* after, float* y, SpeciesParts& s) {
  Wide old, value;
  load(before, old);
  widen(d, value);
  value = old + value;
  const Wide modulus = value < 0.0 ? -value : value;
  s.largest = modulus > s.largest ? modulus : s.largest;
  if constexpr (clamped) {
    const Wide lower = Wide{} + l.lower, upper = Wide{} + l.upper;
    value = value < lower ? lower : value;
    value = value > upper ? upper : value;
    // Where the step ends at a clamp, the sum may miss it by its rounding.
    float y0[wide];
    Wide from, step;
    narrow_to(old, y0);
    widen(y0, from);
    widen(d, step);
    value = step <= lower - from + l.slack ? lower : value;
    value = step >= upper - from - l.slack ? upper : value;
  }
  value = modulus < l.smallest ? Wide{} : value;
  store(value, after);
  narrow_to(value, y);
  s.low = value < s.low ? value : s.low;
  s.high = value > s.high ? value : s.high;
  const Wide moved = value - old, away = value - l.middle;
  s.change += weight * (moved * moved);
  s.deviation += weight * away;
  s.squared += weight * (away * away);
}

template <bool clamped>
PELAGE_TARGET void finish_all(const SpeciesLimits& limits, const double* before, const float* d, std::size_t count,
                              double* after, float* y, SpeciesSums& sums) {
  const SpeciesLimits l = limits;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t registers = sum_parts / wide;
  SpeciesParts part[registers];
  for (SpeciesParts& p : part) {
    p.largest = p.deviation = p.squared = p.change = Wide{};
    p.low = Wide{} + infinity;
    p.high = Wide{} - infinity;
  }
  std::size_t k = 0;
  for (; k + sum_parts <= count; k += sum_parts)
    for (std::size_t r = 0; r < registers; ++r) {
      const std::size_t at = k + r * wide;
      finish_some<clamped>(l, before + at, d + at, Wide{} + 1.0, after + at, y + at, part[r]);
    }
  if (k < count) {
    // The rest is filled up with one of its nodes, of weight 0.
    double old[sum_parts], value[sum_parts], weight[sum_parts];
    float step[sum_parts], single[sum_parts];
    for (std::size_t p = 0; p < sum_parts; ++p) {
      const std::size_t at = k + p < count ? k + p : k;
      weight[p] = k + p < count ? 1 : 0;
      old[p] = before[at];
      step[p] = d[at];
    }
    for (std::size_t r = 0; r < registers; ++r) {
      const std::size_t at = r * wide;
      Wide w;
      load(weight + at, w);
      finish_some<clamped>(l, old + at, step + at, w, value + at, single + at, part[r]);
    }
    for (std::size_t p = 0; k + p < count; ++p) {
      after[k + p] = value[p];
      y[k + p] = single[p];
    }
  }
  for (std::size_t p = 0; p < sum_parts; ++p) {
    const SpeciesParts& r = part[p / wide];
    const std::size_t lane = p % wide;
    sums += SpeciesSums{r.low[lane], r.high[lane], r.largest[lane], r.deviation[lane], r.squared[lane], r.change[lane]};
  }
}

PELAGE_TARGET void finish(const SpeciesLimits& limits, const double* before, const float* d, std::size_t count,
                          double* after, float* y, SpeciesSums& sums) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool clamped = limits.lower > -infinity || limits.upper < infinity;
  (clamped ? finish_all<true> : finish_all<false>)(limits, before, d, count, after, y, sums);
}

/// Padding has neither error nor value.
PELAGE_TARGET void error(const ErrorTerms& terms, const float* y0, const float* y1, const float* d, const float* f0,
                         const float* f1, std::size_t count, double* sums) {
  constexpr std::size_t registers = 2 * sum_parts / lanes;
  Full lower, upper, scale, squared[registers], size[registers];
  for (std::size_t p = 0; p < lanes; ++p) {
    lower[p] = terms.lower[p % 2];
    upper[p] = terms.upper[p % 2];
    scale[p] = terms.scale[p % 2];
  }
  for (std::size_t r = 0; r < registers; ++r) squared[r] = size[r] = Full{};
  for (std::size_t k = 0; k < 2 * count; k += 2 * sum_parts)
    for (std::size_t r = 0; r < registers; ++r) {
      const std::size_t at = k + r * lanes;
      Full from, to, step, slope, other;
      load(y0 + at, from);
      load(y1 + at, to);
      load(d + at, step);
      load(f0 + at, slope);
      load(f1 + at, other);
      Full e = terms.weight * (slope + other) - 0.8f * step;
      e = ((to > lower) & (to < upper) & (from > lower) & (from < upper)) ? e : Full{};
      e *= scale;
      squared[r] += e * e;
      const Full u = to * scale;
      size[r] += u * u;
    }
  for (std::size_t p = 0; p < 2 * sum_parts; ++p) {
    sums[2 * (p % 2)] += static_cast<double>(squared[p / lanes][p % lanes]);
    sums[2 * (p % 2) + 1] += static_cast<double>(size[p / lanes][p % lanes]);
  }
}

constexpr NodeLoops loops = {diffuse, correct, separate, first_stage, stage, join, finish, error, add_rates};
