#pragma once
// Diffusion tensors on a surface from a direction field and rates along and across it (Witkin, Kass 1991, section 4; on
// a surface in the conservative form div(T grad u)).

#include "discretise/assembly.h"
#include "discretise/quadrature.h"
#include "react/kinetics.h"

namespace pelage {

Eigen::Matrix3d matrix_of(const Tensor& tensor);

/// d d', by which a line of either sense is known.
Tensor line_tensor(const Point& d);

/// 1 - d d', by which the plane across a line is known.
Tensor plane_tensor(const Point& d);

/// T = a1^2 d d' + a2^2 e e' on a surface with this normal: d is the tangent line nearest to a mean of lines, turned by
/// theta counter-clockwise seen from outside, and e is across it.
Tensor surface_tensor(const Tensor& mean_of_lines, const Point& normal, double theta, double a1, double a2);

/// T = a1^2 P + a2^2 (1 - P) in a volume, where P projects onto the line, or the plane, nearest to a mean of such: its
/// trace tells which.
Tensor volume_tensor(const Tensor& mean, double a1, double a2);
/// There the rates have no other angle than 0: Error(Fault::usage).
void require_unturned(const Kinetics::TensorField& rates);

/// T = a1^2 d d' + a2^2 n n' at the quadrature points, with d at the angle theta from the field, counter-clockwise seen
/// from outside. `lines`: at the vertices of the discretisation; `rates`: at its quadrature points.
std::vector<Tensor> quadrature_tensors(const Discretisation& discretisation, const std::vector<Point>& control,
                                       const std::vector<Tensor>& lines, const Kinetics::TensorField& rates);

/// Largest ratio of a1 and a2, taken either way; infinite where one of them is 0 and the other is not.
double largest_ratio(const Kinetics::TensorField& rates);

/// The same of tensors, whose rates are the roots of their eigenvalues: in the planes across the normals, or in space
/// where these are 0.
double largest_ratio(const std::vector<Tensor>& tensors, const std::vector<Point>& normals);

}  // namespace pelage
