#include "grow_files.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "grow_run.h"
#include "io/file_bytes.h"
#include "io/gltf_coat.h"
#include "io/write_mesh.h"
#include "node_outputs.h"
#include "panels.h"
#include "picture_files.h"
#include "shape/split_corners.h"
#include "text.h"

namespace pelage {

namespace {

/// How the coat was written.
struct Saving {
  std::vector<std::string> files;   ///< more than one where an image lies beside it
  std::string about;                ///< what a reader must know beside it
  std::vector<std::string> losses;  ///< what it cannot hold
};

/// Returns all files.
std::vector<std::string> write_outputs(const std::vector<std::string>& paths,
                                       const std::function<Saving(const std::string&)>& save_as,
                                       const Progress& progress, GrowReport& report) {
  std::vector<std::string> written;
  for (const std::string& path : paths) {
    progress("writing " + path, 0);
    Saving saving;
    interruptible("before " + path + " was written", [&] { saving = save_as(path); });
    for (const std::string& file : saving.files) report.file(file, saving.about);
    for (const std::string& loss : saving.losses) report.warning(path + ": " + loss);
    std::ranges::move(saving.files, std::back_inserter(written));
  }
  return written;
}

template <class Mesh>
Saving save_mesh(const Mesh& coat, const std::string& path, const SaveOptions& form) {
  save(coat, path, form);
  return {{path}, "", losses(coat, extension_of(path))};
}

bool has_corner_normals(const TriangleMesh& coat) {
  const Attribute* normal = coat.find("normal");
  return normal && normal->domain == Domain::corner;
}

/// Where normals belong to corners of their own, the surface stays closed; elsewhere it does so without them.
Saving save_surface(TriangleMesh coat, const std::string& path, const SaveOptions& form) {
  const std::string extension = lower_extension(path);
  if (has_corner_normals(coat) && extension != ".glb" && extension != ".obj")
    std::erase_if(coat.attributes, [](const Attribute& a) { return a.name == "normal"; });
  return save_mesh(coat, path, form);
}

/// With the progress of drawing that file.
Image draw_with(const Progress& progress, const std::string& path, const std::function<Image(const Progress&)>& draw) {
  const std::string task = "drawing " + path;
  return interruptible("before " + path + " was written", [&] {
    return draw([&](std::string_view, double fraction) { return progress(task, fraction); });
  });
}

Saving save_with_textures(const Grown& grown, const std::string& path, const SaveOptions& form) {
  PolygonMesh mesh = grown.textured ? *grown.textured : polygons_of(grown.coat);
  std::vector<std::string> files = save_textured(mesh, path, form, *grown.textures);
  erase_imaged(mesh.attributes, grown.textures->maps[0]);
  return {std::move(files), "", losses(mesh, extension_of(path))};
}

}  // namespace

void write_files(const GrowOptions& options, const Grown& grown, const ShapeFile& file, bool keep_shape,
                 const SaveOptions& form, const Progress& progress, GrowReport& report) {
  const auto save_as = [&](const std::string& path) -> Saving {
    if (grown.image || (grown.patches && is_node_output(path))) {
      write_png(grown.image ? *grown.image : *grown.patches->image, path);
      return {{path}, "", {}};
    }
    if (grown.textures && options.bake) return save_with_textures(grown, path, form);
    if (is_node_output(path))
      return {{path}, save_nodes(*grown.nodes, grown.at_nodes ? *grown.at_nodes : grown.coat, path), {}};
    if (!keep_shape || grown.shape->triangles.empty()) return save_surface(grown.coat, path, form);
    return save_mesh(coat_in_file(grown, file), path, form);
  };
  const std::vector<std::string> written = write_outputs(options.outputs, save_as, progress, report);
  if (!options.patch_images.empty())
    for (const std::string& path : save_patches(*grown.patches, options.patch_images)) report.file(path);
  if (options.baked_maps.empty()) return;
  progress("writing " + options.baked_maps + "-color.png and the others", 0);
  for (const MapFile& map : save_maps(*grown.textures, options.baked_maps, written)) report.file(map.path, map.about);
}

namespace {

/// A picture of it is its nodes as pixels.
bool shows_nodes(const Grid* grid) { return grid && grid->dimension() < 3 && is_flat(*grid); }

}  // namespace

Image draw_coat(const TriangleMesh& coat, const GrowOptions& options, const ShapeFile& file,
                const PictureOptions& picture, const Progress& progress) {
  const Grid* grid = as<Grid>(file.nodes);
  if (shows_nodes(grid)) return picture_of_nodes(*grid, coat, options.preview, options.picture_size);
  return render(has_corner_normals(coat) ? split_corners(coat) : coat, picture, progress);
}

namespace {

PictureFile take_coat(const GrowOptions& options, const Grown& grown, const ShapeFile& file,
                      const PictureOptions& picture, const Progress& progress) {
  const Grid* grid = as<Grid>(file.nodes);
  const bool flat = grown.image || shows_nodes(grid);
  if (flat && options.view.turntable)
    throw Error(Fault::usage, "--turntable goes around shapes, and a flat grid has no other side; leave it out");
  std::optional<PictureScene> scene;
  if (!flat) scene.emplace(has_corner_normals(grown.coat) ? split_corners(grown.coat) : grown.coat);
  return take_pictures(options.picture, options.view, picture, [&](const PictureOptions& one) {
    return draw_with(progress, options.picture, [&](const Progress& p) {
      if (scene) return scene->render(one, p);
      return grown.image ? picture_of_nodes(*grid, *grown.image, options.preview, options.picture_size)
                         : picture_of_nodes(*grid, grown.coat, options.preview, options.picture_size);
    });
  });
}

}  // namespace

void write_pictures(const GrowOptions& options, const Recipe& recipe, const Grown& grown, const ShapeFile& file,
                    const PictureOptions& picture, const Progress& progress, GrowReport& report) {
  if (!options.picture.empty()) {
    const PictureFile taken = take_coat(options, grown, file, picture, progress);
    report.file(taken.path, taken.about);
  }
  if (options.panels.empty()) return;
  write_png(draw_with(progress, options.panels,
                      [&](const Progress& p) { return four_panels(recipe, *grown.shape, grown.coat, picture, p); }),
            options.panels);
  report.file(options.panels);
}

}  // namespace pelage
