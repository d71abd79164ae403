#include "discretise/surface_evaluator.h"

#include <Eigen/Geometry>

#include "discretise/metric.h"
#include "shape/refine.h"

namespace pelage {

namespace {

Eigen::Vector3d combined(const ElementPoint& e, Eigen::Index row, const std::vector<Point>& control) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < e.function.size(); ++i)
    sum += e.jet(row, static_cast<Eigen::Index>(i)) *
           Eigen::Map<const Eigen::Vector3d>(control[static_cast<std::size_t>(e.function[i])].data());
  return sum;
}

double combined(const ElementPoint& e, Eigen::Index row, const std::vector<double>& coefficients) {
  double sum = 0;
  for (std::size_t i = 0; i < e.function.size(); ++i)
    sum += e.jet(row, static_cast<Eigen::Index>(i)) * coefficients[static_cast<std::size_t>(e.function[i])];
  return sum;
}

Point point(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

}  // namespace

SurfaceEvaluator::SurfaceEvaluator(std::shared_ptr<const Space> space, int levels,
                                   std::vector<std::vector<double>> coefficients)
    : space_(std::move(space)), levels_(levels), coefficients_(std::move(coefficients)) {}

SurfaceSample SurfaceEvaluator::at(Index face, double v, double w) const {
  MeshPlace p{face, v, w};
  for (int level = 0; level < levels_; ++level) p = in_child(p);
  const ElementPoint e = space_->element_point(p.face, p.v, p.w);
  const std::vector<Point>& control = space_->control();
  const Metric m = metric(combined(e, 1, control), combined(e, 2, control));
  const Eigen::Vector3d across = m.xv.cross(m.xw);
  SurfaceSample sample;
  sample.position = point(combined(e, 0, control));
  if (m.area > 0) sample.normal = point(across / across.norm());
  const Form inverse = gradient_form(m, m.area > 0 ? 1 / m.area : 0);  // G^-1
  for (const std::vector<double>& field : coefficients_) {
    const double fv = combined(e, 1, field), fw = combined(e, 2, field);
    sample.values.push_back(combined(e, 0, field));
    sample.gradients.push_back(
        point((inverse.vv * fv + inverse.vw * fw) * m.xv + (inverse.vw * fv + inverse.ww * fw) * m.xw));
  }
  return sample;
}

}  // namespace pelage
