#include "time/binary_convolution.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "base/parallel.h"

namespace pelage {

namespace {

/// A changed bit costs as many additions as the kernel has weights, a table lookup eight of them: where fewer than one
/// in so many has changed, changes are cheaper.
constexpr std::size_t few = 10;

/// Bits that one 64-bit number surely holds from any bit of its first byte on: seven pieces of eight.
constexpr std::size_t pieces_at_once = 7;

/// Per piece of parallel work.
constexpr std::size_t rows_at_once = 8;

std::vector<std::size_t> continued(std::size_t count, bool periodic, std::size_t reach) {
  const std::size_t period = periodic ? count : count > 1 ? 2 * (count - 1) : 1;
  std::vector<std::size_t> node;
  for (std::size_t p = 0; p < count + 2 * reach; ++p) {
    const std::size_t at = (p + period - reach % period) % period;
    node.push_back(at < count ? at : period - at);
  }
  return node;
}

}  // namespace

BinaryConvolution::BinaryConvolution(const Lattice& lattice, PairedKernel kernel)
    : count_{lattice.count[0], lattice.count[1]},
      kernel_(std::move(kernel)),
      node_{continued(lattice.count[0], lattice.periodic[0], kernel_.reach[0]),
            continued(lattice.count[1], lattice.periodic[1], kernel_.reach[1])},
      places_(count_[0]),
      pieces_((across() + 7) / 8),
      row_bytes_((node_[0].size() + 7) / 8 + sizeof(std::uint64_t)),
      packed_(row_bytes_ * count_[1]),
      bits_(count_[0] * count_[1]),
      changes_(count_[1]),
      sums_(count_[0] * count_[1]) {
  for (std::size_t p = 0; p < node_[0].size(); ++p) places_[node_[0][p]].push_back(p);
  const std::size_t rows = 2 * kernel_.reach[1] + 1;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::span weights = std::span(kernel_.weight).subspan(row * across(), across());
    const auto used = [](std::uint32_t w) { return w != 0; };
    const auto first = std::ranges::find_if(weights, used) - weights.begin();
    const auto last = std::ranges::find_if(weights.rbegin(), weights.rend(), used) - weights.rbegin();
    used_.push_back({static_cast<std::size_t>(first),
                     std::max(static_cast<std::size_t>(first), across() - static_cast<std::size_t>(last))});
  }
  table_.resize(rows * pieces_ * 256);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t piece = 0; piece < pieces_; ++piece)
      for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t bit = 0; bit < 8 && 8 * piece + bit < across(); ++bit)
          if (byte >> bit & 1)
            table_[(row * pieces_ + piece) * 256 + byte] += kernel_.weight[row * across() + 8 * piece + bit];
}

void BinaryConvolution::pack(std::size_t y) {
  std::uint8_t* row = packed_.data() + y * row_bytes_;
  std::fill_n(row, row_bytes_, std::uint8_t{0});
  for (std::size_t p = 0; p < node_[0].size(); ++p)
    row[p / 8] = static_cast<std::uint8_t>(row[p / 8] | bits_[node_[0][p] + count_[0] * y] << p % 8);
}

void BinaryConvolution::look_up_row(std::size_t y) {
  std::uint32_t* sum = sums_.data() + count_[0] * y;
  std::fill_n(sum, count_[0], 0);
  for (std::size_t row = 0; row <= 2 * kernel_.reach[1]; ++row) {
    const std::uint8_t* packed = packed_.data() + row_bytes_ * node_[1][y + row];
    const std::size_t begin = used_[row].first / 8, end = (used_[row].last + 7) / 8;
    for (std::size_t first = begin; first < end; first += pieces_at_once) {
      const std::uint32_t* table = table_.data() + (row * pieces_ + first) * 256;
      const std::size_t pieces = std::min(pieces_at_once, end - first);
      for (std::size_t x = 0; x < count_[0]; ++x) {
        std::uint64_t window;
        std::memcpy(&window, packed + first + x / 8, sizeof window);
        window >>= x % 8;
        std::uint32_t part = 0;
        for (std::size_t piece = 0; piece < pieces; ++piece) part += table[piece * 256 + (window >> 8 * piece & 255)];
        sum[x] += part;
      }
    }
  }
}

void BinaryConvolution::list_changes(const std::vector<std::uint8_t>& bits, std::size_t y) {
  const std::uint8_t *now = bits.data() + count_[0] * y, *before = bits_.data() + count_[0] * y;
  std::vector<Change>& changes = changes_[y];
  changes.clear();
  constexpr std::size_t at_once = 64;  // nodes whose bits are compared together, as most stay
  for (std::size_t first = 0; first < count_[0]; first += at_once) {
    const std::size_t last = std::min(first + at_once, count_[0]);
    if (std::memcmp(now + first, before + first, last - first) == 0) continue;
    for (std::size_t x = first; x < last; ++x)
      if (now[x] != before[x])
        for (const std::size_t p : places_[x]) changes.push_back({p, now[x] ? std::uint32_t{1} : ~std::uint32_t{0}});
  }
}

/// Sums take what becomes 1 and lose what becomes 0; numbers that are negative on the way come out right, modulo 2^32.
void BinaryConvolution::add_changes(std::size_t y) {
  std::uint32_t* sum = sums_.data() + count_[0] * y;
  for (std::size_t row = 0; row <= 2 * kernel_.reach[1]; ++row) {
    const std::uint32_t* weight = kernel_.weight.data() + row * across();
    const Span& used = used_[row];
    for (const auto& [place, sign] : changes_[node_[1][y + row]]) {
      // The weight of x is that at place - x.
      const std::size_t first = place + 1 > used.last ? place + 1 - used.last : 0;
      const std::size_t last = place < used.first ? 0 : std::min(place - used.first + 1, count_[0]);
      for (std::size_t x = first; x < last; ++x) sum[x] += sign * weight[place - x];
    }
  }
}

std::size_t BinaryConvolution::update(const std::vector<std::uint8_t>& bits) {
  const auto for_rows = [&](auto&& body) {
    parallel_for(
        count_[1],
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t y = begin; y < end; ++y) body(y);
        },
        rows_at_once);
  };
  for_rows([&](std::size_t y) { list_changes(bits, y); });
  std::size_t changed = 0;
  for (const auto& row : changes_) changed += row.size();
  bits_ = bits;
  if (changed < bits.size() / few) {
    if (changed > 0) for_rows([&](std::size_t y) { add_changes(y); });
  } else {
    for_rows([&](std::size_t y) { pack(y); });
    for_rows([&](std::size_t y) { look_up_row(y); });
  }
  return changed;
}

}  // namespace pelage
