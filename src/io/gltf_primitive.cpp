#include "io/gltf_primitive.h"

#include <utility>

namespace pelage {

namespace {

GltfMode mode_of(const GltfDocument& document, const GltfJson& primitive) {
  return static_cast<GltfMode>(document.index(primitive, "mode").value_or(4));
}

}  // namespace

bool has_triangles(const GltfDocument& document, const GltfJson& primitive) {
  const std::size_t mode = document.index(primitive, "mode").value_or(4);
  return mode >= 4 && mode <= 6;
}

GltfPrimitive::GltfPrimitive(GltfDocument& document, const GltfJson& json, std::string label)
    : document_(document), json_(json), label_(std::move(label)) {
  if (const GltfJson* names = document.find(json, "attributes")) attributes_ = names_of(*names);
  const auto position = attributes_.find("POSITION");
  if (position == attributes_.end()) document.fail(label_ + " has no POSITION");
  // Where plain data are there as well, nothing needs to be unpacked.
  if (document.extension(json, "KHR_draco_mesh_compression") && !has_plain_data(document, position->second)) unpack();
  positions_.emplace(attribute("POSITION"));
  if (positions_->components() != 3) document.fail(label_ + " has a POSITION that is not a VEC3");
}

std::map<std::string, std::size_t> GltfPrimitive::names_of(const GltfJson& object) const {
  std::map<std::string, std::size_t> names;
  if (object.is_object())
    for (const auto& [name, value] : object.items())
      if (const auto accessor = document_.index(object, name.c_str())) names[name] = *accessor;
  return names;
}

void GltfPrimitive::unpack() {
  std::map<std::string, int> components;
  for (const auto& [name, accessor] : attributes_)
    components[name] = GltfAccessor(document_, accessor, {}).components();
  draco_ = unpack_draco(document_, *document_.extension(json_, "KHR_draco_mesh_compression"), components, label_);
}

GltfAccessor GltfPrimitive::attribute(const std::string& name) const {
  const std::size_t accessor = attributes_.at(name);
  const bool packed = draco_ && draco_->attributes.contains(name);
  GltfAccessor result =
      packed ? GltfAccessor(document_, accessor, draco_->attributes.at(name)) : GltfAccessor(document_, accessor);
  if (positions_ && result.count() != vertices())
    document_.fail(label_ + " has " + std::to_string(result.count()) + " values of " + name + " for " +
                   std::to_string(vertices()) + " vertices");
  return result;
}

std::vector<std::optional<GltfAccessor>> GltfPrimitive::changes(const std::string& name) const {
  std::vector<std::optional<GltfAccessor>> result;
  const GltfJson* targets = document_.find(json_, "targets");
  if (!targets || !targets->is_array()) return result;
  for (const GltfJson& target : *targets) {
    const auto accessor = document_.index(target, name.c_str());
    if (!accessor) {
      result.emplace_back();
      continue;
    }
    result.emplace_back(GltfAccessor(document_, *accessor));
    if (result.back()->count() != vertices())
      document_.fail(label_ + " has a morph target of " + std::to_string(result.back()->count()) + " values for " +
                     std::to_string(vertices()) + " vertices");
  }
  return result;
}

std::vector<std::uint32_t> GltfPrimitive::corners() const {
  if (draco_) return draco_->corners;
  std::vector<std::uint32_t> corners;
  const auto accessor = document_.index(json_, "indices");
  if (!accessor) {
    for (std::size_t i = 0; i < vertices(); ++i) corners.push_back(static_cast<std::uint32_t>(i));
    return corners;
  }
  const GltfAccessor indices(document_, *accessor);
  if (!indices.is_unsigned()) document_.fail(label_ + " has indices that are no unsigned integers");
  corners.reserve(indices.count());
  for (std::size_t i = 0; i < indices.count(); ++i) corners.push_back(indices.index(i));
  return corners;
}

std::vector<std::uint32_t> GltfPrimitive::triangles(std::size_t& left_over) const {
  std::vector<std::uint32_t> c = corners();
  for (const std::uint32_t v : c)
    if (v >= vertices())
      document_.fail(label_ + " has index " + std::to_string(v) + ", but its vertices are 0 to " +
                     std::to_string(static_cast<std::int64_t>(vertices()) - 1));
  const GltfMode mode = draco_ ? GltfMode::triangles : mode_of(document_, json_);
  if (mode == GltfMode::triangles) {
    left_over = c.size() % 3;
    c.resize(c.size() - left_over);
    return c;
  }
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i + 2 < c.size(); ++i) {
    const bool fan = mode == GltfMode::fan;
    const std::uint32_t a = fan ? c[0] : c[i], b = fan ? c[i + 1] : c[i + 1 + i % 2],
                        d = fan ? c[i + 2] : c[i + 2 - i % 2];
    if (a != b && b != d && d != a) result.insert(result.end(), {a, b, d});
  }
  left_over = c.size() < 3 ? c.size() : 0;
  return result;
}

}  // namespace pelage
