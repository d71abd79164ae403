#pragma once
// Coats that grow, as animated GLB.

#include <string>
#include <vector>

#include "io/glb_writer.h"

namespace pelage {

/// What a mesh is at a moment.
struct AnimationFrame {
  std::vector<Point> points;  ///< of its vertices
  std::vector<double> color;  ///< likewise, 3 each, linear light
};

/// A GLB file that shows the frames one after the other, `seconds` apart: the mesh as in the first one, the others as
/// morph targets of its colours (and positions, where they move) with weights that go from one to the next; with `loop`
/// back to the first one. three.js shows it; Blender 3 passes colours of targets over. Errors of encode_glb(), and
/// Error(Fault::usage) above 1 GB, for fewer than two frames, and for a mesh with opacity.
std::string encode_animated_glb(const TriangleMesh& mesh, const std::vector<AnimationFrame>& frames, double seconds,
                                bool loop, const GlbOptions& options);

}  // namespace pelage
