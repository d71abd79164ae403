#include "discretise/surface_space.h"

#include "discretise/anisotropy.h"

namespace pelage {

SurfaceSpace::SurfaceSpace(std::shared_ptr<const Connectivity> connectivity, std::vector<Point> control)
    : connectivity_(std::move(connectivity)), control_(std::move(control)) {}

void SurfaceSpace::assemble() const {
  if (stiffness_) return;
  assembled_ = connectivity_->assembler.mass_and_stiffness(control_);
  stiffness_ = std::make_shared<const SparseMatrix>(std::move(assembled_->stiffness));
}

SampledMass SurfaceSpace::sampled(SampleRule rule) const {
  const std::lock_guard lock(making_);
  const Discretisation& d = discretisation();
  SampledMass& made = rule == SampleRule::vertices ? at_vertices_ : at_quadrature_;
  if (made.sampling) return made;
  assemble();
  const bool fresh = assembled_.has_value();
  SparseMatrix mass = fresh ? std::move(assembled_->mass) : connectivity_->assembler.mass(control_);
  if (rule == SampleRule::quadrature) {
    made.sampling = std::make_shared<const Sampling>(quadrature_sampling(d, control_));
  } else if (const double share = connectivity_->consistent; share > 0) {
    made.sampling = std::make_shared<const Sampling>(blended_sampling(d, control_, mass, *stiffness_, share));
    mass = sampled_mass(*made.sampling, made.sampling->weight, connectivity_->assembler.pattern());
  } else {
    SparseMatrix test = earlier_ ? earlier_->test : transpose(d.values);
    made.sampling =
        std::make_shared<const Sampling>(fresh ? vertex_sampling(d, control_, mass, std::move(test), assembled_->area)
                                               : vertex_sampling(d, control_, mass));
    earlier_.reset();
    mass = sampled_mass(*made.sampling, made.sampling->weight, connectivity_->assembler.pattern());
  }
  made.mass = std::make_shared<const SparseMatrix>(std::move(mass));
  assembled_.reset();
  return made;
}

SparseMatrix SurfaceSpace::quadrature_values() const { return pelage::quadrature_values(discretisation()); }

SharedMatrix SurfaceSpace::stiffness() const {
  const std::lock_guard lock(making_);
  assemble();
  return stiffness_;
}

SparseMatrix SurfaceSpace::weighted_mass(const std::vector<double>& c) const {
  return connectivity_->assembler.mass(control_, c);
}

SparseMatrix SurfaceSpace::stiffness(const std::vector<double>& c) const {
  return connectivity_->assembler.stiffness(control_, c);
}

SparseMatrix SurfaceSpace::stiffness(const std::vector<Tensor>& c) const {
  return connectivity_->assembler.stiffness(control_, c);
}

const Gradients& SurfaceSpace::gradients() const {
  const std::lock_guard lock(making_);
  if (!gradients_)
    gradients_ = std::make_unique<const Gradients>(discretisation(), control_, connectivity_->assembler.pattern());
  return *gradients_;
}

Vector SurfaceSpace::gradient_product(SampleRule rule, const Vector& u, const Vector& v) const {
  return rule == SampleRule::vertices ? gradients().at_vertices(u, v) : gradients().at_quadrature_points(u, v);
}

ElementPoint SurfaceSpace::element_point(Index face, double v, double w) const {
  const Discretisation& d = discretisation();
  const auto e = static_cast<std::size_t>(face);
  return {{d.function.begin() + d.first_function[e], d.function.begin() + d.first_function[e + 1]},
          d.basis->at(e, v, w)};
}

PlaceGeometry SurfaceSpace::geometry(SampleRule rule, bool with_curvature) const {
  const Discretisation& d = discretisation();
  PlaceGeometry places;
  if (rule == SampleRule::vertices) {
    places = {limit_positions(d, control_), limit_normals(d, control_), {}};
    if (with_curvature) places.curvature = principal_curvatures(vertex_curvature(d, control_), places.normal);
  } else {
    QuadratureGeometry g = quadrature_geometry(d, control_);
    places = {std::move(g.position), std::move(g.normal), {}};
    if (with_curvature) places.curvature = principal_curvatures(quadrature_curvature(d, control_), places.normal);
  }
  return places;
}

std::vector<double> SurfaceSpace::at_quadrature_points(const std::vector<double>& at_nodes) const {
  const Discretisation& d = discretisation();
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(d.first_point.back()));
  for (std::size_t e = 0; e < d.elements(); ++e) {
    const Triangle& t = d.topology->triangles[e];
    const auto corner = [&](std::size_t k) { return at_nodes[static_cast<std::size_t>(t[k])]; };
    for (const auto& [v, w] : d.classes[static_cast<std::size_t>(d.element_class[e])].place)
      values.push_back((1 - v - w) * corner(0) + v * corner(1) + w * corner(2));
  }
  return values;
}

std::vector<Tensor> SurfaceSpace::tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField& rates) const {
  return quadrature_tensors(discretisation(), control_, lines, rates);
}

std::vector<char> SurfaceSpace::interior(std::vector<char> nodes) const {
  for (int ring = 0; ring < connectivity_->reach; ++ring) {
    std::vector<char> inner = nodes;
    for (const Triangle& t : discretisation().topology->triangles)
      for (const Index v : t)
        for (const Index neighbour : t)
          if (!nodes[static_cast<std::size_t>(neighbour)]) inner[static_cast<std::size_t>(v)] = 0;
    nodes = std::move(inner);
  }
  return nodes;
}

std::shared_ptr<const Space> SurfaceSpace::moved(std::vector<Point> control) const {
  auto space = std::make_shared<SurfaceSpace>(connectivity_, std::move(control));
  const std::lock_guard lock(making_);
  space->earlier_ = at_vertices_.sampling ? at_vertices_.sampling : earlier_;
  return space;
}

std::shared_ptr<const SurfaceSpace> surface_space(Discretisation discretisation, std::vector<Point> control, int reach,
                                                  double consistent) {
  return std::make_shared<const SurfaceSpace>(
      std::make_shared<const SurfaceSpace::Connectivity>(std::move(discretisation), reach, consistent),
      std::move(control));
}

}  // namespace pelage
