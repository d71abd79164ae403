#include "catalog/textured_coat.h"

#include "io/gltf_coat.h"
#include "io/read_shape.h"
#include "look/bake.h"
#include "look/coat_sampler.h"
#include "look/dress.h"
#include "look/kept_shape.h"
#include "look/tessellation.h"
#include "pelage/error.h"
#include "pelage/unwrap.h"
#include "shape/triangulate.h"

namespace pelage {

namespace {

constexpr int smallest = 16, largest = 8192;

void require_surface(const CoatFields& fields, int size) {
  if (fields.nodes || fields.shape->triangles.empty())
    throw Error(Fault::usage, "images are baked on surfaces; leave them out for colours at the vertices");
  if (size < smallest || size > largest)
    throw Error(Fault::usage,
                "an image has from " + std::to_string(smallest) + " to " + std::to_string(largest) + " texels a side");
}

}  // namespace

AtlasShape with_atlas(ShapeFile file, int size, const Progress& progress) {
  const PolygonMesh polygons = file.source ? file.source->polygons : polygons_of(file.mesh);
  Unwrapped atlas = unwrap(polygons, atlas_options(size), progress);
  return {with_attribute(std::move(file), std::move(atlas.uv)), atlas.report.charts};
}

TriangleMesh shaded_mesh(const PolygonMesh& mesh, const TriangleMesh& shape) {
  std::vector<Finding> ignored;
  TriangleMesh shaded = triangulate(mesh, ignored).mesh;
  return shaded.triangles.size() == shape.triangles.size() ? shaded : shape;
}

TexturedMesh textured_coat(CoatFields fields, ShapeFile file, const Look& look, int size, const Progress& progress) {
  require_surface(fields, size);
  file.mesh = *fields.shape;
  if (!has_uv(file.mesh)) {
    file = with_atlas(std::move(file), size, progress).file;
    fields.shape = std::make_shared<const TriangleMesh>(file.mesh);
  }
  const TriangleMesh& shape = *fields.shape;
  const UvLayout layout(shape.triangles, *shape.find("uv"), size);
  if (layout.tiles().size() > 1)
    throw Error(Fault::usage, "the uv of this shape lie on several images; pelage grow --bake writes them all");
  const Paint paint = resolve_paint(look, fields.species);
  Look as_given = look, smooth = look;
  as_given.keep_shape = true;
  smooth.keep_shape = false;
  TexturedMesh result;
  result.mesh = kept_shape(file.source ? *file.source : own_form(shape), dress(fields, as_given), paint);
  std::optional<ShadingFrames> frames;
  if (paint.channels.contains(Channel::height)) frames.emplace(shaded_mesh(result.mesh, shape));
  const Tessellation t = tessellate(fields, tessellation_request(smooth, paint));
  const CoatSampler sampler(fields, t, paint);
  BakedCoat baked = bake(sampler, make_palette(paint, t.samples, fields.uniform), layout, frames ? &*frames : nullptr);
  result.size = size;
  result.repeat = layout.repeats();
  result.height = std::move(baked.tiles[0].height);
  result.maps = maps_of(std::move(baked.tiles[0]), baked.scales);
  erase_imaged(result.mesh.attributes, result.maps);
  return result;
}

}  // namespace pelage
