#include "shape/drop_faces.h"

#include <algorithm>
#include <array>
#include <string>

namespace pelage {

namespace {

/// Removes the triangles without keep[f] and reports them.
void drop(NumberedMesh& work, const std::vector<char>& keep, const char* kind, const std::string& what,
          std::vector<Finding>& findings) {
  const auto first = std::find(keep.begin(), keep.end(), 0);
  if (first == keep.end()) return;
  const auto count = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 0));
  const std::size_t face = work.face_number[first - keep.begin()];
  findings.push_back({kind,
                      counted(count, "face") + " " + what + " (first: face " + std::to_string(face) + "); removed",
                      count, face, true});
  keep_faces(work, keep);
}

}  // namespace

void drop_collapsed_faces(NumberedMesh& work, std::vector<Finding>& findings) {
  const std::vector<Point>& p = work.mesh.points;
  std::vector<char> keep;
  keep.reserve(work.mesh.triangles.size());
  for (const auto& [a, b, c] : work.mesh.triangles) keep.push_back(p[a] != p[b] && p[b] != p[c] && p[c] != p[a]);
  drop(work, keep, "degenerate-faces", "with two corners in the same place", findings);
}

void drop_duplicate_faces(NumberedMesh& work, const std::vector<std::int32_t>& place, std::vector<Finding>& findings) {
  struct Key {
    std::int32_t middle, largest, face;
    auto operator<=>(const Key&) const = default;
  };
  const std::vector<Triangle>& triangles = work.mesh.triangles;
  auto sorted_places = [&](std::size_t f) {
    const auto& [a, b, c] = triangles[f];
    std::array<std::int32_t, 3> t = {place[a], place[b], place[c]};
    std::sort(t.begin(), t.end());
    return t;
  };
  // Counting sort by the smallest place, then each small group by the other two and the face.
  std::vector<std::size_t> end(place.size() + 1, 0);
  for (std::size_t f = 0; f < triangles.size(); ++f) ++end[sorted_places(f)[0] + 1];
  for (std::size_t v = 0; v < place.size(); ++v) end[v + 1] += end[v];
  std::vector<Key> keys(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const auto t = sorted_places(f);
    keys[end[t[0]]++] = {t[1], t[2], static_cast<std::int32_t>(f)};
  }
  std::vector<char> keep(triangles.size(), 1);
  std::size_t begin = 0;
  for (std::size_t v = 0; v < place.size(); begin = end[v++]) {
    std::sort(keys.begin() + static_cast<std::ptrdiff_t>(begin), keys.begin() + static_cast<std::ptrdiff_t>(end[v]));
    for (std::size_t i = begin + 1; i < end[v]; ++i)
      if (keys[i].middle == keys[i - 1].middle && keys[i].largest == keys[i - 1].largest) keep[keys[i].face] = 0;
  }
  drop(work, keep, "duplicate-faces", "with the same three corners as an earlier one", findings);
}

}  // namespace pelage
