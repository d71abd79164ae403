#pragma once
// Where triangles that need not fit together meet: at edges, and over cracks and T-junctions.

#include <cstdint>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

struct SoupContact {
  std::int32_t other;  ///< the triangle that another one meets
  double length;       ///< of what they share, less than 0 where they disagree which side is up [world units]
};

struct SoupContacts {
  std::vector<std::vector<SoupContact>> of;  ///< per triangle
  std::vector<std::int32_t> open;            ///< half-edges 3*f+k along most of which nothing goes on
};

/// At edges of exactly two triangles, and where open edges run along each other within 2 % of their length.
SoupContacts soup_contacts(const TriangleMesh& mesh);

}  // namespace pelage
