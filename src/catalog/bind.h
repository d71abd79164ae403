#pragma once
// Joins a plan to a shape: lengths, attributes, images, directions.

#include "catalog/plan.h"
#include "pelage/io.h"
#include "run/program.h"

namespace pelage {

/// `images`: those of the plan, as read_images() gives them (catalog/images.h). Error(Fault::usage), located in the
/// recipe, for attributes that the shape does not have, maps of the size that are not greater than 0, and formulas that
/// mark no vertex; Error(Fault::input) for a shape without extent, and for uv that images need and it lacks. A
/// method for volumes fills the shape first.
Program bind_plan(const Plan& plan, TriangleMesh shape, std::vector<Texture> images = {});
/// The same on nodes that are what they are, and the mesh that has them for vertices. Error(Fault::usage) also for what
/// they cannot do: a grid cannot move.
Program bind_plan(const Plan& plan, std::shared_ptr<const NodeShape> nodes, TriangleMesh mesh,
                  std::vector<Texture> images = {});
/// Where the plan has a method for volumes and the shape is a surface, the shape becomes the volume inside, with the
/// edges that the patterns need; findings tell of what is lost. Errors of fill() (solid/fill.h).
void fill_solid(const Plan& plan, ShapeFile& shape, const std::vector<Texture>& images = {});
/// The same on whichever of these a shape is, filled where that is asked for. Its mesh is taken out of it.
Program bind_plan(const Plan& plan, ShapeFile& shape, std::vector<Texture> images = {});

/// Plan, images and shape in one.
Program make_program(const Recipe& recipe, TriangleMesh shape);
Program make_program(const Recipe& recipe, Grid grid);

}  // namespace pelage
