#include "discretise/surface_space.h"

#include "discretise/anisotropy.h"

namespace pelage {

SurfaceSpace::SurfaceSpace(std::shared_ptr<const Connectivity> connectivity, std::vector<Point> control)
    : connectivity_(std::move(connectivity)), control_(std::move(control)) {}

SampledMass SurfaceSpace::sampled(SampleRule rule) const {
  const Discretisation& d = discretisation();
  if (rule == SampleRule::quadrature) {
    std::call_once(at_quadrature_made_, [&] {
      at_quadrature_ = {std::make_shared<const Sampling>(quadrature_sampling(d, control_)),
                        std::make_shared<const SparseMatrix>(connectivity_->assembler.mass(control_))};
    });
    return at_quadrature_;
  }
  std::call_once(at_vertices_made_, [&] {
    auto sampling =
        std::make_shared<const Sampling>(vertex_sampling(d, control_, connectivity_->assembler.mass(control_)));
    SparseMatrix mass = sampled_mass(*sampling, sampling->weight, connectivity_->assembler.pattern());
    at_vertices_ = {std::move(sampling), std::make_shared<const SparseMatrix>(std::move(mass))};
  });
  return at_vertices_;
}

SparseMatrix SurfaceSpace::quadrature_values() const { return pelage::quadrature_values(discretisation()); }

SharedMatrix SurfaceSpace::stiffness() const {
  std::call_once(stiffness_made_, [&] {
    stiffness_ = std::make_shared<const SparseMatrix>(connectivity_->assembler.stiffness(control_));
  });
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
  return std::make_shared<const SurfaceSpace>(connectivity_, std::move(control));
}

std::shared_ptr<const SurfaceSpace> surface_space(Discretisation discretisation, std::vector<Point> control,
                                                  int reach) {
  return std::make_shared<const SurfaceSpace>(
      std::make_shared<const SurfaceSpace::Connectivity>(std::move(discretisation), reach), std::move(control));
}

}  // namespace pelage
