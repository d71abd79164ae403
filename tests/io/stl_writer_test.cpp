#include "io/stl_writer.h"

#include <cstring>

#include "io/stl_reader.h"
#include "io/written_meshes.h"

namespace pelage {
namespace {

TEST(StlWriter, RoundTrip) {
  const TriangleMesh mesh = test::closed_mesh();
  const std::string bytes = encode_stl(mesh);
  EXPECT_EQ(bytes.size(), 84 + 50 * mesh.triangles.size());
  EXPECT_TRUE(test::same_places(mesh, test::raw_mesh(read_stl(bytes, "a.stl"))));
}

TEST(StlWriter, NormalsPointOutward) {
  const TriangleMesh mesh = test::tetrahedron();
  const std::string bytes = encode_stl(mesh);
  for (std::size_t f = 0; f < 4; ++f) {
    float v[6];
    std::memcpy(v, bytes.data() + 84 + 50 * f, sizeof v);
    EXPECT_NEAR(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 1, 1e-6);
    EXPECT_GT(v[0] * v[3] + v[1] * v[4] + v[2] * v[5], 0);  // the origin lies inside
  }
}

}  // namespace
}  // namespace pelage
