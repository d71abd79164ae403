#include "texture_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "base/ascii.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "io/atomic_file.h"
#include "io/exr_writer.h"
#include "io/file_bytes.h"
#include "io/ktx2_writer.h"
#include "io/mtl_writer.h"
#include "io/png_writer.h"
#include "io/read_shape.h"
#include "io/write_mesh.h"
#include "look/grid_picture.h"
#include "pelage/error.h"
#include "pelage/unwrap.h"
#include "shape/finding.h"
#include "text.h"

namespace pelage {

// --- patches -------------------------------------------------------------------------------------------

PatchTexture patch_texture(const CoatFields& fields, const Look& look, int size) {
  PatchTexture texture;
  texture.atlas = std::shared_ptr<const Atlas>(fields.nodes, as<Atlas>(fields.nodes));
  texture.layout = lay_out(*texture.atlas, size);
  texture.patches = patch_images(fields, look, texture.layout);
  texture.image = std::make_shared<const Image>(joined(texture.patches, texture.layout));
  return texture;
}

namespace {

std::shared_ptr<const Pixels> bytes_of(const Image& image) {
  auto pixels = std::make_shared<Pixels>(Pixels{image.width, image.height, 3, {}});
  pixels->bytes.reserve(image.rgb.size());
  const SrgbBytes srgb;
  for (const float x : image.rgb) pixels->bytes.push_back(srgb(x));
  return pixels;
}

}  // namespace

CoatTextures textures_of(const PatchTexture& texture) {
  CoatTextures textures;
  textures.maps = {{bytes_of(*texture.image)}};
  textures.size = texture.layout.size;
  return textures;
}

TriangleMesh with_uv(TriangleMesh coat, const PatchTexture& texture) {
  coat.set(patch_uv(*texture.atlas, texture.layout));
  return coat;
}

namespace {

/// Names of patches are anything.
std::string file_name(const std::string& patch) {
  std::string name = patch;
  for (char& c : name)
    if (!is_letter_or_digit(c) && c != '-' && c != '_') c = '_';
  return name + ".png";
}

}  // namespace

std::vector<std::string> save_patches(const PatchTexture& texture, const std::string& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (reason) throw Error(Fault::output, "the folder cannot be made: " + reason.message(), {folder});
  std::vector<std::string> paths;
  for (std::size_t p = 0; p < texture.patches.size(); ++p) {
    std::string path = (std::filesystem::path(folder) / file_name(texture.atlas->patches[p].name)).string();
    if (std::ranges::count(paths, path) > 0)
      throw Error(Fault::output, "two patches would be written there; give them other names", {path});
    write_png(texture.patches[p], path);
    paths.push_back(std::move(path));
  }
  return paths;
}

// --- surfaces ------------------------------------------------------------------------------------------

namespace {

/// Of all tiles; `more`: bytes of a texel beside colour and height.
double bytes_of_images(int size, std::size_t tiles, double more) {
  constexpr double color_and_height = 7, with_files = 1.6;  // measured with all images, which go into files, too
  return static_cast<double>(size) * size *
         (bytes_of_a_texel + with_files * more + (color_and_height + more) * static_cast<double>(tiles - 1));
}

}  // namespace

void require_memory(const UvLayout& layout, const Look& look, bool normals) {
  double more = normals ? 3 : 0;
  for (const auto& [channel, formula] : look.channels)
    more += channel == Channel::emission ? 3 : channel == Channel::height ? 0 : 1;
  const std::size_t tiles = layout.tiles().size();
  const auto needed = [&](int size) { return bytes_of_images(size, tiles, more); };
  const double left = memory_left();
  int smaller = layout.size() / 2;
  while (smaller > smallest_texture && needed(smaller) > left) smaller /= 2;
  const std::string size = std::to_string(layout.size());
  require_memory(needed(layout.size()),
                 "baking " + size + " x " + size + " texels" + (tiles > 1 ? " on " + counted(tiles, "tile") : ""),
                 "--bake " + std::to_string(smaller) + " needs " + bytes_in_words(needed(smaller)));
}

std::string too_coarse(const TriangleMesh& shape, int size, double wavelength) {
  constexpr double enough = 12,
                   share = 0.05;  // texels of a wave, between which lookups are right to 3/255; of the area
  const double texel = texel_length(shape, *shape.find("uv"), size, share);
  if (!(wavelength > 0) || enough * texel <= wavelength) return "";
  int factor = 2;
  while (enough * texel > factor * wavelength && factor <= largest_texture) factor *= 2;
  const auto waves = [&](int times) { return fixed_number(times * wavelength / texel, 1); };
  return "with --bake " + std::to_string(size) + " a wave of the pattern has " + waves(1) + " texels or fewer on " +
         brief(100 * share) + " % of the surface; " +
         (size * factor <= largest_texture ? "--bake " + std::to_string(size * factor) + " would give " + waves(factor)
                                           : "an atlas that stretches less would give more, see pelage unwrap");
}

UvLayout uv_layout(const TriangleMesh& shape, int size) {
  if (!has_uv(shape))
    throw Error(Fault::usage,
                "the shape has no uv, which says where an image lies on it; pelage unwrap SHAPE -o FILE.obj makes one");
  return UvLayout(shape.triangles, *shape.find("uv"), size);
}

std::size_t face_in_file(Index triangle, const TriangleMesh& shape, const SourceShape* source) {
  if (!source) return static_cast<std::size_t>(triangle);
  Triangle corners = shape.triangles[static_cast<std::size_t>(triangle)];
  std::ranges::sort(corners);
  const PolygonMesh& file = source->polygons;
  for (std::size_t f = 0; f < file.face_count(); ++f) {
    std::vector<std::int32_t> own(source->vertex.begin() + static_cast<std::ptrdiff_t>(file.face_begin(f)),
                                  source->vertex.begin() + static_cast<std::ptrdiff_t>(file.face_ends[f]));
    std::ranges::sort(own);
    if (std::ranges::includes(own, corners)) return f;
  }
  return static_cast<std::size_t>(triangle);
}

namespace {

/// "12 triangles, the first one of face 17, ".
std::string line_of(const UvNote& note, std::size_t face) {
  const std::string faces = counted(note.count, "triangle") + " of the uv, " +
                            (note.count > 1 ? "the first one of" : "of") + " face " + std::to_string(face) + ", ";
  const bool one = note.count == 1;
  switch (note.kind) {
    case UvNote::Kind::degenerate:
      return faces + (one ? "has" : "have") + " no area there: no texel shows " + (one ? "it" : "them");
    case UvNote::Kind::mirrored:
      return faces + (one ? "is" : "are") + " mirrored there";
    case UvNote::Kind::outside:
      return faces + (one ? "lies" : "lie") + " across the border of the image, which therefore repeats";
    case UvNote::Kind::overlapping:
      return faces + (one ? "lies" : "lie") + " over others, which alone the image shows";
  }
  return "";
}

}  // namespace

std::vector<std::string> lines_of(const std::vector<UvNote>& notes, const TriangleMesh& shape,
                                  const SourceShape* source) {
  std::vector<std::string> lines;
  for (const UvNote& note : notes)
    if (note.count > 0) lines.push_back(line_of(note, face_in_file(note.first, shape, source)));
  return lines;
}

CoatTextures textures_of(BakedCoat baked, const UvLayout& layout) {
  CoatTextures textures;
  textures.tiles = layout.tiles();
  textures.repeat = layout.repeats();
  textures.size = layout.size();
  for (BakedTile& tile : baked.tiles) {
    textures.heights.push_back(std::move(tile.height));
    textures.maps.push_back(maps_of(std::move(tile), baked.scales));
  }
  return textures;
}

// --- files ---------------------------------------------------------------------------------------------

namespace {

struct NamedMap {
  std::string name;  ///< as files are called
  std::shared_ptr<const Pixels> pixels;
  std::string about = {};  ///< what must be known to read it
};

/// Those that there are.
std::vector<NamedMap> named_maps(const TextureMaps& maps) {
  std::vector<NamedMap> named = {{"color", maps.color},         {"normal", maps.normal},
                                 {"roughness", maps.roughness}, {"metalness", maps.metalness},
                                 {"opacity", maps.opacity},     {"transmission", maps.transmission}};
  const auto scaled = [](double white) { return white == 1 ? "" : "white is " + number(white); };
  named.push_back({"emission", maps.emission, scaled(maps.emission_strength)});
  named.push_back({"thickness", maps.thickness, scaled(maps.deepest)});
  std::erase_if(named, [](const NamedMap& map) { return !map.pixels; });
  return named;
}

/// Of meshes whose format holds textures, or has them beside it.
bool holds_textures(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".glb" || extension == ".obj";
}

/// "PREFIX.png", or "PREFIX.1001.png" of one of several tiles.
std::string tile_file(const CoatTextures& textures, std::size_t tile, const std::string& prefix,
                      const std::string& extension = ".png") {
  return prefix + (textures.tiles.size() > 1 ? "." + std::to_string(textures.tiles[tile]) : "") + extension;
}

/// A material for each tile; where there is one, those of the mesh, or else one.
void set_materials(PolygonMesh& mesh, const CoatTextures& textures) {
  const Attribute* own = mesh.find("material");
  const std::size_t tiles = textures.tiles.size();
  if (tiles == 1 && own && own->domain == Domain::face && !own->labels.empty()) return;
  Attribute material{"material", 1, Domain::face, std::vector<double>(mesh.face_count()), NumberType::int32, {}};
  if (tiles == 1) material.labels = {"coat"};
  for (std::size_t i = 0; tiles > 1 && i < tiles; ++i)
    material.labels.push_back("coat." + std::to_string(textures.tiles[i]));
  const Attribute* uv = tiles > 1 ? mesh.find("uv") : nullptr;
  for (std::size_t f = 0; uv && f < mesh.face_count(); ++f) {
    std::array<double, 2> middle{};
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_ends[f]; ++c)
      for (std::size_t k = 0; k < 2; ++k)
        middle[k] +=
            uv->values[2 * (uv->domain == Domain::corner ? c : static_cast<std::size_t>(mesh.corners[c])) + k] /
            static_cast<double>(mesh.face_size(f));
    const int number = 1001 + static_cast<int>(std::floor(middle[0])) + 10 * static_cast<int>(std::floor(middle[1]));
    const auto found = std::ranges::find(textures.tiles, number);
    if (found != textures.tiles.end()) material.values[f] = static_cast<double>(found - textures.tiles.begin());
  }
  mesh.set(std::move(material));
}

/// Beside the .obj a .mtl with its materials and the images that these name.
std::vector<std::string> save_textured_obj(PolygonMesh mesh, const std::string& path, const SaveOptions& form,
                                           const CoatTextures& textures) {
  const std::filesystem::path stem = std::filesystem::path(path).replace_extension();
  const std::string library = stem.string() + ".mtl";
  std::erase_if(mesh.attributes, [](const Attribute& a) { return a.name == "color"; });
  mesh.links = {{"mtllib", std::filesystem::path(library).filename().string()}};
  std::vector<std::string> files = {path, library};
  std::vector<MtlMaps> maps;
  for (std::size_t t = 0; t < textures.maps.size(); ++t) {
    const auto save_image = [&](const std::shared_ptr<const Pixels>& pixels, const std::string& end) -> std::string {
      files.push_back(tile_file(textures, t, stem.string() + "-" + end));
      write_png(*pixels, files.back());
      return std::filesystem::path(files.back()).filename().string();
    };
    MtlMaps& own = maps.emplace_back();
    for (const NamedMap& map : named_maps(textures.maps[t])) own[map.name] = save_image(map.pixels, map.name);
  }
  std::string text;
  const std::vector<std::string>& materials = mesh.find("material")->labels;
  for (std::size_t i = 0; i < materials.size(); ++i)
    text += mtl_text(materials[i], maps[textures.tiles.size() > 1 ? i : 0], textures.maps[0].emission_strength);
  write_file(library, text);
  save(mesh, path, form);
  return files;
}

}  // namespace

void check_textured_path(const std::string& path) {
  if (!holds_textures(path))
    throw Error(Fault::usage, path +
                                  ": no format but GLB, and OBJ with its files beside it, shows an image on a mesh; "
                                  "leave --bake out for colours at the vertices");
}

void check_maps(const std::string& prefix) {
  const std::string name = std::filesystem::path(prefix).filename().string();
  if (name.empty())
    throw Error(Fault::usage,
                "--maps " + prefix + ": expected how the names of the images begin, for example " + prefix + "coat");
  expect_output(prefix + "-color.png");
}

std::vector<std::string> save_textured(PolygonMesh mesh, const std::string& path, SaveOptions form,
                                       const CoatTextures& textures) {
  if (lower_extension(path) == ".obj" || textures.tiles.size() > 1) set_materials(mesh, textures);
  if (lower_extension(path) == ".obj") return save_textured_obj(std::move(mesh), path, form, textures);
  form.textures = textures.maps;
  form.repeat = textures.repeat;
  save(mesh, path, form);
  return {path};
}

namespace {

/// Of all tiles, so that one grey is one height.
std::pair<double, double> range_of(const std::vector<std::vector<float>>& heights) {
  float low = heights[0][0], high = low;
  for (const std::vector<float>& tile : heights) {
    const auto [least, most] = std::ranges::minmax(tile);
    low = std::min(low, least);
    high = std::max(high, most);
  }
  return {low, high};
}

}  // namespace

std::vector<MapFile> save_maps(const CoatTextures& textures, const std::string& prefix,
                               const std::vector<std::string>& written) {
  std::vector<MapFile> files;
  std::vector<std::function<void()>> tasks;
  const auto add = [&](std::size_t tile, const std::string& name, const std::string& extension,
                       const std::string& about, const std::function<void(const std::string&)>& write) {
    const std::string path = tile_file(textures, tile, prefix + "-" + name, extension);
    files.push_back({path, about});
    if (std::ranges::any_of(written, [&](const std::string& w) { return true_path(w) == true_path(path); })) return;
    tasks.emplace_back([write, path = files.back().path] { write(path); });
  };
  for (std::size_t t = 0; t < textures.maps.size(); ++t) {
    for (const NamedMap& map : named_maps(textures.maps[t]))
      add(t, map.name, ".png", map.about, [pixels = map.pixels](const std::string& path) { write_png(*pixels, path); });
    if (!textures.levels.empty())
      add(t, "color", ".ktx2", counted(textures.levels[t].size() + 1, "level"),
          [&textures, t](const std::string& path) {
            std::vector<const Pixels*> levels = {textures.maps[t].color.get()};
            for (const Pixels& level : textures.levels[t]) levels.push_back(&level);
            write_file(path, ktx2_bytes(levels));
          });
    if (textures.heights.empty()) continue;
    const std::vector<float>& heights = textures.heights[t];
    const auto [low, high] = range_of(textures.heights);
    add(t, "height", ".png", "black is " + number(low) + " and white " + number(high),
        [&heights, low = low, high = high, n = textures.size](const std::string& path) {
          const std::vector<double> values(heights.begin(), heights.end());
          write_file(path, grey_png_bytes(n, n, greys(values, low, high), path));
        });
    add(t, "height", ".exr", "",
        [&heights, n = textures.size](const std::string& path) { write_exr(path, {"Y"}, {heights}, n, n); });
  }
  parallel_chunks(tasks.size(), [&](std::size_t i) { tasks[i](); });
  return files;
}

}  // namespace pelage
