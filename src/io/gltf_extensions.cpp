#include "io/gltf_extensions.h"

#include <algorithm>
#include <string_view>

#include "base/suggest.h"

namespace pelage {

namespace {

constexpr std::string_view understood[] = {
    "KHR_mesh_quantization",   "KHR_texture_transform",   "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
    "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_node_visibility",     "KHR_accessor_float64"};

// What these add is light, sound, motion, pictures or remarks: the surface and its attributes are the same without.
constexpr std::string_view without_shape[] = {
    "KHR_materials_", "EXT_materials_",    "KHR_texture_basisu", "EXT_texture_", "MSFT_texture_",  "KHR_lights_",
    "EXT_lights_",    "KHR_xmp",           "KHR_animation_",     "KHR_audio",    "KHR_techniques", "MSFT_packing_",
    "MSFT_audio",     "GODOT_single_root", "KHR_interactivity"};

bool is_known(std::string_view name) {
  return std::ranges::count(understood, name) > 0 ||
         std::ranges::any_of(without_shape, [&](std::string_view prefix) { return name.starts_with(prefix); });
}

}  // namespace

void check_extensions(const GltfDocument& document, std::vector<Finding>& findings) {
  std::vector<std::string> required = document.texts(document.root(), "extensionsRequired"),
                           used = document.texts(document.root(), "extensionsUsed");
  std::erase_if(required, is_known);
  std::erase_if(used, is_known);
  if (!required.empty())
    document.fail("requires " + join_names(required) + ", which " +
                  (required.size() == 1 ? "is not an extension" : "are not extensions") +
                  " of glTF that can be read; export without");
  if (!used.empty())
    findings.push_back({"unknown-extensions",
                        counted(used.size(), "unknown extension") + " (" + join_names(used) +
                            "); what the file says with it is left out",
                        used.size(), 0, true});
}

}  // namespace pelage
