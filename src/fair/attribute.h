#pragma once
// Smoothing of functions on a surface that stays where it is: colours of a scan, or any other vertex attribute.

#include <optional>
#include <string>
#include <vector>

#include "pelage/progress.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

struct AttributeOptions {
  std::string method = "anisotropic";  ///< see attribute_methods()
  std::optional<double> noise = {};    ///< standard deviation, in the attribute's unit; default: estimated
  std::optional<int> steps = {};       ///< exactly so many; default: until as much has changed as the noise amounts to
  double tau = 0.1;                    ///< time of a step, in squared mean edges
};

struct AttributeReport {
  double noise = 0;  ///< that was assumed: root mean square over the components, in the attribute's unit
  int steps = 0;
  double changed = 0;   ///< root mean square over vertices and components, in the attribute's unit
  double contrast = 0;  ///< anisotropic: slope beyond which the last step throttled diffusion, unit per mean edge
};

struct SmoothedAttribute {
  TriangleMesh mesh;  ///< the same but for the attribute
  AttributeReport report;
};

/// Methods: "anisotropic" (edges of the function stay: the default), "isotropic" (heat flow) and "paper" (across edges
/// of the surface values hardly mix).
const std::vector<std::string>& attribute_methods();

/// Diffuses all components of a vertex attribute f together, in implicit steps with linear elements on the triangles:
///   (M + tau K(D)) f^(n+1) = M f^n.
/// "anisotropic" takes D = sum of g(s_i) e_i e_i' from the eigenvectors e_i of the structure tensor
/// sum_c grad f_c grad f_c' (Di Zenzo 1986) with eigenvalues s_i^2, of the function after one isotropic step: edge-
/// enhancing diffusion (Weickert 1998) with the g of eq. (20) of Bajaj, Zhang, Xu 2008. The contrast follows the median
/// slope. "paper" takes eq. (21) of that paper for f on the Loop limit surface, with the tensor of its curvatures.
/// Values stay within the range that each component has at the start. Error(Fault::usage) for an unknown
/// attribute or method, for one that is not at the vertices, for "normal", and for options out of range;
/// Error(Fault::input) for meshes that are not manifold; Error(Fault::cancelled).
SmoothedAttribute smooth_attribute(const TriangleMesh& mesh, const std::string& name,
                                   const AttributeOptions& options = {}, const Progress& progress = {});

}  // namespace pelage
