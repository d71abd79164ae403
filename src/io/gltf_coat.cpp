#include "io/gltf_coat.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "pelage/channel.h"

namespace pelage {

namespace {

std::optional<Channel> channel_of(const Attribute& a) {
  for (const ChannelKind& kind : channel_kinds)
    if (a.name == kind.attribute && a.domain == Domain::vertex && a.components == 1 && !a.values.empty())
      return kind.channel;
  return {};
}

const Attribute* find(const TriangleMesh& mesh, Channel channel) {
  const Attribute* a = mesh.find(kind_of(channel).attribute);
  return a && channel_of(*a) ? a : nullptr;
}

bool is_constant(const Attribute& a) {
  const auto [low, high] = std::ranges::minmax(a.values);
  return low == high;
}

double mean(const TriangleMesh& mesh, Channel channel) {
  const Attribute* a = find(mesh, channel);
  if (!a) return kind_of(channel).usual;
  if (is_constant(*a)) return a->values[0];
  return std::accumulate(a->values.begin(), a->values.end(), 0.0) / static_cast<double>(a->values.size());
}

bool has_color(const TriangleMesh& mesh) {
  const Attribute* color = mesh.find("color");
  return color && color->domain == Domain::vertex && color->components >= 3;
}

void set_extension(tinygltf::Model& model, tinygltf::Material& material, const std::string& name,
                   const tinygltf::Value::Object& values) {
  material.extensions[name] = tinygltf::Value(values);
  if (std::ranges::count(model.extensionsUsed, name) == 0) model.extensionsUsed.push_back(name);
}

tinygltf::Value number_value(double x) { return tinygltf::Value(x); }

/// Emission times colour.
void set_emission(const TriangleMesh& mesh, tinygltf::Model& model, tinygltf::Material& material) {
  const Attribute *emission = find(mesh, Channel::emission), *color = has_color(mesh) ? mesh.find("color") : nullptr;
  if (!emission) return;
  std::vector<double> sum(3, 0.0);
  const std::size_t count = emission->values.size();
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += emission->values[v] * (color ? color->values[v * static_cast<std::size_t>(color->components) + k] : 1);
  for (double& x : sum) x /= static_cast<double>(count);
  const double strength = *std::ranges::max_element(sum);
  if (strength > 1)
    for (double& x : sum) x /= strength;
  set_emission_strength(model, material, strength);
  material.emissiveFactor = sum;
}

}  // namespace

void set_emission_strength(tinygltf::Model& model, tinygltf::Material& material, double strength) {
  if (strength > 1)
    set_extension(model, material, "KHR_materials_emissive_strength", {{"emissiveStrength", number_value(strength)}});
}

void set_glass(tinygltf::Model& model, tinygltf::Material& material, int texture, std::optional<double> deepest) {
  const tinygltf::Value reference(tinygltf::Value::Object{{"index", tinygltf::Value(texture)}});
  set_extension(model, material, "KHR_materials_transmission",
                {{"transmissionFactor", number_value(1)}, {"transmissionTexture", reference}});
  if (deepest)
    set_extension(model, material, "KHR_materials_volume",
                  {{"thicknessFactor", number_value(*deepest)}, {"thicknessTexture", reference}});
}

void set_coat(const TriangleMesh& mesh, tinygltf::Model& model, tinygltf::Material& material) {
  material.pbrMetallicRoughness.metallicFactor = mean(mesh, Channel::metalness);
  material.pbrMetallicRoughness.roughnessFactor = mean(mesh, Channel::roughness);
  set_emission(mesh, model, material);
  if (const double transmission = mean(mesh, Channel::transmission); transmission > 0) {
    set_extension(model, material, "KHR_materials_transmission", {{"transmissionFactor", number_value(transmission)}});
    if (const double thickness = mean(mesh, Channel::thickness); thickness > 0)
      set_extension(model, material, "KHR_materials_volume", {{"thicknessFactor", number_value(thickness)}});
  }
  const Attribute* opacity = find(mesh, Channel::opacity);
  if (!opacity || std::ranges::min(opacity->values) >= 1) return;
  material.alphaMode = "BLEND";
  if (!has_color(mesh)) material.pbrMetallicRoughness.baseColorFactor = {1, 1, 1, mean(mesh, Channel::opacity)};
}

TriangleMesh without_told_channels(TriangleMesh mesh) {
  const Attribute* opacity = find(mesh, Channel::opacity);
  Attribute* color = has_color(mesh) ? mesh.find("color") : nullptr;
  if (opacity && color && color->components == 3) {
    std::vector<double> values;
    for (std::size_t v = 0; v < opacity->values.size(); ++v) {
      values.insert(values.end(), color->values.begin() + static_cast<std::ptrdiff_t>(3 * v),
                    color->values.begin() + static_cast<std::ptrdiff_t>(3 * v + 3));
      values.push_back(opacity->values[v]);
    }
    color->values = std::move(values);
    color->components = 4;
  }
  std::erase_if(mesh.attributes, [](const Attribute& a) { return channel_of(a) && unseen_in_gltf(a).empty(); });
  return mesh;
}

void erase_imaged(std::vector<Attribute>& attributes, const TextureMaps& maps) {
  const std::map<Channel, bool> has_image = {
      {Channel::height, maps.normal != nullptr},       {Channel::roughness, maps.roughness != nullptr},
      {Channel::metalness, maps.metalness != nullptr}, {Channel::opacity, maps.opacity != nullptr},
      {Channel::emission, maps.emission != nullptr},   {Channel::transmission, maps.transmission != nullptr},
      {Channel::thickness, maps.thickness != nullptr}};
  std::erase_if(attributes, [&](const Attribute& a) {
    const std::optional<Channel> channel = channel_of(a);
    return a.name == "color" || (channel && has_image.at(*channel));
  });
}

std::string unseen_in_gltf(const Attribute& a) {
  const std::optional<Channel> channel = channel_of(a);
  if (!channel || channel == Channel::opacity) return "";
  if (channel == Channel::height) return std::ranges::any_of(a.values, [](double x) { return x != 0; }) ? a.name : "";
  return is_constant(a) ? "" : "how " + a.name + " differs from place to place";
}

}  // namespace pelage
