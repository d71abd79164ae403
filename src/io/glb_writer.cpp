#include "io/glb_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <locale>
#include <map>
#include <sstream>

#include "base/ascii.h"
#include "base/box.h"
#include "base/random.h"
#include "base/suggest.h"
#include "io/gltf_coat.h"
#include "io/gltf_document.h"
#include "io/gltf_record.h"
#include "io/output_set.h"
#include "pelage/error.h"
#include "pelage/io.h"
#include "shape/split_corners.h"
#include "shape/tangents.h"

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

int add_positions(tinygltf::Model& model, const std::vector<Point>& points, const Point& origin) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  std::vector<double> low(3, std::numeric_limits<float>::max()), high(3, std::numeric_limits<float>::lowest());
  for (const Point& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      values.push_back(static_cast<float>(p[k] - origin[k]));
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
    const std::string suffix = width == attribute.components ? "" : "_" + std::to_string(first + 1);
    primitive.attributes[custom_name(attribute.name + suffix, primitive)] = add_floats(model, values, width);
  }
}

/// "TEXCOORD_1" for "uv1", if there is a TEXCOORD_0, as glTF asks; "" otherwise.
std::string further_set(const std::string& name, const char* ours, const char* theirs,
                        const tinygltf::Primitive& primitive) {
  for (int n = 1; primitive.attributes.count(theirs + std::to_string(n - 1)) != 0; ++n)
    if (name == ours + std::to_string(n)) return theirs + std::to_string(n);
  return "";
}

void add_attribute(tinygltf::Model& model, tinygltf::Primitive& primitive, const Attribute& attribute) {
  const int n = attribute.components;
  const std::string uv = further_set(attribute.name, "uv", "TEXCOORD_", primitive);
  const std::string color = further_set(attribute.name, "color", "COLOR_", primitive);
  if (attribute.name == "normal" && n == 3)
    primitive.attributes["NORMAL"] = add_normals(model, attribute);
  else if (attribute.name == "color" && (n == 3 || n == 4))
    primitive.attributes["COLOR_0"] = add_colors(model, attribute);
  else if (attribute.name == "uv" && n == 2)
    primitive.attributes["TEXCOORD_0"] = add_uv(model, attribute);
  else if (!uv.empty() && n == 2)
    primitive.attributes[uv] = add_uv(model, attribute);
  else if (!color.empty() && (n == 3 || n == 4))
    primitive.attributes[color] = add_colors(model, attribute);
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

// --- where and how it stands ------------------------------------------------------------------------------

bool is_vector(const Attribute& a) {
  std::string name = a.name;
  for (char& c : name) c = to_lower(c);
  return a.components == 3 && (name == "normal" || name == "tangent" || name == "direction");
}

/// Directions whose components are attributes of their own stand up with the others: y becomes z, and z becomes -y.
void stand_up_components(std::vector<Attribute>& attributes) {
  std::vector<std::string> names;
  for (const Attribute& a : attributes) names.push_back(a.components == 1 ? a.name : "");
  const auto component = [&](const std::string& end) -> Attribute* {
    const std::string* name = matching_name("direction_" + end, names);
    return name ? &attributes[static_cast<std::size_t>(name - names.data())] : nullptr;
  };
  for (const auto& [first, second, third] : {std::array{"1", "2", "3"}, {"0", "1", "2"}, {"x", "y", "z"}}) {
    Attribute *x = component(first), *y = component(second), *z = component(third);
    if (!x || !y || !z || y->values.size() != z->values.size()) continue;
    std::swap(y->values, z->values);
    for (double& value : z->values) value = -value;
  }
}

/// A quarter turn around x: what pointed along z points along y.
void stand_up(TriangleMesh& mesh) {
  const auto turn = [](double* v) {
    const double y = v[1];
    v[1] = v[2];
    v[2] = -y;
  };
  for (Point& p : mesh.points) turn(p.data());
  for (Attribute& a : mesh.attributes)
    for (std::size_t i = 0; is_vector(a) && i < a.values.size(); i += 3) turn(a.values.data() + i);
  stand_up_components(mesh.attributes);
}

/// Would floats lose more than a millionth of the extent?
bool far_away(const std::vector<Point>& points, const Box& box) {
  double furthest = 0;
  for (const Point& p : points)
    for (double x : p) furthest = std::max(furthest, std::abs(x));
  constexpr double rounding = 1.0 / (1 << 24), tolerance = 1e-6;
  return furthest * rounding > tolerance * box.diagonal();
}

/// How nodes place the numbers of a mesh in a world of metres: scaled, then moved.
struct Placement {
  double scale = 1;
  Point translation{};
  Point origin{};  ///< from where positions count: what the translation moves to its place [units of the mesh]
};

Placement placement_of(const TriangleMesh& mesh) {
  Placement place;
  place.scale = mesh.metres_per_unit.value_or(1);
  const Box box = box_of(mesh.points);
  if (!far_away(mesh.points, box)) return place;
  const Point middle = box.middle();
  for (std::size_t k = 0; k < 3; ++k) {
    const double moved = place.scale * middle[k];
    place.translation[k] = static_cast<float>(moved);  // the same number in programs that compute with floats
    if (std::abs(place.translation[k] - moved) > place.scale * box.diagonal()) place.translation[k] = moved;
    place.origin[k] = place.translation[k] / place.scale;
  }
  return place;
}

tinygltf::Material named_material(const std::string& name, bool double_sided) {
  tinygltf::Material material;
  material.name = name;
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

/// A vertex has one colour, so that faces of different colours need vertices of their own.
TriangleMesh with_colors_at_corners(TriangleMesh mesh) {
  Attribute* color = mesh.find("color");
  if (!color || color->domain != Domain::face) return mesh;
  const auto n = static_cast<std::ptrdiff_t>(color->components);
  std::vector<double> values;
  values.reserve(3 * color->values.size());
  for (auto face = color->values.begin(); face != color->values.end(); face += n)
    for (int corner = 0; corner < 3; ++corner) values.insert(values.end(), face, face + n);
  color->values = std::move(values);
  color->domain = Domain::corner;
  return mesh;
}

/// The attribute that tells groups of faces apart, or nullptr.
const Attribute* labels(const TriangleMesh& mesh, const char* name) {
  const Attribute* a = mesh.find(name);
  return a && a->domain == Domain::face && a->components == 1 && !a->labels.empty() ? a : nullptr;
}

/// The faces of every label that there are, in the order of the labels; without labels all of them.
std::map<std::size_t, std::vector<std::size_t>> faces_by_label(const Attribute* a, std::size_t count) {
  std::map<std::size_t, std::vector<std::size_t>> faces;
  for (std::size_t f = 0; f < count; ++f) {
    const double x = a ? a->values[f] : 0;
    faces[a && x >= 0 && x < static_cast<double>(a->labels.size()) ? static_cast<std::size_t>(x) : 0].push_back(f);
  }
  return faces;
}

std::string label_of(const Attribute* a, std::size_t i, const std::string& otherwise) {
  return a && !a->labels[i].empty() ? a->labels[i] : otherwise;
}

/// These faces with their vertices and attributes. `number` is -1 for all vertices, and so again afterwards.
TriangleMesh extract(const TriangleMesh& mesh, const std::vector<std::size_t>& faces,
                     std::vector<std::int32_t>& number) {
  TriangleMesh part;
  std::vector<std::size_t> vertices, corners;
  for (const std::size_t f : faces) {
    Triangle t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(3 * f + k);
      std::int32_t& n = number[static_cast<std::size_t>(t[k])];
      if (n < 0) {
        n = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(static_cast<std::size_t>(t[k]));
      }
      t[k] = n;
    }
    part.triangles.push_back(t);
  }
  for (const std::size_t v : vertices) {
    part.points.push_back(mesh.points[v]);
    number[v] = -1;
  }
  for (const Attribute& a : mesh.attributes) {
    Attribute taken = a;
    taken.values.clear();
    const auto& tuples = a.domain == Domain::vertex ? vertices : a.domain == Domain::corner ? corners : faces;
    for (const std::size_t i : tuples)
      for (std::size_t k = 0; k < static_cast<std::size_t>(a.components); ++k)
        taken.values.push_back(a.values[i * static_cast<std::size_t>(a.components) + k]);
    part.attributes.push_back(std::move(taken));
  }
  return part;
}

/// Adds a mesh, and the node in which it stands. `tangents`: whether normal maps are read with its "tangent".
void add_object(tinygltf::Model& model, const TriangleMesh& original, bool tangents, const std::string& name,
                const Placement& place) {
  const Attribute* material = labels(original, "material");
  const TriangleMesh mesh = split_corners(with_colors_at_corners(original));
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = add_positions(model, mesh.points, place.origin);
  for (const Attribute& attribute : mesh.attributes)
    if (tangents && attribute.name == "tangent")
      primitive.attributes["TANGENT"] = add_floats(model, {attribute.values.begin(), attribute.values.end()}, 4);
    else if (attribute.domain == Domain::vertex)
      add_attribute(model, primitive, attribute);
  tinygltf::Mesh object;
  object.name = as_utf8(name);
  for (const auto& [label, faces] : faces_by_label(material, mesh.triangles.size())) {
    std::vector<Triangle> triangles;
    for (const std::size_t f : faces) triangles.push_back(mesh.triangles[f]);
    primitive.indices = add_indices(model, triangles);
    primitive.material = static_cast<int>(label);
    object.primitives.push_back(primitive);
  }
  tinygltf::Node node;
  node.mesh = static_cast<int>(model.meshes.size());
  node.name = object.name;
  if (place.scale != 1) node.scale = {place.scale, place.scale, place.scale};
  if (place.origin != Point{}) node.translation.assign(place.translation.begin(), place.translation.end());
  model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
  model.meshes.push_back(std::move(object));
  model.nodes.push_back(std::move(node));
}

void add_materials(tinygltf::Model& model, const TriangleMesh& mesh) {
  const Attribute* material = labels(mesh, "material");
  const bool closed = is_closed(mesh.triangles);
  for (std::size_t i = 0; i < (material ? material->labels.size() : 1); ++i)
    model.materials.push_back(named_material(as_utf8(label_of(material, i, "coat")), !closed));
}

/// As PNG; returns the number of the texture.
int add_texture(tinygltf::Model& model, const Pixels& pixels) {
  const std::string png = png_bytes(pixels);
  std::vector<unsigned char>& data = model.buffers[0].data;
  constexpr std::size_t whole = 4;  // arrays that follow begin at multiples of their numbers' size
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = png.size();
  data.insert(data.end(), png.begin(), png.end());
  data.resize((data.size() + whole - 1) / whole * whole);
  tinygltf::Image image;
  image.mimeType = "image/png";
  image.bufferView = static_cast<int>(model.bufferViews.size());
  model.bufferViews.push_back(view);
  model.images.push_back(image);
  tinygltf::Texture reference;
  reference.sampler = 0;
  reference.source = static_cast<int>(model.images.size()) - 1;
  model.textures.push_back(reference);
  return static_cast<int>(model.textures.size()) - 1;
}

void add_sampler(tinygltf::Model& model, bool repeat) {
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = sampler.wrapT = repeat ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(sampler);
}

/// Bytes of images beside each other: of each target channel an image and its channel, or a byte that is the same
/// everywhere.
struct Source {
  const Pixels* pixels;
  int channel;
  std::uint8_t otherwise;
};
Pixels packed(const Pixels& like, const std::vector<Source>& sources) {
  const std::size_t n = sources.size(), count = static_cast<std::size_t>(like.width) * like.height;
  Pixels result{like.width, like.height, static_cast<int>(n), std::vector<std::uint8_t>(n * count)};
  for (std::size_t k = 0; k < n; ++k) {
    const auto& [from, channel, otherwise] = sources[k];
    for (std::size_t i = 0; i < count; ++i)
      result.bytes[n * i + k] = from ? from->bytes[from->channels * i + channel] : otherwise;
  }
  return result;
}

/// The opacity is the alpha of the colour.
void add_color(tinygltf::Model& model, tinygltf::Material& material, const TextureMaps& maps) {
  if (!maps.color) return;
  const Pixels *color = maps.color.get(), *alpha = maps.opacity.get();
  material.pbrMetallicRoughness.baseColorTexture.index =
      add_texture(model, alpha ? packed(*color, {{color, 0, 0}, {color, 1, 0}, {color, 2, 0}, {alpha, 0, 0}}) : *color);
  if (alpha) material.alphaMode = "BLEND";
}

/// Roughness is green and metalness blue; what there is no image of is what it is without one.
void add_surface(tinygltf::Model& model, tinygltf::Material& material, const TextureMaps& maps) {
  if (!maps.roughness && !maps.metalness) return;
  tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  const Pixels *rough = maps.roughness.get(), *metal = maps.metalness.get();
  pbr.metallicRoughnessTexture.index =
      add_texture(model, packed(rough ? *rough : *metal, {{nullptr, 0, 255}, {rough, 0, 255}, {metal, 0, 255}}));
  if (rough) pbr.roughnessFactor = 1;
  if (metal) pbr.metallicFactor = 1;
}

/// Transmission is red and thickness green. Without transmission there is no glass that could be thick.
void add_glass(tinygltf::Model& model, tinygltf::Material& material, const TextureMaps& maps) {
  if (!maps.transmission) return;
  const Pixels *clear = maps.transmission.get(), *thick = maps.thickness.get();
  const int texture = add_texture(model, packed(*clear, {{clear, 0, 0}, {thick, 0, 0}, {nullptr, 0, 0}}));
  set_glass(model, material, texture, thick ? std::optional(maps.deepest) : std::nullopt);
}

/// Each set of images once, whichever materials have it.
void add_textures(tinygltf::Model& model, const std::vector<TextureMaps>& maps, bool repeat) {
  add_sampler(model, repeat);
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    tinygltf::Material& material = model.materials[i];
    if (i > 0 && maps.size() == 1) {
      const std::string name = material.name;
      material = model.materials[0];
      material.name = name;
      continue;
    }
    add_color(model, material, maps[i]);
    add_surface(model, material, maps[i]);
    add_glass(model, material, maps[i]);
    if (maps[i].normal) material.normalTexture.index = add_texture(model, *maps[i].normal);
    if (!maps[i].emission) continue;
    material.emissiveTexture.index = add_texture(model, *maps[i].emission);
    material.emissiveFactor = {1, 1, 1};
    set_emission_strength(model, material, maps[i].emission_strength);
  }
}

bool has_normal_map(const std::vector<TextureMaps>& maps) {
  return std::ranges::any_of(maps, [](const TextureMaps& m) { return m.normal != nullptr; });
}

}  // namespace

std::string encode_glb(const TriangleMesh& original, const GlbOptions& options) {
  if (original.triangles.empty()) throw Error(Fault::output, "a GLB file needs at least one triangle");
  TriangleMesh mesh = original;
  if (!options.textures.empty()) erase_imaged(mesh.attributes, options.textures[0]);
  if (options.up == UpAxis::z) stand_up(mesh);
  const Placement place = placement_of(mesh);
  const bool tangents = has_normal_map(options.textures);
  if (tangents) mesh.set(corner_tangents(mesh));
  tinygltf::Model model;
  model.asset.generator = "pelage";
  set_record(model, record_for_files());
  model.buffers.resize(1);
  model.scenes.resize(1);
  model.defaultScene = 0;
  add_materials(model, mesh);
  for (tinygltf::Material& m : model.materials) set_coat(mesh, model, m);
  if (!options.textures.empty()) add_textures(model, options.textures, options.repeat);
  mesh = without_told_channels(std::move(mesh));
  const Attribute* object = labels(mesh, "object");
  const auto objects = faces_by_label(object, mesh.triangles.size());
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const auto& [label, faces] : objects)
    add_object(model, objects.size() > 1 ? extract(mesh, faces, number) : mesh, tangents,
               objects.size() > 1 ? label_of(object, label, options.name) : options.name, place);
  constexpr std::size_t room_for_json = 1 << 20;
  if (model.buffers[0].data.size() > std::numeric_limits<std::uint32_t>::max() - room_for_json)
    throw Error(Fault::output, "a GLB file holds at most 4 GiB; write PLY instead");
  return to_bytes(model);
}

}  // namespace pelage
