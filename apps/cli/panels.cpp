#include "panels.h"

#include "catalog/bind.h"
#include "look/canvas.h"
#include "look/caption.h"
#include "look/dress.h"
#include "pelage/fair.h"
#include "run/run.h"

namespace pelage {

namespace {

constexpr int gap = 8;  // pixels between panels
constexpr std::int64_t steps_per_report = 5;

/// Flat triangles in grey: the smooth surface would hide half of the noise.
TriangleMesh bare(const TriangleMesh& mesh) { return {mesh.points, mesh.triangles, {}}; }

TriangleMesh coat_at_rest(Recipe recipe, const TriangleMesh& noisy, const Progress& progress) {
  recipe.motion = {};
  Run run(make_program(recipe, noisy), progress);
  while (!run.done()) {
    if (progress && !progress("growing on the noisy shape", run.fraction())) throw Error(Fault::cancelled, "cancelled");
    run.advance(steps_per_report);
  }
  if (run.summary().status == RunStatus::failed) throw Error(Fault::numerics, run.summary().message);
  return dress(run.fields(), recipe.look);
}

Image side_by_side(const std::vector<Image>& images) {
  const int pitch = images[0].width + gap;
  Canvas canvas(static_cast<int>(images.size()) * pitch - gap, images[0].height, {1, 1, 1});
  for (std::size_t i = 0; i < images.size(); ++i) canvas.picture(images[i], static_cast<int>(i) * pitch, 0);
  return canvas.image();
}

}  // namespace

std::array<std::int64_t, 2> size_of_panels(int picture) {
  constexpr std::int64_t panels = 4;
  return {panels * (picture + gap) - gap, std::int64_t{picture} + caption_height(picture)};
}

Image four_panels(const Recipe& recipe, const TriangleMesh& noisy, const TriangleMesh& coupled,
                  const PictureOptions& picture, const Progress& progress) {
  const auto panel = [&](const TriangleMesh& mesh, const std::string& title, const std::string& words) {
    return with_caption(render(mesh, picture, progress), title, words);
  };
  const std::string method = recipe.motion.fair->value;
  const Faired faired = fair(noisy, {.method = method}, progress);
  return side_by_side(
      {panel(bare(noisy), "noisy", "the shape as given"),
       panel(bare(faired.mesh), "faired", method + ", " + std::to_string(faired.report.steps) + " steps"),
       panel(coat_at_rest(recipe, noisy, progress), "grown on the noisy shape", recipe.stages[0].model.value),
       panel(coupled, "grown while faired", recipe.stages[0].model.value + ", " + recipe.motion.mode.value)});
}

}  // namespace pelage
