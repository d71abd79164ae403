#pragma once
// Coats on sewn patches as images, and on meshes with images.

#include <memory>
#include <string>
#include <vector>

#include "look/patch_texture.h"
#include "pelage/io.h"

namespace pelage {

inline constexpr int default_texture = 2048;  ///< texels along a side

struct PatchTexture {
  std::shared_ptr<const Atlas> atlas;
  PatchLayout layout;
  std::vector<Image> patches;
  std::shared_ptr<const Image> image;  ///< of all patches
};

/// Errors of lay_out and patch_images.
PatchTexture patch_texture(const CoatFields& fields, const Look& look, int size);

/// The coat with "uv", for formats that hold a texture.
TriangleMesh with_uv(TriangleMesh coat, const PatchTexture& texture);

/// The image itself as .png; the coat in a format of meshes, with the texture of `form`, if any, in GLB or beside OBJ.
/// Returns the paths of all files.
std::vector<std::string> save_textured(const TriangleMesh& coat, const std::string& path, const SaveOptions& form,
                                       const PatchTexture& texture);

/// PATCH.png for each, in a folder that is made if need be; their paths.
std::vector<std::string> save_patches(const PatchTexture& texture, const std::string& folder);

}  // namespace pelage
