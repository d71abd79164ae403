#include "io/gltf_animation.h"

#include <algorithm>
#include <cmath>

#include "io/gltf_chunks.h"
#include "pelage/error.h"

namespace pelage {

namespace {

constexpr int type_float = 5126;
constexpr const char *color_name = "frame_color_", *point_name = "frame_point_";

/// How these come out of encode_glb().
std::string as_in_gltf(const char* name, std::size_t frame) {
  return (name == color_name ? "_FRAME_COLOR_" : "_FRAME_POINT_") + std::to_string(frame);
}

/// What changes from the first frame to frame k, as attributes.
void add_differences(TriangleMesh& mesh, const std::vector<AnimationFrame>& frames, std::size_t k, UpAxis up) {
  const AnimationFrame &first = frames[0], &now = frames[k];
  Attribute color{color_name + std::to_string(k), 3, Domain::vertex, {}};
  for (std::size_t i = 0; i < now.color.size(); ++i)
    color.values.push_back(std::clamp(now.color[i], 0.0, 1.0) - std::clamp(first.color[i], 0.0, 1.0));
  mesh.attributes.push_back(std::move(color));
  if (now.points == first.points) return;
  Attribute moved{point_name + std::to_string(k), 3, Domain::vertex, {}};
  for (std::size_t v = 0; v < now.points.size(); ++v) {
    Point d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = now.points[v][i] - first.points[v][i];
    if (up == UpAxis::z) d = {d[0], d[2], -d[1]};
    moved.values.insert(moved.values.end(), d.begin(), d.end());
  }
  mesh.attributes.push_back(std::move(moved));
}

class Animator {
 public:
  explicit Animator(GlbChunks glb) : glb_(std::move(glb)) {}

  GlbChunks run(std::size_t frames, double seconds, bool loop) {
    for (GltfText& mesh : glb_.json["meshes"]) {
      for (GltfText& part : mesh["primitives"]) make_targets(part, frames);
      mesh["weights"] = std::vector<int>(frames - 1, 0);
    }
    add_animation(frames, seconds, loop);
    glb_.json["buffers"][0]["byteLength"] = glb_.bytes.size();
    return std::move(glb_);
  }

 private:
  void make_targets(GltfText& part, std::size_t frames) {
    GltfText& attributes = part["attributes"];
    const std::size_t unmoved = add_zeros(glb_.json["accessors"][attributes["POSITION"].get<std::size_t>()]["count"]);
    GltfText targets = GltfText::array();
    for (std::size_t k = 1; k < frames; ++k) {
      GltfText target = GltfText::object();
      take(attributes, as_in_gltf(color_name, k), target, "COLOR_0");
      // three.js and Blender open no targets without it.
      target["POSITION"] = unmoved;
      take(attributes, as_in_gltf(point_name, k), target, "POSITION");
      targets.push_back(std::move(target));
    }
    part["targets"] = std::move(targets);
  }

  /// Vectors that take no room in the file.
  std::size_t add_zeros(std::size_t count) {
    const std::vector<int> zero(3, 0);
    glb_.json["accessors"].push_back(
        {{"componentType", type_float}, {"count", count}, {"type", "VEC3"}, {"min", zero}, {"max", zero}});
    return glb_.json["accessors"].size() - 1;
  }

  void take(GltfText& attributes, const std::string& from, GltfText& target, const char* to) {
    if (!attributes.contains(from)) return;
    target[to] = attributes[from];
    attributes.erase(from);
    if (std::string(to) == "POSITION") set_range(target[to]);
  }

  /// glTF asks for it of positions.
  void set_range(std::size_t accessor) {
    GltfText& a = glb_.json["accessors"][accessor];
    const GltfText& view = glb_.json["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t count = a["count"], at = view.value("byteOffset", std::size_t{0});
    std::vector<float> low(3, INFINITY), high(3, -INFINITY), p(3);
    for (std::size_t v = 0; v < count; ++v) {
      glb_.bytes.copy(reinterpret_cast<char*>(p.data()), 3 * sizeof(float), at + v * 3 * sizeof(float));
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
    }
    a["min"] = low;
    a["max"] = high;
  }

  /// At the time of each frame its own weight is 1.
  void add_animation(std::size_t frames, double seconds, bool loop) {
    const std::size_t keys = frames + (loop ? 1 : 0), targets = frames - 1;
    std::vector<float> time(keys), weight(keys * targets);
    for (std::size_t k = 0; k < keys; ++k) time[k] = static_cast<float>(static_cast<double>(k) * seconds);
    for (std::size_t k = 1; k < frames; ++k) weight[k * targets + k - 1] = 1;
    const std::size_t input = add_scalars(time), output = add_scalars(weight);
    glb_.json["accessors"][input]["min"] = {time.front()};
    glb_.json["accessors"][input]["max"] = {time.back()};
    GltfText animation = {{"name", "growth"}, {"samplers", {{{"input", input}, {"output", output}}}}};
    for (std::size_t n = 0; n < glb_.json["nodes"].size(); ++n)
      if (glb_.json["nodes"][n].contains("mesh"))
        animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", n}, {"path", "weights"}}}});
    glb_.json["animations"] = GltfText::array({animation});
  }

  std::size_t add_scalars(const std::vector<float>& values) {
    fill_to_whole(glb_.bytes, '\0');
    const std::size_t length = values.size() * sizeof(float);
    glb_.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", glb_.bytes.size()}, {"byteLength", length}});
    glb_.bytes.append(reinterpret_cast<const char*>(values.data()), length);
    glb_.json["accessors"].push_back({{"bufferView", glb_.json["bufferViews"].size() - 1},
                                      {"componentType", type_float},
                                      {"count", values.size()},
                                      {"type", "SCALAR"}});
    return glb_.json["accessors"].size() - 1;
  }

  GlbChunks glb_;
};

}  // namespace

std::string encode_animated_glb(const TriangleMesh& mesh, const std::vector<AnimationFrame>& frames, double seconds,
                                bool loop, const GlbOptions& options) {
  if (frames.size() < 2) throw Error(Fault::usage, "an animated GLB file needs at least two frames");
  constexpr double most_bytes = 1e9, bytes_of_a_color = 12;
  if (static_cast<double>(frames.size()) * static_cast<double>(mesh.points.size()) * bytes_of_a_color > most_bytes)
    throw Error(Fault::usage, "an animated GLB file of " + std::to_string(frames.size()) + " frames of " +
                                  std::to_string(mesh.points.size()) +
                                  " vertices would have more than 1 GB; take fewer frames, or --triangles");
  TriangleMesh whole = mesh;
  for (std::size_t k = 1; k < frames.size(); ++k) add_differences(whole, frames, k, options.up);
  GlbChunks glb = glb_chunks(encode_glb(whole, options));
  for (const GltfText& object : glb.json["meshes"]) {
    const GltfText& color = object["primitives"][0]["attributes"]["COLOR_0"];
    if (glb.json["accessors"][color.get<std::size_t>()]["type"] != "VEC3")
      throw Error(Fault::usage, "an animated GLB file holds no opacity; leave that out of the look, or take a video");
  }
  return glb_of(Animator(std::move(glb)).run(frames.size(), seconds, loop));
}

}  // namespace pelage
