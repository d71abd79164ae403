#include "solid/pinches.h"

#include <algorithm>
#include <map>
#include <unordered_set>

namespace pelage {

namespace {

using Tet = std::array<std::int64_t, 4>;
using Edge = std::array<std::int64_t, 2>;
using Face = std::array<std::int64_t, 3>;

Face face_of(const Tet& t, std::size_t opposite) {
  Face face;
  for (std::size_t c = 0, k = 0; c < 4; ++c)
    if (c != opposite) face[k++] = t[c];
  std::ranges::sort(face);
  return face;
}

class PinchRemover {
 public:
  PinchRemover(std::vector<Tet>& tets, const std::function<bool(std::int64_t)>& may_be_skin,
               const std::function<double(const Tet&)>& volume)
      : tets_(tets), may_be_skin_(may_be_skin), volume_(volume), gone_(tets.size()) {}

  std::size_t remove() {
    std::size_t removed = 0;
    while (true) {
      find_near();
      const std::vector<Edge> pinched = pinched_edges();
      if (pinched.empty()) break;
      for (const auto& [edge, around] : tets_around(pinched)) removed += keep_largest(edge, around);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (!gone_[t]) tets_[kept++] = tets_[t];
    tets_.resize(kept);
    return removed;
  }

 private:
  void find_near() {
    near_.clear();
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (!gone_[t] && std::ranges::count_if(tets_[t], [&](auto n) { return is_outer(n); }) >= 2) near_.push_back(t);
  }
  bool is_outer(std::int64_t node) const { return may_be_skin_(node) || bared_.contains(node); }

  /// Faces of one tetrahedron alone.
  std::vector<Face> skin() const {
    std::vector<Face> faces, alone;
    for (const std::size_t t : near_)
      for (std::size_t c = 0; c < 4; ++c)
        if (const Face f = face_of(tets_[t], c); std::ranges::all_of(f, [&](auto n) { return is_outer(n); }))
          faces.push_back(f);
    std::ranges::sort(faces);
    for (std::size_t k = 0; k < faces.size(); ++k)
      if ((k == 0 || faces[k - 1] != faces[k]) && (k + 1 == faces.size() || faces[k + 1] != faces[k]))
        alone.push_back(faces[k]);
    return alone;
  }

  std::vector<Edge> pinched_edges() const {
    std::vector<Edge> edges, pinched;
    for (const auto& [a, b, c] : skin()) edges.insert(edges.end(), {{a, b}, {a, c}, {b, c}});
    std::ranges::sort(edges);
    for (std::size_t k = 2; k < edges.size(); ++k)
      if (edges[k] == edges[k - 2] && (pinched.empty() || pinched.back() != edges[k])) pinched.push_back(edges[k]);
    return pinched;
  }

  std::map<Edge, std::vector<std::size_t>> tets_around(const std::vector<Edge>& edges) const {
    std::map<Edge, std::vector<std::size_t>> around;
    for (const std::size_t t : near_)
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t d = 0; d < c; ++d) {
          const Edge edge = {std::min(tets_[t][c], tets_[t][d]), std::max(tets_[t][c], tets_[t][d])};
          if (std::ranges::binary_search(edges, edge)) around[edge].push_back(t);
        }
    return around;
  }

  /// Of the parts around an edge.
  std::size_t keep_largest(const Edge& edge, const std::vector<std::size_t>& around) {
    std::vector<std::vector<std::size_t>> parts = parts_around(edge, around);
    const auto size = [&](const std::vector<std::size_t>& part) {
      double sum = 0;
      for (const std::size_t t : part) sum += volume_(tets_[t]);
      return sum;
    };
    const auto largest = std::ranges::max_element(parts, {}, size);
    std::size_t removed = 0;
    for (auto part = parts.begin(); part != parts.end(); ++part) {
      if (part == largest) continue;
      for (const std::size_t t : *part) {
        gone_[t] = 1;
        bared_.insert(tets_[t].begin(), tets_[t].end());
      }
      removed += part->size();
    }
    return removed;
  }

  /// Tetrahedra with a face at the edge in common, by the third nodes of these.
  std::vector<std::vector<std::size_t>> parts_around(const Edge& edge, std::vector<std::size_t> around) const {
    std::erase_if(around, [&](std::size_t t) { return gone_[t] != 0; });
    const auto touches = [&](std::size_t a, std::size_t b) {
      return std::ranges::any_of(tets_[a], [&](std::int64_t n) {
        return n != edge[0] && n != edge[1] && std::ranges::count(tets_[b], n) > 0;
      });
    };
    std::vector<std::vector<std::size_t>> parts;
    while (!around.empty()) {
      std::vector<std::size_t>& part = parts.emplace_back(1, around.back());
      around.pop_back();
      for (std::size_t k = 0; k < part.size(); ++k)
        for (std::size_t i = around.size(); i-- > 0;)
          if (touches(part[k], around[i])) {
            part.push_back(around[i]);
            around.erase(around.begin() + static_cast<std::ptrdiff_t>(i));
          }
    }
    return parts;
  }

  std::vector<Tet>& tets_;
  const std::function<bool(std::int64_t)>& may_be_skin_;
  const std::function<double(const Tet&)>& volume_;
  std::vector<char> gone_;
  std::vector<std::size_t> near_;           ///< those with an edge that may be one of the skin
  std::unordered_set<std::int64_t> bared_;  ///< nodes of those that are gone
};

}  // namespace

std::size_t remove_pinches(std::vector<Tet>& tets, const std::function<bool(std::int64_t)>& may_be_skin,
                           const std::function<double(const Tet&)>& volume) {
  return PinchRemover(tets, may_be_skin, volume).remove();
}

}  // namespace pelage
