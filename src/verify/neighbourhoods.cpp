#include "verify/neighbourhoods.h"

namespace pelage {

Neighbourhood closed_neighbourhood(const std::array<Index, 3>& valence) {
  std::vector<Triangle> t = {{0, 1, 2}};
  const std::array<Index, 3> across = {3, 4, 5};  // across the edge from corner i to corner i + 1
  Index next = 6;
  for (std::size_t i = 0; i < 3; ++i) t.push_back({static_cast<Index>((i + 1) % 3), static_cast<Index>(i), across[i]});
  for (std::size_t i = 0; i < 3; ++i) {  // the rest of the fan of corner i
    Index from = across[(i + 2) % 3];
    for (Index k = 0; k < valence[i] - 5; ++k) {
      t.push_back({static_cast<Index>(i), from, next});
      from = next++;
    }
    t.push_back({static_cast<Index>(i), from, across[i]});
  }
  return {make_topology(static_cast<std::size_t>(next), std::move(t)), 0};
}

Neighbourhood valence_three_neighbourhood() {
  return {make_topology(
              7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 4, 2}, {2, 5, 3}, {3, 6, 1}, {1, 6, 4}, {2, 4, 5}, {3, 5, 6}}),
          0};
}

Neighbourhood boundary_neighbourhood(Index triangles, Index position) {
  std::vector<Triangle> t;
  for (Index k = 0; k < triangles; ++k) t.push_back({0, 1 + k, 2 + k});
  const Index second_row = triangles + 2;
  for (Index k = 0; k < triangles; ++k) {
    t.push_back({1 + k, second_row + k, 2 + k});
    if (k > 0) t.push_back({1 + k, second_row + k - 1, second_row + k});
  }
  return {make_topology(static_cast<std::size_t>(second_row + triangles), std::move(t)), position};
}

std::vector<Neighbourhood> one_extraordinary_corner() {
  std::vector<Neighbourhood> cases = {valence_three_neighbourhood()};
  for (Index n = 4; n <= 12; ++n) cases.push_back(closed_neighbourhood({n, 6, 6}));
  return cases;
}

std::vector<Neighbourhood> several_extraordinary_corners() {
  std::vector<Neighbourhood> cases = {{make_topology(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}), 0}};
  for (const std::array<Index, 3>& v :
       {std::array<Index, 3>{5, 7, 6}, {6, 4, 9}, {12, 5, 4}, {7, 8, 5}, {4, 5, 7}, {5, 5, 5}})
    cases.push_back(closed_neighbourhood(v));
  return cases;
}

std::vector<Neighbourhood> boundary_corners() {
  std::vector<Neighbourhood> cases;
  for (Index triangles = 1; triangles <= 8; ++triangles)
    for (Index position = 0; position < triangles; ++position)
      cases.push_back(boundary_neighbourhood(triangles, position));
  return cases;
}

std::vector<Neighbourhood> all_neighbourhoods() {
  std::vector<Neighbourhood> all;
  for (const auto& part : {one_extraordinary_corner(), several_extraordinary_corners(), boundary_corners()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace pelage
