#pragma once
// The bridge between coefficients and samples. Reactions, masks, initial states and colours act on samples, the values
// of the fields at places on the surface; steppers solve for coefficients.
//
//   samples = values * coefficients,   M = test W values,   load(f) = test W f
//
// with test = values' but for the half-consistent mass, where samples are coefficients and test = M W^-1.

#include "discretise/assembly.h"
#include "discretise/quadrature.h"

namespace pelage {

/// Where samples lie: at the (limit) positions of the vertices, or at the quadrature points of the elements.
enum class SampleRule { vertices, quadrature };

/// On an even grid whose matrices nobody needs, values and test have no pattern: the unknowns are the samples.
struct Sampling {
  SparseMatrix values;  ///< samples x unknowns
  SparseMatrix test;    ///< unknowns x samples
  Vector weight;        ///< area of each sample, positive
  std::vector<Point> position;

  Eigen::Index count() const { return weight.size(); }
};

/// Samples at the limit positions of the vertices, with the weights w = A^-T (M 1), A = values, that make the
/// quadrature exact for every basis function: as accurate as the consistent mass to less than a percent at ten edges
/// per wavelength, and several times cheaper. Weights that come out below a tenth of the vertex' share of the area
/// (some are negative on uneven meshes) are raised to it, and all are scaled to keep the total area.
Sampling vertex_sampling(const Discretisation& discretisation, const std::vector<Point>& control,
                         const SparseMatrix& mass);
/// The same from what is known already: `test`, the transpose of discretisation.values, and the area of every element.
Sampling vertex_sampling(const Discretisation& discretisation, const std::vector<Point>& control,
                         const SparseMatrix& mass, SparseMatrix test, const std::vector<double>& area);

/// Linear elements with the mass matrix M = (1 - share) L + share C, where C is the consistent one and L its row sums,
/// at the vertices. With a share of 1/2 the errors of the two cancel on even meshes: waves keep their speed to the
/// fourth order of the edge. Reactions stay nodal: load(f) = M f. Where vertices have far less mass for their stiffness
/// than nearly all others (short edges, small valences) it is raised, because these few would set the largest
/// eigenvalue of all.
Sampling blended_sampling(const Discretisation& linear, const std::vector<Point>& points,
                          const SparseMatrix& consistent, const SparseMatrix& stiffness, double share);

/// Samples at the quadrature points, the reference.
Sampling quadrature_sampling(const Discretisation& discretisation, const std::vector<Point>& control);

/// test W values in a pattern that contains it; `weight` stands for W.
SparseMatrix sampled_mass(const Sampling& sampling, const Vector& weight,
                          const std::shared_ptr<const SparsePattern>& pattern);

/// test (W f).
Vector load(const Sampling& sampling, const Vector& f);

/// Whether the unknowns are the samples: values = 1, and so M = test W.
bool unknowns_are_samples(const Sampling& sampling);

/// Coefficients whose samples are nearest to the given ones in the weighted mean square (equal at vertex sampling).
Vector coefficients_from_samples(const Sampling& sampling, const SparseMatrix& mass, const Vector& samples);

/// Control points whose limit positions are the given ones.
std::vector<Point> interpolating_control(const Discretisation& discretisation, const std::vector<Point>& positions);

/// Limit positions and unit normals at the vertices.
std::vector<Point> limit_positions(const Discretisation& discretisation, const std::vector<Point>& control);
std::vector<Point> limit_normals(const Discretisation& discretisation, const std::vector<Point>& control);

}  // namespace pelage
