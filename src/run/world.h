#pragma once
// Where a run takes place: the levels of its shape and the space on the finest of them, made once for all stages, and
// the surface on its way.

#include <memory>

#include "discretise/simulation_mesh.h"
#include "pelage/progress.h"
#include "run/harmonic_volume.h"
#include "run/moving_surface.h"
#include "run/program.h"

namespace pelage {

class World {
 public:
  /// Refines the shape and makes the space on it. Error(Fault::numerics) where that needs too much memory (forecast.h).
  explicit World(std::shared_ptr<const Program> program, const Progress& progress = {});
  /// A space at rest that is not one of a mesh.
  explicit World(std::shared_ptr<const Space> space) : space_(std::move(space)) {}
  /// The same with a surface of its own that has not moved yet.
  World unmoved() const;

  const Space& space() const { return *space_; }
  const std::shared_ptr<const Space>& shared_space() const { return space_; }
  /// Null on shapes whose nodes are what they are, and where a run is given its space.
  const std::shared_ptr<const Hierarchy>& hierarchy() const { return hierarchy_; }
  int levels() const { return hierarchy_ ? hierarchy_->finest() : 0; }
  /// Triangles between the nodes of the space, which has a hierarchy.
  const Topology& topology() const { return mesh_ ? *mesh_->shared_topology() : hierarchy_->topology(levels()); }
  /// Null where the nodes of the space are the vertices of the finest level.
  const std::shared_ptr<const SimulationMesh>& mesh() const { return mesh_; }
  /// Control points at the finest level now [world units].
  const std::vector<Point>& control() const { return mesh_ ? control_ : space_->control(); }
  /// What is given at the vertices or corners of the shape at the nodes of the space: linear over its triangles.
  std::vector<double> at_nodes(std::vector<double> at_vertices, std::size_t components = 1) const;
  std::vector<Tensor> at_nodes(const std::vector<Tensor>& at_vertices) const;
  VertexAttributes at_nodes(const Texture& texture) const;

  /// Null when the surface stays where it is. In a volume it is the one that this fills, or its skin.
  const MovingSurface* surface() const { return surface_.get(); }
  /// The vertices of the shape now [world units]; none without a mesh.
  const std::vector<Point>& points() const;
  /// Of a volume that has moved, the vertices of the surface that it fills now; else empty.
  std::vector<Point> filled_surface() const;
  /// Where samples are before the surface moves for the first time.
  std::vector<Point> initial_positions(SampleRule rule) const;

  /// Control points before the surface moved; empty if it has not.
  const std::vector<Point>& initial_control() const { return initial_control_; }

  /// Brings the surface to where it is for the time step after `steps` others, which ends at `time`; true if it has
  /// moved, and the space is another one.
  bool follow(std::int64_t steps, double time);
  /// Another place of the same shape, for runs that go on from a checkpoint.
  void place(std::vector<Point> points);
  void restore(MovingSurface::State state);

 private:
  std::unique_ptr<MovingSurface> unmoved_surface() const;
  /// The vertices of the shape where the surface takes them.
  std::vector<Point> moved_points() const;
  std::vector<Point> coarse_control(std::vector<Point> points) const;
  /// What makes the space, of control points at the finest level.
  std::vector<Point> space_control(const std::vector<Point>& control) const {
    return mesh_ ? mesh_->points(control) : control;
  }

  std::shared_ptr<const Program> program_;
  std::shared_ptr<const Hierarchy> hierarchy_;
  std::shared_ptr<const SimulationMesh> mesh_;
  std::vector<Point> control_;  ///< with a simulation mesh
  std::unique_ptr<MovingSurface> surface_;
  std::shared_ptr<const HarmonicVolume> inside_;  ///< of a volume that is faired
  std::shared_ptr<const Space> space_;
  // Of a surface that has moved:
  std::vector<Point> points_, initial_control_;
};

}  // namespace pelage
