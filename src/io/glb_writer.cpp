#include "io/glb_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>

#include "base/ascii.h"
#include "base/random.h"
#include "pelage/error.h"
#include "shape/split_corners.h"

namespace pelage {

namespace {

/// Appends an array to the only buffer and describes it; returns the number of its accessor.
template <class T>
int add_array(tinygltf::Model& model, const std::vector<T>& values, int components, int component_type, int target) {
  std::vector<unsigned char>& data = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = values.size() * sizeof(T);
  view.target = target;
  data.resize(view.byteOffset + view.byteLength);
  if (!values.empty()) std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.componentType = component_type;
  accessor.count = values.size() / components;
  accessor.type = components == 1 ? TINYGLTF_TYPE_SCALAR : components;  // TINYGLTF_TYPE_VEC2..4 are 2..4
  model.bufferViews.push_back(view);
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_floats(tinygltf::Model& model, const std::vector<float>& values, int components) {
  return add_array(model, values, components, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER);
}

int add_positions(tinygltf::Model& model, const std::vector<Point>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  std::vector<double> low(3, std::numeric_limits<float>::max()), high(3, std::numeric_limits<float>::lowest());
  for (const Point& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      values.push_back(static_cast<float>(p[k]));
      low[k] = std::min<double>(low[k], values.back());
      high[k] = std::max<double>(high[k], values.back());
    }
  }
  const int accessor = add_floats(model, values, 3);
  model.accessors[accessor].minValues = low;
  model.accessors[accessor].maxValues = high;
  return accessor;
}

int add_normals(tinygltf::Model& model, const Attribute& normal) {
  std::vector<float> values;
  values.reserve(normal.values.size());
  for (std::size_t i = 0; i < normal.values.size(); i += 3) {
    const double* n = normal.values.data() + i;
    const double length = std::hypot(n[0], n[1], n[2]);
    for (std::size_t k = 0; k < 3; ++k)
      values.push_back(length > 0 ? static_cast<float>(n[k] / length) : k == 1 ? 1.0F : 0.0F);
  }
  return add_floats(model, values, 3);
}

int add_colors(tinygltf::Model& model, const Attribute& color) {
  std::vector<float> values(color.values.size());
  std::transform(color.values.begin(), color.values.end(), values.begin(),
                 [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); });
  return add_floats(model, values, color.components);
}

int add_uv(tinygltf::Model& model, const Attribute& uv) {
  std::vector<float> values;
  values.reserve(uv.values.size());
  for (std::size_t i = 0; i < uv.values.size(); i += 2) {
    values.push_back(static_cast<float>(uv.values[i]));
    values.push_back(static_cast<float>(1 - uv.values[i + 1]));
  }
  return add_floats(model, values, 2);
}

/// glTF asks that the names of an application's own attributes begin with an underscore.
std::string custom_name(const std::string& name, const tinygltf::Primitive& primitive) {
  std::string clean = "_";
  for (char c : name) clean += is_letter_or_digit(c) ? to_upper(c) : '_';
  while (primitive.attributes.count(clean) != 0) clean += '_';
  return clean;
}

void add_custom(tinygltf::Model& model, tinygltf::Primitive& primitive, const Attribute& attribute) {
  const int width = attribute.components <= 4 ? attribute.components : 1;
  for (int first = 0; first < attribute.components; first += width) {
    std::vector<float> values;
    for (std::size_t i = first; i < attribute.values.size(); i += attribute.components)
      for (int k = 0; k < width; ++k) values.push_back(static_cast<float>(attribute.values[i + k]));
    const std::string suffix = width == attribute.components ? "" : "_" + std::to_string(first);
    primitive.attributes[custom_name(attribute.name + suffix, primitive)] = add_floats(model, values, width);
  }
}

void add_attribute(tinygltf::Model& model, tinygltf::Primitive& primitive, const Attribute& attribute) {
  const int n = attribute.components;
  if (attribute.name == "normal" && n == 3)
    primitive.attributes["NORMAL"] = add_normals(model, attribute);
  else if (attribute.name == "color" && (n == 3 || n == 4))
    primitive.attributes["COLOR_0"] = add_colors(model, attribute);
  else if (attribute.name == "uv" && n == 2)
    primitive.attributes["TEXCOORD_0"] = add_uv(model, attribute);
  else
    add_custom(model, primitive, attribute);
}

int add_indices(tinygltf::Model& model, const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> values;
  values.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) values.insert(values.end(), t.begin(), t.end());
  return add_array(model, values, 1, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

/// Closed and consistently oriented: every directed edge has its opposite. Compared by the sums of the hash
/// codes of all edges and of all opposites, which agree by accident once in 2^64: one pass, no memory.
bool is_closed(const std::vector<Triangle>& triangles) {
  std::uint64_t difference = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint64_t>(t[k]), b = static_cast<std::uint64_t>(t[(k + 1) % 3]);
      difference += hash(a, b) - hash(b, a);
    }
  }
  return difference == 0;
}

tinygltf::Material coat_material(bool double_sided) {
  tinygltf::Material material;
  material.name = "coat";
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 0.8;  // short hair: a broad, faint highlight
  material.doubleSided = double_sided;
  return material;
}

std::string to_bytes(const tinygltf::Model& model) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  tinygltf::TinyGLTF gltf;
  constexpr bool pretty = false, binary = true;
  if (!gltf.WriteGltfSceneToStream(&model, stream, pretty, binary) || !stream)
    throw Error(Fault::output, "the glTF library could not write the mesh");
  return std::move(stream).str();
}

}  // namespace

std::string encode_glb(const TriangleMesh& original) {
  if (original.triangles.empty()) throw Error(Fault::output, "a GLB file needs at least one triangle");
  const TriangleMesh mesh = split_corners(original);
  tinygltf::Model model;
  model.asset.generator = "pelage";
  model.buffers.resize(1);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = add_positions(model, mesh.points);
  for (const Attribute& attribute : mesh.attributes) add_attribute(model, primitive, attribute);
  primitive.indices = add_indices(model, mesh.triangles);
  constexpr std::size_t room_for_json = 1 << 20;
  if (model.buffers[0].data.size() > std::numeric_limits<std::uint32_t>::max() - room_for_json)
    throw Error(Fault::output, "a GLB file holds at most 4 GiB; write PLY instead");
  model.materials = {coat_material(!is_closed(original.triangles))};
  model.meshes.resize(1);
  model.meshes[0].primitives = {primitive};
  model.nodes.resize(1);
  model.nodes[0].mesh = 0;
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  return to_bytes(model);
}

}  // namespace pelage
