#pragma once
// Diffusion that is the same everywhere, on even grids.

#include "discretise/space.h"
#include "run/material.h"

namespace pelage {

/// Whether no diffusion of a model depends on the place, the time or concentrations.
bool diffuses_evenly(const Model& model);

/// The diffusion tensor of every species [world^2 / time]: on a lattice, where no diffusion depends on place, time or
/// concentrations, and directions, if any, are the same everywhere. Else empty.
std::vector<Eigen::Matrix3d> constant_tensors(const StageProgram& stage, const Space& space, const Material& material);

/// The rates of an anisotropic species that do not depend on the place.
Kinetics::TensorField even_anisotropy(const StageProgram& stage, std::size_t species);

/// C1 of a species that has a tensor, at the places of `kinetics` for fields given there.
std::vector<Tensor> tensors_of(const Model& model, std::size_t species, const Kinetics& kinetics,
                               const std::vector<const double*>& fields, double time);

/// The largest ratio of the rates that a tensor has along the axes of a lattice.
double largest_ratio(const Lattice& lattice, const Eigen::Matrix3d& tensor);

/// Whether a stage needs no matrices: its stepper goes by the lattice with these tensors, and nothing is held, coupled
/// or driven by gradients.
bool needs_no_matrices(const StageProgram& stage, const Space& space, const Material& material,
                       const std::vector<Eigen::Matrix3d>& tensors);

/// Samples on the nodes of a lattice, with their weights alone.
Sampling lattice_sampling(const Lattice& lattice);

}  // namespace pelage
