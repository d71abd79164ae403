#include "studio/baked_coat.h"

#include "io/gltf_coat.h"
#include "look/bake.h"
#include "look/coat_sampler.h"
#include "look/dress.h"
#include "look/kept_shape.h"
#include "look/tessellation.h"
#include "pelage/error.h"
#include "pelage/unwrap.h"

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

std::shared_ptr<const TriangleMesh> with_atlas(const TriangleMesh& shape, int size, const Progress& progress) {
  TriangleMesh mesh = shape;
  mesh.set(unwrap(polygons_of(shape), atlas_options(size), progress).uv);
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

}  // namespace

std::string baked_glb(CoatFields fields, const Look& look, int size, const SaveOptions& options,
                      const Progress& progress) {
  require_surface(fields, size);
  if (!has_uv(*fields.shape)) fields.shape = with_atlas(*fields.shape, size, progress);
  const TriangleMesh& shape = *fields.shape;
  const UvLayout layout(shape.triangles, *shape.find("uv"), size);
  if (layout.tiles().size() > 1)
    throw Error(Fault::usage, "the uv of this shape lie on several images; pelage grow --bake writes them all");
  const Paint paint = resolve_paint(look, fields.species);
  Look as_given = look, smooth = look;
  as_given.keep_shape = true;
  smooth.keep_shape = false;
  PolygonMesh mesh = kept_shape(own_form(shape), dress(fields, as_given), paint);
  std::optional<ShadingFrames> frames;
  if (paint.channels.contains(Channel::height)) frames.emplace(shape);
  const Tessellation t = tessellate(fields, tessellation_request(smooth, paint));
  const CoatSampler sampler(fields, t, paint);
  BakedCoat baked = bake(sampler, make_palette(paint, t.samples, fields.uniform), layout, frames ? &*frames : nullptr);
  SaveOptions textured = options;
  textured.textures = {maps_of(std::move(baked.tiles[0]), baked.scales)};
  textured.repeat = layout.repeats();
  erase_imaged(mesh.attributes, textured.textures[0]);
  return mesh_bytes(mesh, ".glb", textured);
}

}  // namespace pelage
