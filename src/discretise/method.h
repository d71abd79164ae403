#pragma once
// What the rest of the program knows of a discretisation.

#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "discretise/space.h"
#include "pelage/node_shape.h"
#include "shape/hierarchy.h"

namespace pelage {

/// What a growth takes at most, measured: matrices, samples, basis functions and the mesh itself [bytes].
struct MemoryNeed {
  double node = 1000;    ///< for every node
  double species = 100;  ///< more of it for every species
};

/// The defaults are those of methods on nodes.
struct Method {
  std::string_view name;
  std::string_view summary;                  ///< some words
  Hierarchy::Rule refine = midpoint_refine;  ///< of control points and coefficients, from level to level
  bool smooth = false;  ///< the surface is the limit of Loop's subdivision, else it goes through its points
  /// Control points whose surface goes through the points; null: they themselves.
  std::vector<Point> (*interpolate)(const Topology& topology, const std::vector<Point>& points) = nullptr;
  /// On the control points; with `own_mesh` on the vertices of a simulation mesh.
  std::shared_ptr<const Space> (*make_space)(std::shared_ptr<const Topology> topology,
                                             std::vector<Point> control) = nullptr;
  bool own_mesh = false;  ///< lives on a SimulationMesh of the surface that the control points make
  bool nodal = true;      ///< coefficients are the values at the nodes
  double edges = 1;       ///< edges that it needs where Loop elements need one
  Index max_valence = std::numeric_limits<Index>::max();  ///< edges at a vertex
  /// Ratio of the rates along and across up to which waves across a field that is oblique to an even mesh decay, at the
  /// coarsest resolution, no faster than they do without anisotropy but for a percent of their rate (Loop) or for a few
  /// (linear, whose error is 17 % to begin with, and remeshed): tests/run/anisotropy_test.cpp measures it.
  double safe_anisotropy = 2;
  /// On the nodes of the kinds of shapes that the method is for; of methods that have one `make_space` is null.
  std::shared_ptr<const Space> (*make_node_space)(const NodeShape& nodes) = nullptr;
  /// Whether it is for that shape.
  bool (*fits)(const NodeShape& nodes) = nullptr;
  bool symmetric = true;  ///< its stiffness matrices are
  MemoryNeed memory = {};
};

extern const Method remeshed_method;
extern const Method loop_method;
extern const Method linear_method;
extern const Method grid_method;
extern const Method mask_method;
extern const Method tets_method;
extern const Method cell_method;
extern const Method turk_method;

/// Those that come with the program, the default first.
std::span<const Method* const> methods();

}  // namespace pelage
