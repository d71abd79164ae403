#include "io/off_writer.h"

#include "io/off_reader.h"
#include "io/written_meshes.h"

namespace pelage {
namespace {

TEST(OffWriter, RoundTripOfEveryBit) {
  const TriangleMesh mesh = builtin_shape("builtin:torus?n=200");
  const TriangleMesh back = test::raw_mesh(read_off(encode_off(polygons_of(mesh)), "a.off"));
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

}  // namespace
}  // namespace pelage
