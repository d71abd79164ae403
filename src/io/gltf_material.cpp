#include "io/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pelage {

namespace {

struct UvSource {
  std::size_t set = 0;
  std::array<std::array<double, 2>, 3> map = {{{1, 0}, {0, 1}, {0, 0}}};
  bool operator==(const UvSource&) const = default;
};

/// Scaled, then turned counter-clockwise as one sees it with v downwards, then moved.
UvSource uv_source(const GltfDocument& document, const GltfJson& texture) {
  UvSource source{document.index(texture, "texCoord").value_or(0)};
  const GltfJson* transform = document.extension(texture, "KHR_texture_transform");
  if (!transform) return source;
  source.set = document.index(*transform, "texCoord").value_or(source.set);
  std::vector<double> offset = document.numbers(*transform, "offset", 2),
                      scale = document.numbers(*transform, "scale", 2);
  if (offset.empty()) offset = {0, 0};
  if (scale.empty()) scale = {1, 1};
  const double angle = document.number(*transform, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
  source.map = {{{c * scale[0], -s * scale[0]}, {s * scale[1], c * scale[1]}, {offset[0], offset[1]}}};
  return source;
}

/// The number of a texture's image.
std::optional<std::size_t> image_of(const GltfDocument& document, const GltfJson& texture) {
  const GltfJson& json = document.get("textures", document.index(texture, "index").value_or(0));
  auto image = document.index(json, "source");
  for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"})
    if (const GltfJson* other = document.extension(json, extension); other && !image)
      image = document.index(*other, "source");
  return image;
}

/// The file of an image, "?" if it lies inside the glTF.
std::string file_of(const GltfDocument& document, std::optional<std::size_t> image) {
  if (!image) return "?";
  const std::string uri = document.text(document.get("images", *image), "uri");
  return uri.empty() || uri.starts_with("data:") ? "?" : from_percent_encoding(uri);
}

}  // namespace

GltfMaterial read_material(const GltfDocument& document, std::size_t material) {
  GltfMaterial result;
  const GltfJson& json = document.get("materials", material);
  const GltfJson* pbr = document.find(json, "pbrMetallicRoughness");
  const GltfJson* glossy = document.extension(json, "KHR_materials_pbrSpecularGlossiness");
  const GltfJson& base = glossy ? *glossy : pbr ? *pbr : json;
  const std::vector<double> color = document.numbers(base, glossy ? "diffuseFactor" : "baseColorFactor", 4);
  std::copy(color.begin(), color.end(), result.base_color.begin());

  const GltfJson* base_texture = document.find(base, glossy ? "diffuseTexture" : "baseColorTexture");
  if (base_texture) {
    result.image_number = image_of(document, *base_texture);
    result.image = file_of(document, result.image_number);
  }
  std::vector<UvSource> sources;
  const std::pair<const GltfJson*, const char*> places[] = {{&base, glossy ? "diffuseTexture" : "baseColorTexture"},
                                                            {pbr, "metallicRoughnessTexture"},
                                                            {&json, "normalTexture"},
                                                            {&json, "occlusionTexture"},
                                                            {&json, "emissiveTexture"}};
  for (const auto& [owner, name] : places)
    if (const GltfJson* texture = owner ? document.find(*owner, name) : nullptr)
      sources.push_back(uv_source(document, *texture));
  if (sources.empty()) return result;
  result.uv_set = sources[0].set;
  result.uv_map = sources[0].map;
  result.other_uv = std::any_of(sources.begin(), sources.end(), [&](const UvSource& s) { return s != sources[0]; });
  return result;
}

}  // namespace pelage
