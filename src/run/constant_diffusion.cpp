#include "run/constant_diffusion.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "discretise/grid_space.h"
#include "discretise/lattice_stencil.h"

namespace pelage {

namespace {

bool varies(const Model& model, std::size_t i) {
  if (model.has_tensor(i)) return model.diffusion_dependence(i) != 0;
  if (!model.anisotropic(i)) return !model.diffusion_constant(i);
  const Equations& e = model.equations();
  const Anisotropy& a = *e.anisotropy[i];
  return std::ranges::any_of(std::array{a.theta, a.a1, a.a2}, [&](NodeId id) { return e.graph[id].dependence != 0; });
}

}  // namespace

bool diffuses_evenly(const Model& model) {
  for (std::size_t i = 0; i < model.species_count(); ++i)
    if (!model.follows(i) && varies(model, i)) return false;
  return true;
}

Kinetics::TensorField even_anisotropy(const StageProgram& stage, std::size_t species) {
  const std::vector<Point> place(1);  // any
  return Kinetics(stage.model, {.positions = place}, stage.seed, Kinetics::Parts::diffusion).anisotropy(species);
}

std::vector<Tensor> tensors_of(const Model& model, std::size_t species, const Kinetics& kinetics,
                               const std::vector<const double*>& fields, double time) {
  std::size_t before = 0, count = 0;
  for (std::size_t i = 0; i < model.species_count(); ++i) {
    if (!model.has_tensor(i)) continue;
    before += i < species;
    ++count;
  }
  const std::size_t places = kinetics.size();
  std::vector<std::vector<double>> entry(6 * count, std::vector<double>(places));
  std::vector<double*> out;
  for (std::vector<double>& values : entry) out.push_back(values.data());
  parallel_for(places, [&](std::size_t begin, std::size_t end) { kinetics.tensors(fields, time, begin, end, out); });
  std::vector<Tensor> tensors(places);
  for (std::size_t q = 0; q < places; ++q)
    for (std::size_t k = 0; k < 6; ++k) tensors[q][k] = entry[6 * before + k][q];
  return tensors;
}

double largest_ratio(const Lattice& lattice, const Eigen::Matrix3d& tensor) {
  std::vector<int> axes;
  for (int a = 0; a < 3; ++a)
    if (lattice.count[static_cast<std::size_t>(a)] > 1) axes.push_back(a);
  const Eigen::VectorXd squares = symmetric_modes(tensor(axes, axes)).values;
  const double largest = squares[squares.size() - 1];
  return largest > 0 ? std::sqrt(largest / std::max(squares[0], 0.0)) : 1;
}

namespace {

/// Along the axes of the lattice; what is across them does nothing.
Eigen::Matrix3d even_tensor(const StageProgram& stage, std::size_t species, const Lattice& lattice) {
  const std::vector<Point> place(1);  // any
  const double concentration = 0;     // any
  const Kinetics kinetics(stage.model, {.positions = place}, stage.seed, Kinetics::Parts::diffusion);
  const std::vector<const double*> fields(stage.model.species_count(), &concentration);
  Eigen::Matrix3d tensor = matrix_of(tensors_of(stage.model, species, kinetics, fields, 0)[0]);
  for (int a = 0; a < 3; ++a)
    if (lattice.count[static_cast<std::size_t>(a)] < 2) tensor.row(a).setZero(), tensor.col(a).setZero();
  return tensor;
}

}  // namespace

std::vector<Eigen::Matrix3d> constant_tensors(const StageProgram& stage, const Space& space, const Material& material) {
  const Model& model = stage.model;
  if (!space.lattice() || (model.anisotropic() && material.lines.size() != 1)) return {};
  if (!diffuses_evenly(model)) return {};
  const double scale = stage.length_unit * stage.length_unit;
  std::vector<Eigen::Matrix3d> tensors;
  const Lattice& lattice = *space.lattice();
  for (std::size_t i = 0; i < model.species_count(); ++i) {
    Eigen::Matrix3d tensor = model.diffusion_constant(i).value_or(0) * Eigen::Matrix3d::Identity();
    if (model.has_tensor(i)) tensor = even_tensor(stage, i, lattice);
    if (model.anisotropic(i)) tensor = matrix_of(lattice_tensor(lattice, material.lines[0], even_anisotropy(stage, i)));
    tensors.push_back(scale * tensor);
  }
  return tensors;
}

bool needs_no_matrices(const StageProgram& stage, const Space& space, const Material& material,
                       const std::vector<Eigen::Matrix3d>& tensors) {
  const Model& model = stage.model;
  return stage.stepper->matrix_free && !stage.solver_asked && !tensors.empty() && !material.held &&
         stage.borders.empty() && model.coupled().empty() && !model.has_gradients() &&
         std::ranges::none_of(tensors,
                              [&](const Eigen::Matrix3d& t) { return tilted_to_a_border(*space.lattice(), t); });
}

Sampling lattice_sampling(const Lattice& lattice) {
  Sampling sampling;
  sampling.weight.resize(static_cast<Eigen::Index>(lattice.nodes()));
  parallel_for(lattice.nodes(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double weight = 1;
      std::size_t rest = v;
      for (std::size_t a = 0; a < 3; rest /= lattice.count[a++]) {
        if (lattice.count[a] < 2) continue;
        const std::size_t place = rest % lattice.count[a];
        const bool border = !lattice.periodic[a] && (place == 0 || place + 1 == lattice.count[a]);
        weight *= lattice.spacing[a] * (border ? 0.5 : 1);
      }
      sampling.weight[static_cast<Eigen::Index>(v)] = weight;
    }
  });
  return sampling;
}

}  // namespace pelage
