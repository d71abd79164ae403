#include "fair/attribute.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/parallel.h"
#include "base/quantile.h"
#include "base/suggest.h"
#include "discretise/assembly.h"
#include "discretise/quadrature.h"
#include "fair/boundary.h"
#include "fair/diffusivity.h"
#include "fair/faces.h"
#include "fair/noise.h"
#include "fair/paper.h"
#include "linalg/conjugate_gradient.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// As in fairing: what has changed is a little less than the noise, the estimate a little more.
constexpr double noise_share = 0.95;
/// Beyond this only large shapes of the function go on flattening.
constexpr int most_steps = 100;
/// Time of the step before slopes are taken, in squared mean edges: a Gaussian of one edge.
constexpr double time_before_slopes = 0.5;
/// The contrast in medians of the slope: above the slopes of what noise is left, below those of edges.
constexpr double contrast_factor = 2.5;
/// On a function that is flat but for its edges the median vanishes; slopes are compared to this share of the largest.
constexpr double least_contrast = 1e-3;

using Field = std::vector<Vector>;  ///< per component, values at the vertices

const Attribute& find_attribute(const TriangleMesh& mesh, const std::string& name) {
  std::vector<std::string> names;
  for (const Attribute& a : mesh.attributes) names.push_back(a.name);
  if (names.empty()) throw Error(Fault::usage, "the mesh has no attributes to smooth");
  const std::string* known = matching_name(name, names);
  if (!known) throw Error(Fault::usage, unknown_name("attribute", name, names));
  const Attribute* found = mesh.find(*known);
  if (name == "normal") throw Error(Fault::usage, "normals follow from the vertices; fair the mesh itself");
  if (found->domain != Domain::vertex)
    throw Error(Fault::usage, "the attribute \"" + name + "\" sits at the " +
                                  (found->domain == Domain::corner ? "corners of triangles" : "triangles") +
                                  ", not at the vertices");
  return *found;
}

void check(const AttributeOptions& o) {
  const auto& known = attribute_methods();
  if (std::find(known.begin(), known.end(), o.method) == known.end())
    throw Error(Fault::usage, unknown_name("method", o.method, known));
  if (o.noise && !(*o.noise >= 0 && std::isfinite(*o.noise)))
    throw Error(Fault::usage, "noise " + number(*o.noise) + " is out of range; it is at least 0");
  if (o.steps && !(*o.steps >= 0 && *o.steps <= 1000))
    throw Error(Fault::usage, "steps " + number(*o.steps) + " is out of range; it lies between 0 and 1000");
  if (!(o.tau >= 1e-6 && o.tau <= 100))
    throw Error(Fault::usage, "tau " + number(o.tau) + " is out of range; it lies between 1e-06 and 100");
}

Field components_of(const Attribute& a) {
  Field field(static_cast<std::size_t>(a.components), Vector(std::ssize(a.values) / a.components));
  for (std::size_t c = 0; c < field.size(); ++c)
    for (Eigen::Index v = 0; v < field[c].size(); ++v)
      field[c][v] = a.values[static_cast<std::size_t>(v) * field.size() + c];
  return field;
}

std::vector<double> interleaved(const Field& field) {
  std::vector<double> values;
  for (Eigen::Index v = 0; v < field[0].size(); ++v)
    for (const Vector& component : field) values.push_back(component[v]);
  return values;
}

double root_mean_square(const std::vector<double>& of_components) {
  double sum = 0;
  for (double x : of_components) sum += x * x;
  return std::sqrt(sum / static_cast<double>(of_components.size()));
}

class Diffusion {
 public:
  Diffusion(const TriangleMesh& mesh, Topology topology)
      : points_(mesh.points),
        discretisation_(linear_discretisation(std::move(topology))),
        assembler_(discretisation_),
        mass_(assembler_.mass(points_)),
        stiffness_(assembler_.stiffness(points_)),
        edge_(mean_edge(*discretisation_.topology, points_)) {}

  /// As the paper's method fairs the surface: across its edges values hardly mix.
  Field along_curvature(const Field& f, double tau) {
    if (!paper_) {
      const Topology& topology = *discretisation_.topology;
      paper_ = paper_equations({topology, points_, boundary_vertices(topology)});
    }
    return solved(f, tau, paper_->mass, paper_->stiffness);
  }

  Field isotropic(const Field& f, double tau) const { return solved(f, tau, mass_, stiffness_); }

  Field anisotropic(const Field& f, double tau, double& contrast) const {
    const std::vector<Tensor> tensor = tensors(isotropic(f, time_before_slopes), contrast);
    return solved(f, tau, mass_, assembler_.stiffness(points_, tensor));
  }

 private:
  Field solved(const Field& f, double tau, const SparseMatrix& mass, const SparseMatrix& stiffness) const {
    SparseMatrix matrix;
    combine(1, mass, tau * edge_ * edge_, stiffness, matrix);
    Field result;
    for (const Vector& component : f) result.push_back(solve_spd(matrix, mass * component, {.tolerance = 1e-9}));
    return result;
  }

  /// Structure tensors at the quadrature points, with slopes per mean edge.
  std::vector<Eigen::Matrix3d> structure(const Field& f) const {
    std::vector<Eigen::Matrix3d> sum;
    for (const Vector& component : f) {
      const std::vector<Point> gradient = quadrature_gradients(discretisation_, points_, component);
      sum.resize(gradient.size(), Eigen::Matrix3d::Zero());
      for (std::size_t q = 0; q < sum.size(); ++q) {
        const Vector3 g = edge_ * vector3(gradient[q]);
        sum[q] += g * g.transpose();
      }
    }
    return sum;
  }

  static double find_contrast(const std::vector<Eigen::Matrix3d>& structure) {
    std::vector<double> slope;
    for (const Eigen::Matrix3d& s : structure) slope.push_back(std::sqrt(s.trace()));
    const double largest = *std::max_element(slope.begin(), slope.end());
    return std::max(contrast_factor * quantile(slope, 0.5), least_contrast * largest);
  }

  std::vector<Tensor> tensors(const Field& smooth, double& contrast) const {
    const std::vector<Eigen::Matrix3d> s = structure(smooth);
    contrast = find_contrast(s);
    std::vector<Tensor> tensor(s.size(), Tensor{1, 0, 0, 1, 0, 1});
    if (!(contrast > 0)) return tensor;
    const auto g = [&](double square) { return throttle(std::sqrt(std::max(0.0, square)), contrast); };
    parallel_for(s.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t q = begin; q < end; ++q) tensor[q] = diffusion_tensor(s[q], g);
    });
    return tensor;
  }

  const std::vector<Point>& points_;
  Discretisation discretisation_;
  Assembler assembler_;
  SparseMatrix mass_, stiffness_;
  double edge_;
  std::optional<PaperEquations> paper_;
};

/// Linear elements on obtuse triangles may pass the range of a function a little; diffusion does not.
void keep_range(const Field& from, Field& to) {
  for (std::size_t c = 0; c < to.size(); ++c) to[c] = to[c].cwiseMax(from[c].minCoeff()).cwiseMin(from[c].maxCoeff());
}

double change(const Field& from, const Field& to) {
  std::vector<double> of_components;
  for (std::size_t c = 0; c < to.size(); ++c)
    of_components.push_back(std::sqrt((to[c] - from[c]).squaredNorm() / static_cast<double>(to[c].size())));
  return root_mean_square(of_components);
}

double noise_of(const Topology& topology, const std::vector<Point>& points, const Field& field) {
  std::vector<double> of_components;
  for (const Vector& c : field)
    of_components.push_back(estimate_noise(topology, points, std::vector<double>(c.begin(), c.end())));
  return root_mean_square(of_components);
}

}  // namespace

const std::vector<std::string>& attribute_methods() {
  static const std::vector<std::string> names = {"anisotropic", "isotropic", "paper"};
  return names;
}

SmoothedAttribute smooth_attribute(const TriangleMesh& mesh, const std::string& name, const AttributeOptions& options,
                                   const Progress& progress) {
  check(options);
  Attribute attribute = find_attribute(mesh, name);
  SmoothedAttribute result{mesh, {}};
  if (mesh.triangles.empty()) return result;
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  const Field from = components_of(attribute);
  AttributeReport& report = result.report;
  report.noise = options.noise ? *options.noise : noise_of(topology, mesh.points, from);
  const int most = options.steps.value_or(report.noise > 0 ? most_steps : 0);
  Diffusion diffusion(mesh, topology);
  Field field = from;
  while (report.steps < most && (options.steps || report.changed < noise_share * report.noise)) {
    if (progress && !progress("smoothing", static_cast<double>(report.steps) / most))
      throw Error(Fault::cancelled, "cancelled");
    if (options.method == "isotropic")
      field = diffusion.isotropic(field, options.tau);
    else if (options.method == "paper")
      field = diffusion.along_curvature(field, options.tau);
    else
      field = diffusion.anisotropic(field, options.tau, report.contrast);
    keep_range(from, field);
    report.changed = change(from, field);
    ++report.steps;
  }
  attribute.values = interleaved(field);
  widen(attribute);
  result.mesh.set(std::move(attribute));
  return result;
}

}  // namespace pelage
