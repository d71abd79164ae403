#include "run/constant_diffusion.h"

#include <algorithm>

#include "base/parallel.h"
#include "discretise/anisotropy.h"
#include "discretise/grid_space.h"
#include "discretise/lattice_stencil.h"

namespace pelage {

namespace {

bool varies(const Model& model, std::size_t i) {
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

std::vector<Eigen::Matrix3d> constant_tensors(const StageProgram& stage, const Space& space, const Material& material) {
  const Model& model = stage.model;
  if (!space.lattice() || (model.anisotropic() && material.lines.size() != 1)) return {};
  if (!diffuses_evenly(model)) return {};
  const double scale = stage.length_unit * stage.length_unit;
  std::vector<Eigen::Matrix3d> tensors;
  for (std::size_t i = 0; i < model.species_count(); ++i)
    tensors.push_back(scale *
                      (model.anisotropic(i)
                           ? matrix_of(lattice_tensor(*space.lattice(), material.lines[0], even_anisotropy(stage, i)))
                           : Eigen::Matrix3d(model.diffusion_constant(i).value_or(0) * Eigen::Matrix3d::Identity())));
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
