// A coat in numbers.
#include <pelage/grow.h>
#include <pelage/io.h>
#include <pelage/measure.h>

#include <iostream>

int main() try {
  const pelage::TriangleMesh shape = pelage::load_shape("builtin:sphere?n=642");
  const pelage::TriangleMesh coat =
      pelage::grow(shape, pelage::parse_recipe("[stage]\nmodel = \"turing\"\nsize = 0.3\n", "example"));
  pelage::ShapeFile file;
  file.mesh = coat;
  const pelage::PatternMeasures m = pelage::measure(file, "b");
  std::cout << m.spots.count << " spots, " << m.spacing << " apart, on " << 100 * m.below.share << " % of the area\n";
  return m.spots.count > 5 ? 0 : 1;
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
