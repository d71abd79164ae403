#include "time/lattice_transform.h"

#include <algorithm>
#include <numbers>

#include "base/parallel.h"

namespace pelage {

namespace {

/// Numbers per piece of parallel work, at least.
constexpr std::size_t piece = 1 << 14;
/// Real lines that are worked on together at most: two in each of 16 lanes.
constexpr std::size_t most_lines = 32;

/// Two arrays of a thread for one group of lines.
template <class Real>
class Room {
 public:
  explicit Room(std::size_t size) : size_((size + per_chunk - 1) / per_chunk * per_chunk) {
    if (chunks().size() < 2 * size_ / per_chunk) chunks().resize(2 * size_ / per_chunk);
  }
  Real* first() { return chunks().data()->numbers; }
  Real* second() { return first() + size_; }

 private:
  static constexpr std::size_t per_chunk = 64 / sizeof(Real);
  struct alignas(64) Chunk {
    Real numbers[per_chunk];
  };
  static std::vector<Chunk>& chunks() {
    thread_local std::vector<Chunk> chunks;
    return chunks;
  }
  std::size_t size_;
};

/// Neighbouring real lines of an array that are transformed together, two in a complex one.
class Group {
 public:
  Group(const LineNumbers& lines, std::size_t first, std::size_t lanes)
      : inner_(lines.inner), first_(first), lanes_(lanes) {
    count_ = std::min(2 * lanes, lines.outer * lines.inner - first);
    for (std::size_t q = 0; q < count_; ++q)
      begin_[q] = (first + q) / lines.inner * lines.length * lines.inner + (first + q) % lines.inner;
    side_by_side_ = count_ == 2 * lanes && begin_[count_ - 1] == begin_[0] + count_ - 1;
  }
  /// The same lines in an array of another length.
  Group of(const LineNumbers& lines) const { return {lines, first_, lanes_}; }

  std::size_t count() const { return count_; }
  /// Where element j of line q is.
  std::size_t at(std::size_t q, std::size_t j) const { return begin_[q] + j * inner_; }

  /// Into element j of the complex lines: real parts are the first half of the lines, or, adjacent, every other one,
  /// and the parts are exchanged if so wanted. Lines that are not there are 0.
  template <class Real>
  void gather(const Real* array, std::size_t j, bool adjacent, bool exchanged, Real* element) const {
    Real *re = element + (exchanged ? lanes_ : 0), *im = element + (exchanged ? 0 : lanes_);
    if (side_by_side_) {
      const Real* from = array + at(0, j);
      for (std::size_t lane = 0; lane < lanes_; ++lane) {
        re[lane] = from[adjacent ? 2 * lane : lane];
        im[lane] = from[adjacent ? 2 * lane + 1 : lanes_ + lane];
      }
      return;
    }
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      const std::size_t p = adjacent ? 2 * lane : lane, q = adjacent ? 2 * lane + 1 : lanes_ + lane;
      re[lane] = p < count_ ? array[at(p, j)] : Real{0};
      im[lane] = q < count_ ? array[at(q, j)] : Real{0};
    }
  }
  /// Back, times a factor.
  template <class Real>
  void scatter(const Real* element, std::size_t j, bool adjacent, bool exchanged, Real factor, Real* array) const {
    const Real *re = element + (exchanged ? lanes_ : 0), *im = element + (exchanged ? 0 : lanes_);
    if (side_by_side_) {
      Real* to = array + at(0, j);
      for (std::size_t lane = 0; lane < lanes_; ++lane) {
        to[adjacent ? 2 * lane : lane] = re[lane] * factor;
        to[adjacent ? 2 * lane + 1 : lanes_ + lane] = im[lane] * factor;
      }
      return;
    }
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      const std::size_t p = adjacent ? 2 * lane : lane, q = adjacent ? 2 * lane + 1 : lanes_ + lane;
      if (p < count_) array[at(p, j)] = re[lane] * factor;
      if (q < count_) array[at(q, j)] = im[lane] * factor;
    }
  }

 private:
  std::size_t inner_, first_, lanes_, count_ = 0;
  std::array<std::size_t, most_lines> begin_{};
  bool side_by_side_ = false;
};

/// body(group, room) for all groups of lines, in parallel.
template <class Real, class Body>
void for_groups(const LineNumbers& lines, const Fourier<Real>& fourier, Body&& body) {
  const std::size_t together = 2 * fourier.lanes(), all = lines.outer * lines.inner;
  parallel_for((all + together - 1) / together,
               [&](std::size_t begin, std::size_t end) {
                 Room<Real> room(fourier.room());
                 for (std::size_t g = begin; g < end; ++g) body(Group(lines, g * together, fourier.lanes()), room);
               },
               std::max<std::size_t>(1, piece / (lines.length * together)));
}

}  // namespace

template <class Real>
LatticeTransform<Real>::LatticeTransform(const Lattice& lattice) : lattice_(lattice), stored_(lattice.count) {
  for (int a = 0; a < 3; ++a) {
    if (lattice.count[a] < 2) continue;
    if (lattice.periodic[a] && first_periodic_ < 0) first_periodic_ = a;
    fourier_[a].emplace(lattice.periodic[a] ? lattice.count[a] : 2 * (lattice.count[a] - 1));
  }
  if (first_periodic_ >= 0) stored_[first_periodic_] = lattice.count[first_periodic_] / 2 + 1;
}

template <class Real>
LineNumbers LatticeTransform<Real>::lines(int axis, const std::array<std::size_t, 3>& count, std::size_t width) const {
  LineNumbers l{1, count[axis], width};
  for (int a = 0; a < axis; ++a) l.inner *= count[a];
  for (int a = axis + 1; a < 3; ++a) l.outer *= count[a];
  return l;
}

/// Forward and back along all axes multiplies by the numbers of nodes, mirror images included.
template <class Real>
double LatticeTransform<Real>::scale() const {
  double product = 1;
  for (int a = 0; a < 3; ++a)
    if (lattice_.count[a] > 1)
      product *= static_cast<double>(lattice_.periodic[a] ? lattice_.count[a] : 2 * (lattice_.count[a] - 1));
  return 1 / product;
}

/// Two real lines x, y are one complex line x + i y, of whose waves Z
///   X_k = (Z_k + conj Z_(n-k)) / 2   and   Y_k = (Z_k - conj Z_(n-k)) / 2i.
template <class Real>
void LatticeTransform<Real>::real_forward(const Real* field, Real* waves) const {
  const Fourier<Real>& fourier = *fourier_[first_periodic_];
  const LineNumbers from = lines(first_periodic_, lattice_.count, 1), to = lines(first_periodic_, stored_, 1);
  const std::size_t n = from.length, lanes = fourier.lanes();
  for_groups(from, fourier, [&](const Group& group, Room<Real>& room) {
    for (std::size_t j = 0; j < n; ++j) group.gather(field, j, false, false, room.first() + 2 * lanes * j);
    const Real* z = fourier.transform(room.first(), room.second());
    const Group out = group.of(to);
    for (std::size_t k = 0; k < to.length; ++k) {
      const Real *a = z + 2 * lanes * k, *b = z + 2 * lanes * ((n - k) % n);
      for (std::size_t q = 0; q < std::min(lanes, out.count()); ++q) {
        Real* wave = waves + 2 * out.at(q, k);
        wave[0] = (a[q] + b[q]) / 2;
        wave[1] = (a[q + lanes] - b[q + lanes]) / 2;
      }
      for (std::size_t q = lanes; q < out.count(); ++q) {
        Real* wave = waves + 2 * out.at(q, k);
        wave[0] = (a[q] + b[q]) / 2;
        wave[1] = (b[q - lanes] - a[q - lanes]) / 2;
      }
    }
  });
}

/// Z_k = X_k + i Y_k, Z_(n-k) = conj X_k + i conj Y_k, with real and imaginary parts exchanged before and after, which
/// turns the transform round.
template <class Real>
void LatticeTransform<Real>::real_inverse(const Real* waves, Real* field) const {
  const Fourier<Real>& fourier = *fourier_[first_periodic_];
  const LineNumbers from = lines(first_periodic_, stored_, 1), to = lines(first_periodic_, lattice_.count, 1);
  const std::size_t n = to.length, lanes = fourier.lanes();
  const auto factor = static_cast<Real>(scale());
  for_groups(to, fourier, [&](const Group& group, Room<Real>& room) {
    const Group in = group.of(from);
    for (std::size_t k = 0; k < from.length; ++k) {
      const bool single = k == 0 || 2 * k == n;
      Real *a = room.first() + 2 * lanes * k, *b = room.first() + 2 * lanes * ((n - k) % n);
      std::array<Real, most_lines> re{}, im{};
      for (std::size_t q = 0; q < in.count(); ++q) {
        const Real* wave = waves + 2 * in.at(q, k);
        re[q] = wave[0];
        im[q] = single ? 0 : wave[1];
      }
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        b[lane] = re[lane + lanes] - im[lane];
        b[lane + lanes] = re[lane] + im[lane + lanes];
      }
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        a[lane] = re[lane + lanes] + im[lane];
        a[lane + lanes] = re[lane] - im[lane + lanes];
      }
    }
    const Real* z = fourier.transform(room.first(), room.second());
    for (std::size_t j = 0; j < n; ++j) group.scatter(z + 2 * lanes * j, j, false, true, factor, field);
  });
}

/// All axes but the first periodic one, in place. Along closed ones real lines go with their mirror images, two in a
/// complex one, and as these are even, so are the results.
template <class Real>
void LatticeTransform<Real>::other_axes(Real* waves, bool inverse) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == first_periodic_ || lattice_.count[axis] < 2) continue;
    const Fourier<Real>& fourier = *fourier_[axis];
    const LineNumbers l = lines(axis, stored_, width());
    const bool periodic = lattice_.periodic[axis], exchanged = periodic && inverse;
    const std::size_t element = 2 * fourier.lanes();
    for_groups(l, fourier, [&](const Group& group, Room<Real>& room) {
      for (std::size_t j = 0; j < l.length; ++j)
        group.gather(waves, j, periodic, exchanged, room.first() + element * j);
      for (std::size_t j = l.length; j < fourier.length(); ++j)
        std::copy_n(room.first() + element * (fourier.length() - j), element, room.first() + element * j);
      const Real* z = fourier.transform(room.first(), room.second());
      for (std::size_t j = 0; j < l.length; ++j) group.scatter(z + element * j, j, periodic, exchanged, Real{1}, waves);
    });
  }
}

template <class Real>
void LatticeTransform<Real>::forward(const Real* field, Real* waves) const {
  if (width() == 2)
    real_forward(field, waves);
  else
    std::copy_n(field, lattice_.nodes(), waves);
  other_axes(waves, false);
}

template <class Real>
void LatticeTransform<Real>::inverse(Real* waves, Real* field) const {
  other_axes(waves, true);
  if (width() == 2) return real_inverse(waves, field);
  const auto factor = static_cast<Real>(scale());
  parallel_for(lattice_.nodes(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) field[k] = waves[k] * factor;
  });
}

template <class Real>
std::vector<double> LatticeTransform<Real>::quadratic_form(const Eigen::Matrix3d& tensor) const {
  // Along each axis: the wave numbers, and the same with 0 where mixed terms have to be left out.
  std::array<std::vector<double>, 3> k, mixed;
  for (int a = 0; a < 3; ++a) {
    const std::size_t n = lattice_.count[a];
    const bool periodic = lattice_.periodic[a];
    const double nodes = static_cast<double>(periodic ? n : 2 * (n - 1));
    for (std::size_t j = 0; j < stored_[a]; ++j) {
      const double turns = static_cast<double>(j) - (periodic && 2 * j > n ? static_cast<double>(n) : 0);
      k[a].push_back(n > 1 ? 2 * std::numbers::pi * turns / (nodes * lattice_.spacing[a]) : 0);
      mixed[a].push_back(periodic && 2 * j != n ? k[a].back() : 0);
    }
  }
  std::vector<double> form(waves());
  parallel_for(
      form.size() / stored_[0],
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const std::size_t y = row % stored_[1], z = row / stored_[1];
          const double alone = tensor(1, 1) * k[1][y] * k[1][y] + tensor(2, 2) * k[2][z] * k[2][z] +
                               2 * tensor(1, 2) * mixed[1][y] * mixed[2][z];
          const double with_x = 2 * (tensor(0, 1) * mixed[1][y] + tensor(0, 2) * mixed[2][z]);
          for (std::size_t x = 0; x < stored_[0]; ++x)
            form[x + stored_[0] * row] = tensor(0, 0) * k[0][x] * k[0][x] + with_x * mixed[0][x] + alone;
        }
      },
      rows_of(piece));
  return form;
}

/// So many rows hold about as many numbers.
template <class Real>
std::size_t LatticeTransform<Real>::rows_of(std::size_t numbers) const {
  return std::max<std::size_t>(1, numbers / (width() * stored_[0]));
}

template <class Real>
double LatticeTransform<Real>::mean_square(std::span<const Real> waves) const {
  // How many waves each one stands for, along each axis.
  std::array<std::vector<double>, 3> copies;
  for (int a = 0; a < 3; ++a) {
    const std::size_t n = lattice_.count[a];
    copies[a].assign(stored_[a], n == 1 || (lattice_.periodic[a] && a != first_periodic_) ? 1 : 2);
    copies[a].front() = 1;
    if (!lattice_.periodic[a] || n % 2 == 0) copies[a].back() = 1;
  }
  const std::size_t width = this->width(), row_size = width * stored_[0];
  const double sum = ordered_sum(
      waves.size() / row_size, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double part = 0;
        for (std::size_t row = begin; row < end; ++row) {
          double squares = 0;
          for (std::size_t k = row * row_size; k < (row + 1) * row_size; ++k)
            squares += copies[0][(k - row * row_size) >> (width - 1)] * static_cast<double>(waves[k]) *
                       static_cast<double>(waves[k]);
          part += copies[1][row % stored_[1]] * copies[2][row / stored_[1]] * squares;
        }
        return part;
      },
      rows_of(piece));
  return sum * scale() * scale();
}

template class LatticeTransform<float>;
template class LatticeTransform<double>;

}  // namespace pelage
