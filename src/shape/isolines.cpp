#include "shape/isolines.h"

#include <algorithm>
#include <map>

#include "shape/edges.h"

namespace pelage {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// One cutting of a part.
class Cutter {
 public:
  Cutter(const SurfacePart& of, std::span<const char> inside, const Crossing& crossing, std::uint8_t mark)
      : of_(of), inside_(inside), crossing_(crossing), mark_(mark), number_(inside.size(), -1) {
    for (std::size_t v = 0; v < inside.size(); ++v)
      if (inside[v]) keep(static_cast<std::int32_t>(v));
  }

  SurfacePart make() {
    for (std::size_t f = 0; f < of_.triangles.size(); ++f) cut(f);
    return std::move(part_);
  }

 private:
  void keep(std::int32_t v) {
    number_[at(v)] = static_cast<std::int32_t>(part_.vertices.size());
    part_.vertices.push_back({v, v, 0});
  }

  std::int32_t crossed(std::int32_t in, std::int32_t out) {
    const auto [found, is_new] =
        on_edge_.try_emplace(std::minmax(in, out), static_cast<std::int32_t>(part_.vertices.size()));
    if (is_new) part_.vertices.push_back({in, out, std::clamp(crossing_(in, out), 0.0, 1.0)});
    return found->second;
  }

  void add(std::size_t f, const Triangle& corners, const std::array<std::uint8_t, 3>& border) {
    part_.triangles.push_back(corners);
    part_.border.push_back(border);
    part_.face.push_back(of_.face[f]);
  }

  void cut(std::size_t f) {
    const Triangle& t = of_.triangles[f];
    const auto in = [&](std::size_t k) { return inside_[at(t[k])] != 0; };
    const int count = in(0) + in(1) + in(2);
    if (count == 0) return;
    if (count == 3) return add(f, {number_[at(t[0])], number_[at(t[1])], number_[at(t[2])]}, of_.border[f]);
    std::size_t alone = 0;
    while (in(alone) != (count == 1)) ++alone;
    const std::size_t next = (alone + 1) % 3, last = (alone + 2) % 3;
    const auto& border = of_.border[f];
    if (count == 1) {
      const std::int32_t p = crossed(t[alone], t[next]), q = crossed(t[alone], t[last]);
      return add(f, {number_[at(t[alone])], p, q}, {border[alone], mark_, border[last]});
    }
    const std::int32_t p = crossed(t[next], t[alone]), q = crossed(t[last], t[alone]);
    const std::int32_t b = number_[at(t[next])], c = number_[at(t[last])];
    add(f, {p, b, c}, {border[alone], border[next], 0});
    add(f, {p, c, q}, {0, border[last], mark_});
  }

  const SurfacePart& of_;
  std::span<const char> inside_;
  const Crossing& crossing_;
  std::uint8_t mark_;
  std::vector<std::int32_t> number_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> on_edge_;
  SurfacePart part_;
};

/// Directed edges, found by where they begin.
class Links {
 public:
  Links(const SurfacePart& part, const std::function<bool(std::uint8_t)>& wanted) {
    for (std::size_t f = 0; f < part.triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (part.border[f][k] != 0 && wanted(part.border[f][k]))
          edges_.push_back({part.triangles[f][k], part.triangles[f][(k + 1) % 3]});
    std::ranges::stable_sort(edges_, {}, &Edge::from);
    first_.assign(part.vertices.size() + 1, 0);
    arriving_.assign(part.vertices.size(), 0);
    for (const Edge& e : edges_) {
      ++first_[at(e.from) + 1];
      ++arriving_[at(e.to)];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    used_.assign(edges_.size(), 0);
  }

  /// Chains that begin somewhere, then those that go round.
  std::vector<Chain> chains() {
    std::vector<Chain> all;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::size_t from = at(edges_[e].from);
      if (!used_[e] && first_[from + 1] - first_[from] > arriving_[from]) all.push_back(follow(e));
    }
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (!used_[e]) all.push_back(follow(e));
    return all;
  }

 private:
  struct Edge {
    std::int32_t from, to;
  };

  Chain follow(std::size_t e) {
    const std::int32_t start = edges_[e].from;
    Chain chain{{start}, false};
    while (true) {
      used_[e] = 1;
      const std::int32_t v = edges_[e].to;
      if (v == start) {
        chain.closed = true;
        return chain;
      }
      chain.vertices.push_back(v);
      e = first_[at(v)];
      while (e < first_[at(v) + 1] && used_[e]) ++e;
      if (e == first_[at(v) + 1]) return chain;
    }
  }

  std::vector<Edge> edges_;
  std::vector<std::size_t> first_, arriving_;
  std::vector<char> used_;
};

}  // namespace

double between(double a, double b, double t) { return (1 - t) * a + t * b; }

Point between(const Point& a, const Point& b, double t) {
  return {between(a[0], b[0], t), between(a[1], b[1], t), between(a[2], b[2], t)};
}

SurfacePart whole_surface(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  SurfacePart part{triangles, std::vector<std::array<std::uint8_t, 3>>(triangles.size()), {}, {}};
  for (std::size_t f = 0; f < triangles.size(); ++f) part.face.push_back(static_cast<std::int32_t>(f));
  for (std::size_t v = 0; v < vertex_count; ++v)
    part.vertices.push_back({static_cast<std::int32_t>(v), static_cast<std::int32_t>(v), 0});
  const EdgeTable edges(triangles, vertex_count);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() == 1) part.border[at(edges[e][0] / 3)][at(edges[e][0] % 3)] = own_border;
  return part;
}

SurfacePart part_inside(const SurfacePart& of, std::span<const char> inside, const Crossing& crossing,
                        std::uint8_t mark) {
  return Cutter(of, inside, crossing, mark).make();
}

SurfacePart part_above(const SurfacePart& of, std::span<const double> values, std::uint8_t mark) {
  std::vector<char> inside(values.size());
  for (std::size_t v = 0; v < values.size(); ++v) inside[v] = values[v] > 0;
  const Crossing linear = [&](std::int32_t in, std::int32_t out) {
    return values[at(in)] / (values[at(in)] - values[at(out)]);
  };
  return part_inside(of, inside, linear, mark);
}

std::vector<Chain> border_chains(const SurfacePart& part, const std::function<bool(std::uint8_t)>& wanted) {
  return Links(part, wanted).chains();
}

}  // namespace pelage
