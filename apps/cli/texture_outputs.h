#pragma once
// Coats as images on meshes: on the uv of a surface, and on sewn patches.

#include <memory>
#include <string>
#include <vector>

#include "look/bake.h"
#include "look/patch_texture.h"
#include "pelage/io.h"
#include "pelage/progress.h"

namespace pelage {

inline constexpr int smallest_texture = 16, default_texture = 2048, largest_texture = 16384;  ///< texels along a side
inline constexpr double bytes_of_a_texel = 29;  ///< that baking and writing colours and heights need at once, about

/// The images of a mesh.
struct CoatTextures {
  std::vector<int> tiles = {1001};          ///< their numbers; a single one is none that files need to name
  std::vector<TextureMaps> maps;            ///< of each tile
  std::vector<std::vector<float>> heights;  ///< of each tile, as of BakedTile; empty for patches
  std::vector<std::vector<Pixels>> levels;  ///< of the colours of each tile, from the first smaller copy on, or empty
  bool repeat = false;
  int size = 0;
};

// --- patches -------------------------------------------------------------------------------------------

struct PatchTexture {
  std::shared_ptr<const Atlas> atlas;
  PatchLayout layout;
  std::vector<Image> patches;
  std::shared_ptr<const Image> image;  ///< of all patches
};

/// Errors of lay_out and patch_images.
PatchTexture patch_texture(const CoatFields& fields, const Look& look, int size);

CoatTextures textures_of(const PatchTexture& texture);

/// The coat with "uv", for formats that hold a texture.
TriangleMesh with_uv(TriangleMesh coat, const PatchTexture& texture);

/// PATCH.png for each, in a folder that is made if need be; their paths.
std::vector<std::string> save_patches(const PatchTexture& texture, const std::string& folder);

// --- surfaces ------------------------------------------------------------------------------------------

/// Of a shape that the run has, for images of that size. Error(Fault::usage) where it has no uv.
UvLayout uv_layout(const TriangleMesh& shape, int size);

/// Refuses images for which there is no memory, so that nothing is grown in vain: Error(Fault::numerics) with what they
/// need. `look`: of the coat; `normals`: whether there is a normal map.
void require_memory(const UvLayout& layout, const Look& look, bool normals);

/// What there is to say where texels are too long for a pattern of that wavelength, or "".
std::string too_coarse(const TriangleMesh& shape, int size, double wavelength);

/// The file's face of a triangle that it was cut into; without a file the triangle.
std::size_t face_in_file(Index triangle, const TriangleMesh& shape, const SourceShape* source);

/// What there is to say of it, a line each. Faces are counted as in the file.
std::vector<std::string> lines_of(const std::vector<UvNote>& notes, const TriangleMesh& shape,
                                  const SourceShape* source);

CoatTextures textures_of(BakedCoat baked, const UvLayout& layout);

// --- files ---------------------------------------------------------------------------------------------

/// Refuses what cannot be written: Error(Fault::usage) for a format of meshes that holds no texture,
/// Error(Fault::output) for the folder.
void check_textured_path(const std::string& path);
void check_maps(const std::string& prefix);

/// The mesh with its textures: in GLB, or beside OBJ as .mtl and .png. Returns the paths of all files.
std::vector<std::string> save_textured(PolygonMesh mesh, const std::string& path, SaveOptions form,
                                       const CoatTextures& textures);

/// A file that was written, and what must be known to read it.
struct MapFile {
  std::string path, about;
};

/// PREFIX-color.png and the others that there are; of tiles PREFIX-color.1001.png and so on. Those among
/// `written`, which lie beside a mesh of these textures already, are not written again.
std::vector<MapFile> save_maps(const CoatTextures& textures, const std::string& prefix,
                               const std::vector<std::string>& written);

}  // namespace pelage
