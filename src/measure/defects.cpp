#include "measure/defects.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace pelage {

namespace {

using std::numbers::pi;
using Vector3 = Eigen::Vector3d;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A vertex with axes in its tangent plane, and the angle of its line between them.
struct Frame {
  Vector3 normal, x, y;
  double angle;
};

Frame frame_of(const Eigen::Matrix3d& tensor, const Vector3& along_normal) {
  Frame f;
  f.normal = along_normal.squaredNorm() > 0 ? along_normal.normalized().eval() : Vector3::UnitZ().eval();
  f.x = f.normal.unitOrthogonal();
  f.y = f.normal.cross(f.x);
  Eigen::Matrix<double, 3, 2> axes;
  axes << f.x, f.y;
  const Eigen::Matrix2d t = axes.transpose() * tensor * axes;
  f.angle = std::atan2(2 * t(0, 1), t(0, 0) - t(1, 1)) / 2;
  return f;
}

/// By how much the axes of b are turned against those of a that are carried over.
double transport(const Frame& a, const Frame& b) {
  const Vector3 x = Eigen::Quaterniond::FromTwoVectors(a.normal, b.normal) * a.x;
  return std::atan2(x.dot(b.y), x.dot(b.x));
}

double wrapped(double angle, double period) { return angle - period * std::round(angle / period); }

}  // namespace

std::vector<int> half_turns(const TriangleMesh& mesh, const std::vector<Eigen::Matrix3d>& tensors,
                            const std::vector<Eigen::Vector3d>& normals) {
  std::vector<Frame> frames;
  for (std::size_t v = 0; v < tensors.size(); ++v) frames.push_back(frame_of(tensors[v], normals[v]));
  std::vector<int> turns;
  for (const Triangle& t : mesh.triangles) {
    double lines = 0, curvature = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      // From the smaller to the larger number, so that both triangles at an edge see the same turn.
      const std::int32_t v = t[k], w = t[(k + 1) % 3];
      const double sign = v < w ? 1 : -1;
      const Frame &a = frames[at(std::min(v, w))], &b = frames[at(std::max(v, w))];
      const double carried = transport(a, b);
      curvature += sign * carried;
      lines += sign * wrapped(b.angle - a.angle - carried, pi);
    }
    turns.push_back(static_cast<int>(std::lround((lines + wrapped(curvature, 2 * pi)) / pi)));
  }
  return turns;
}

}  // namespace pelage
