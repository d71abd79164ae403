// Takes the noise off a mesh, and says how much of it there was.
#include <pelage/fair.h>
#include <pelage/io.h>

#include <iostream>

int main() try {
  pelage::TriangleMesh scan = pelage::load_shape("builtin:sphere?n=642");
  for (std::size_t v = 0; v < scan.points.size(); ++v)  // a noisy scan
    for (double& x : scan.points[v]) x *= 1 + 0.01 * static_cast<double>(v % 7) / 7;

  pelage::FairOptions options;
  options.method = "guided";  // edges and details stay
  const pelage::Faired faired = pelage::fair(scan, options);
  std::cout << "noise of " << faired.report.noise << " mean edges, taken off in " << faired.report.steps << " steps\n";
  pelage::save(faired.mesh, "smooth.ply");
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
