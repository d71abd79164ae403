#pragma once
// From the fields of a run to what is written and drawn of them.

#include <memory>
#include <optional>

#include "grow_options.h"
#include "grow_report.h"
#include "look/carving.h"
#include "look/palette.h"
#include "pelage/io.h"
#include "texture_outputs.h"

namespace pelage {

/// A coat, and the shape as it was given.
struct Grown {
  TriangleMesh coat;                     ///< as it is shown
  std::optional<Image> image;            ///< instead of the coat, where nothing else is asked for
  std::optional<TriangleMesh> at_nodes;  ///< of a volume, what files of these have
  std::shared_ptr<const TriangleMesh> shape;
  Paint paint;
  std::shared_ptr<const NodeShape> nodes;  ///< of the run, which may be made of the file's surface
  std::optional<PatchTexture> patches;     ///< where they are asked for
  std::optional<CoatTextures> textures;    ///< likewise
  std::optional<PolygonMesh> textured;     ///< the mesh that shows these
};

/// What is asked for, apart from the fields.
struct CoatRequest {
  const GrowOptions& options;
  const Look& look;
  const ShapeFile& file;
  const std::optional<UvLayout>& layout;  ///< of images on surfaces
  const std::optional<ShapeFile>& onto;   ///< another mesh that shows these
  const Carving& carving;                 ///< of volumes
};

/// The mesh of --onto; none without it. Error(Fault::usage) for shapes and motions whose coats cannot be taken there,
/// Error(Fault::input) for what is no mesh of the same shape.
std::optional<ShapeFile> read_onto(const GrowOptions& options, const Recipe& recipe, const ShapeFile& shape,
                                   const Progress& progress, GrowReport& report);

/// Where images are asked for, a surface without uv gets some; but for images that the recipe reads by uv. `file`: the
/// mesh that shows them.
void make_atlas(const GrowOptions& options, const Recipe& recipe, ShapeFile& file, const Progress& progress,
                GrowReport& report);

/// Of surfaces, where images are asked for; warns of what is unusual.
std::optional<UvLayout> layout_of(const GrowOptions& options, const ShapeFile& file, GrowReport& report);

/// Refuses before the growth what grown_coat would refuse after it.
void check_coat(const CoatRequest& request);

/// `shape`: what the pattern has grown on, as it was given.
Grown grown_coat(const CoatFields& fields, const std::shared_ptr<const TriangleMesh>& shape, const CoatRequest& request,
                 const Progress& progress, GrowReport& report);

/// The mesh that files of a coat on the shape as it is have: the file's own with what the coat adds to it.
PolygonMesh coat_in_file(const Grown& grown, const ShapeFile& file);

}  // namespace pelage
