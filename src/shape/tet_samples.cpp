#include "shape/tet_samples.h"

#include <algorithm>
#include <cmath>

#include "base/box.h"
#include "shape/tet_quality.h"
#include "shape/vectors.h"

namespace pelage {

namespace {

constexpr double most_nodes = 67108864;  // 2^26

class Sampler {
 public:
  explicit Sampler(const TetMesh& volume) : volume_(volume) {}

  Grid sample() {
    lay_grid();
    tet_.assign(block_.nodes(), -1);
    share_.resize(block_.nodes());
    for (std::size_t t = 0; t < volume_.tets.size(); ++t) find_nodes(t);
    find_layers();
    for (const Attribute& a : volume_.attributes) block_.attributes.push_back(sampled(a));
    Attribute inside{"inside", 1, Domain::vertex, {}, NumberType::uint8};
    for (const std::int32_t t : tet_) inside.values.push_back(t >= 0 ? 1 : 0);
    block_.set(std::move(inside));
    block_.metres_per_unit = volume_.metres_per_unit;
    return std::move(block_);
  }

 private:
  using Shares = std::array<double, 4>;  ///< of the corners of a tetrahedron

  const Point& corner(std::size_t t, std::size_t k) const {
    return volume_.points[static_cast<std::size_t>(volume_.tets[t][k])];
  }

  void lay_grid() {
    const auto [low, high] = box_of(volume_.points);
    double total = 0;
    for (std::size_t t = 0; t < volume_.tets.size(); ++t)
      total += signed_volume(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3));
    double step = std::cbrt(total / static_cast<double>(volume_.nodes()));
    const Point size = difference(high, low);
    const auto cells = [&](std::size_t d) { return std::max(1.0, std::ceil(size[d] / step - 1e-9)); };
    while ((cells(0) + 1) * (cells(1) + 1) * (cells(2) + 1) > most_nodes) step *= 1.1;
    for (std::size_t d = 0; d < 3; ++d) {
      block_.count[d] = 1 + static_cast<std::int32_t>(cells(d));
      block_.origin[d] = (low[d] + high[d]) / 2 - step * cells(d) / 2;
    }
    block_.spacing = {step, step, step};
  }

  /// Takes the nodes of the grid in a tetrahedron that are in no earlier one.
  void find_nodes(std::size_t t) {
    std::array<std::int32_t, 3> first{}, last{};
    for (std::size_t d = 0; d < 3; ++d) {
      double low = corner(t, 0)[d], high = low;
      for (std::size_t k = 1; k < 4; ++k) {
        low = std::min(low, corner(t, k)[d]);
        high = std::max(high, corner(t, k)[d]);
      }
      const double step = block_.spacing[d];
      constexpr double slack = 1e-6;  // of a step, for nodes on the skin
      first[d] = std::max(0, static_cast<std::int32_t>(std::ceil((low - block_.origin[d]) / step - slack)));
      last[d] = std::min(block_.count[d] - 1,
                         static_cast<std::int32_t>(std::floor((high - block_.origin[d]) / step + slack)));
    }
    for (std::int32_t k = first[2]; k <= last[2]; ++k)
      for (std::int32_t j = first[1]; j <= last[1]; ++j)
        for (std::int32_t i = first[0]; i <= last[0]; ++i) try_node(t, block_.node(i, j, k));
  }

  void try_node(std::size_t t, std::int32_t node) {
    if (tet_[static_cast<std::size_t>(node)] >= 0) return;
    const Shares shares = shares_in({corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)}, block_.point(node));
    constexpr double slack = 1e-6;
    if (std::ranges::any_of(shares, [](double s) { return !(s >= -slack); })) return;
    tet_[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(t);
    share_[static_cast<std::size_t>(node)] = shares;
  }

  /// Calls visit(node) for the neighbours along the axes.
  template <class Visit>
  void for_neighbours(std::int32_t node, Visit&& visit) const {
    std::int32_t stride = 1;
    for (const std::int32_t n : block_.count) {
      const std::int32_t at = node / stride % n;
      if (at > 0) visit(node - stride);
      if (at + 1 < n) visit(node + stride);
      stride *= n;
    }
  }

  /// The nodes outside in the order of their distance, counted in neighbours.
  void find_layers() {
    layer_.assign(block_.nodes(), 0);
    std::vector<std::int32_t> now;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(block_.nodes()); ++v)
      if (tet_[static_cast<std::size_t>(v)] >= 0) {
        layer_[static_cast<std::size_t>(v)] = 1;
        now.push_back(v);
      }
    for (std::int32_t layer = 2; !now.empty(); ++layer) {
      std::vector<std::int32_t> next;
      for (const std::int32_t v : now)
        for_neighbours(v, [&](std::int32_t other) {
          if (layer_[static_cast<std::size_t>(other)] != 0) return;
          layer_[static_cast<std::size_t>(other)] = layer;
          next.push_back(other);
        });
      outside_.insert(outside_.end(), next.begin(), next.end());
      now = std::move(next);
    }
  }

  Attribute sampled(const Attribute& a) const {
    const auto n = static_cast<std::size_t>(a.components);
    const bool blends = a.labels.empty() && (!is_integer(a.type) || is_color(a));
    Attribute result{a.name, a.components, Domain::vertex, std::vector<double>(n * block_.nodes()), a.type, a.labels};
    for (std::size_t v = 0; v < block_.nodes(); ++v) {
      if (tet_[v] < 0) continue;
      Shares shares = share_[v];
      if (!blends) shares = only_largest(shares);
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto from = static_cast<std::size_t>(volume_.tets[static_cast<std::size_t>(tet_[v])][corner]);
        for (std::size_t k = 0; k < n; ++k) result.values[n * v + k] += shares[corner] * a.values[n * from + k];
      }
    }
    for (const std::int32_t v : outside_) fill(result, n, v, blends);
    if (result.type == NumberType::float32)
      for (double& x : result.values) x = static_cast<float>(x);
    return result;
  }

  static Shares only_largest(const Shares& shares) {
    Shares one{};
    one[static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin())] = 1;
    return one;
  }

  /// From the neighbours that lie nearer to the volume: their mean, or what the first of them has.
  void fill(Attribute& a, std::size_t n, std::int32_t v, bool blends) const {
    const auto here = static_cast<std::size_t>(v);
    double count = 0;
    for_neighbours(v, [&](std::int32_t neighbour) {
      const auto other = static_cast<std::size_t>(neighbour);
      if (layer_[other] >= layer_[here] || (!blends && count > 0)) return;
      for (std::size_t k = 0; k < n; ++k) a.values[n * here + k] += a.values[n * other + k];
      ++count;
    });
    for (std::size_t k = 0; k < n; ++k) a.values[n * here + k] /= count;
  }

  const TetMesh& volume_;
  Grid block_;
  std::vector<std::int32_t> tet_;  ///< of every node of the grid; -1 outside
  std::vector<Shares> share_;
  std::vector<std::int32_t> layer_;  ///< 1 inside
  std::vector<std::int32_t> outside_;
};

}  // namespace

Grid sampled(const TetMesh& volume) { return Sampler(volume).sample(); }

}  // namespace pelage
