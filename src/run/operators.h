#pragma once
// Discretisation, matrices and reaction of one stage, built once.

#include <functional>
#include <memory>
#include <span>

#include "base/progress.h"
#include "discretise/assembly.h"
#include "discretise/sampling.h"
#include "react/kinetics.h"
#include "run/place_fields.h"
#include "run/program.h"
#include "shape/refine.h"
#include "time/system.h"

namespace pelage {

/// Not movable: the system points into it.
class Operators {
 public:
  Operators(const Program& program, const Progress& progress);
  Operators(const Operators&) = delete;
  Operators& operator=(const Operators&) = delete;

  const System& system() const { return system_; }
  const Discretisation& discretisation() const { return *discretisation_; }
  const std::vector<Point>& control() const { return control_; }
  const SparseMatrix& stiffness() const { return stiffness_; }  ///< of unit diffusion
  /// What the caller should know about, each in one line: anisotropies that the mesh cannot carry.
  const std::vector<std::string>& warnings() const { return warnings_; }
  int levels() const { return levels_; }  ///< refinements of the program's shape

  /// An upper estimate of the largest k^2 that the mesh carries: of K x = k^2 M x, by power iteration [1 / world^2].
  double largest_k2() const;

  /// Renews everything that depends on where the surface is, for other vertices of the program's shape. Whoever keeps
  /// matrices made of those of the system has to drop them.
  void place(const Program& program, const std::vector<Point>& points);

  /// Coefficients of the initial state.
  std::vector<Vector> initial() const;

  /// Brings operators that depend on time or on the fields up to date; to be called before every step.
  void update(const State& state);

 private:
  RefinedMesh refined_mesh(const Program& program) const;
  VertexAttributes vertex_attributes(const Program& program) const;
  void fill_matrices(const Program& program);
  void evaluate_places(const Program& program);
  void hold_samples(const Program& program);
  void build_species();
  bool has_own_stiffness(std::size_t species) const;
  void fill_own_stiffness(std::size_t species);
  Vector sampled_coefficients(const std::function<void(std::span<double>)>& samples) const;
  void find_directions(const Program& program);
  void couple_species(double scale);
  struct Coefficients {
    std::vector<Vector> c0, c1;
  };
  static Coefficients evaluate_diffusion(const Kinetics& kinetics, const std::vector<Vector>& fields, double time);
  std::vector<Vector> fields_at(const Kinetics& kinetics, const SparseMatrix& values, const State* state) const;
  std::vector<double> c1_at_quadrature(std::size_t species, const State* state) const;
  Vector c0_at_samples(std::size_t species, const State* state) const;
  void fill_variable(std::size_t species, const State* state);
  bool diffusion_varies_in_time(std::size_t species) const;

  Model model_;
  double length_unit_ = 1;
  int levels_ = 0;
  std::vector<Point> control_;
  std::unique_ptr<Discretisation> discretisation_;
  std::unique_ptr<Assembler> assembler_;
  Sampling sampling_;
  SparseMatrix mass_, stiffness_;
  VertexAttributes attributes_;  ///< that the model reads, at the vertices; they stay with them when the surface moves
  std::vector<char> inside_;     ///< of the mask of the stage; likewise
  std::vector<char> held_;       ///< the same, or the inner part of an excluded region
  std::vector<std::string> warnings_;
  std::unique_ptr<Kinetics> kinetics_;             ///< at the samples
  std::unique_ptr<Kinetics> quadrature_kinetics_;  ///< at the quadrature points, for diffusion that varies
  SparseMatrix quadrature_values_;
  /// Matrices of a species whose C0 or C1 varies.
  struct Variable {
    SparseMatrix stiffness, mass;
    Vector weight;
  };
  std::vector<std::unique_ptr<Variable>> variable_;
  std::vector<Tensor> lines_;  ///< of the direction field, at the vertices of the discretisation
  System system_;
};

}  // namespace pelage
