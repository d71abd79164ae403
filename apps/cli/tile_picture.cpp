#include "tile_picture.h"

#include "catalog/bind.h"
#include "catalog/images.h"
#include "io/bytes.h"
#include "look/dress.h"
#include "node_outputs.h"
#include "pelage/render.h"
#include "run/run.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

constexpr std::int64_t steps_per_slice = 20;
/// Share of a picture's time that its run takes, the rest being drawing.
constexpr double share_of_run = 0.9;

/// Colours at corners of their own are split off, so that edges are seen as sharp as they are.
TriangleMesh to_be_drawn(TriangleMesh coat) {
  const Attribute* normal = coat.find("normal");
  return normal && normal->domain == Domain::corner ? split_corners(coat) : coat;
}

}  // namespace

TilePicture tile_picture(const Recipe& recipe, ShapeFile shape, const ViewOptions& view, int size,
                         const std::function<bool(double)>& report) {
  const Progress progress = [&](std::string_view, double) { return report(0); };
  const Plan planned = plan(recipe);
  std::vector<Texture> images = read_images(recipe.textures);
  fill_solid(planned, shape, images);
  Run run(bind_plan(planned, shape, std::move(images)), progress);
  while (!run.done()) {
    if (!report(share_of_run * run.fraction())) return {};
    run.advance(steps_per_slice);
  }
  if (run.summary().status == RunStatus::failed) throw Error(Fault::numerics, run.summary().message);
  TilePicture tile;
  if (run.uniform()) tile.uniform = run.why_uniform();
  const TriangleMesh coat = dress(run.fields(), recipe.look);
  if (const Grid* grid = as<Grid>(shape.nodes); grid && is_flat(*grid))
    tile.image = picture_of_nodes(*grid, coat, {1, 1}, size);
  else
    tile.image = render(to_be_drawn(coat), picture_options(view, size, shape.up, shape.mesh));
  return tile;
}

std::string bytes_of(const TilePicture& tile) {
  std::string bytes;
  append_bytes(bytes, std::int32_t{tile.image.width});
  append_bytes(bytes, std::int32_t{tile.image.height});
  for (const float value : tile.image.rgb) append_bytes(bytes, value);
  return bytes + tile.uniform;
}

std::optional<TilePicture> tile_of(std::string_view bytes) {
  const auto width = bytes_at<std::int32_t>(bytes, 0), height = bytes_at<std::int32_t>(bytes, 4);
  if (!width || !height || *width < 1 || *height < 1) return {};
  constexpr std::size_t begin = 8;
  const std::size_t values = 3 * static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
  if (values > (bytes.size() - begin) / sizeof(float)) return {};
  TilePicture tile{{*width, *height, {}}, std::string(bytes.substr(begin + values * sizeof(float)))};
  for (std::size_t i = 0; i < values; ++i) tile.image.rgb.push_back(*bytes_at<float>(bytes, begin + i * sizeof(float)));
  return tile;
}

}  // namespace pelage
