#include "io/gltf_compressor.h"

#include "io/gltf_chunks.h"
#include "pelage/error.h"

#ifdef PELAGE_HAS_MESHOPTIMIZER

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

namespace pelage {

namespace {

using Json = GltfText;
using Indices = std::vector<std::uint32_t>;

constexpr const char* packing = "EXT_meshopt_compression";
constexpr int type_short = 5122, type_ushort = 5123, type_float = 5126, target_vertices = 34962, target_indices = 34963;
constexpr int fallback_buffer = 1;  ///< which nobody needs: viewers without the extension refuse the file

std::size_t components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

/// Numbers as they are packed.
struct Packed {
  std::vector<char> values;
  std::size_t stride = 0;
  int component = type_float;
  const char* filter = nullptr;
};

class Compressor {
 public:
  explicit Compressor(const GlbChunks& glb) : from_(glb), to_{glb.json, {}} {}

  GlbChunks run() {
    to_.json["bufferViews"] = Json::array();
    for (std::size_t i = 0; i < from_.json["meshes"].size(); ++i) pack_mesh(i);
    if (from_.json.contains("images"))
      for (Json& image : to_.json["images"]) image["bufferView"] = copy_view(image["bufferView"]);
    to_.json["buffers"] = Json::array({{{"byteLength", to_.bytes.size()}},
                                       {{"byteLength", unpacked_}, {"extensions", {{packing, {{"fallback", true}}}}}}});
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      for (const char* name : {"KHR_mesh_quantization", packing}) to_.json[list].push_back(name);
    return std::move(to_);
  }

 private:
  /// All parts of a mesh have the same vertices.
  void pack_mesh(std::size_t number) {
    const Json& parts = from_.json["meshes"][number]["primitives"];
    const Json& attributes = parts[0]["attributes"];
    const std::size_t count = from_.json["accessors"][attributes["POSITION"].get<std::size_t>()]["count"];
    std::vector<Indices> indices;
    Indices all;
    for (const Json& part : parts) {
      indices.push_back(numbers<std::uint32_t>(part["indices"]));
      Indices& own = indices.back();
      meshopt_optimizeVertexCache(own.data(), own.data(), own.size(), count);
      all.insert(all.end(), own.begin(), own.end());
    }
    Indices place(count);
    const std::size_t used = meshopt_optimizeVertexFetchRemap(place.data(), all.data(), all.size(), count);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      meshopt_remapIndexBuffer(indices[i].data(), indices[i].data(), indices[i].size(), place.data());
      pack_indices(parts[i]["indices"], indices[i], used);
    }
    for (const auto& [name, accessor] : attributes.items()) pack_attribute(name, accessor, number, place, used);
  }

  template <class T>
  std::vector<T> numbers(std::size_t accessor) const {
    const Json& a = from_.json["accessors"][accessor];
    const Json& view = from_.json["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<T> values(a["count"].get<std::size_t>() * components_of(a["type"]));
    std::memcpy(values.data(), from_.bytes.data() + view.value("byteOffset", std::size_t{0}),
                values.size() * sizeof(T));
    return values;
  }

  /// A view for `packed`, which unpacks to `count` pieces of `stride` bytes.
  std::size_t add_view(const std::vector<unsigned char>& packed, std::size_t count, std::size_t stride,
                       const char* mode, const char* filter) {
    Json extension = {{"buffer", 0},
                      {"byteOffset", to_.bytes.size()},
                      {"byteLength", packed.size()},
                      {"byteStride", stride},
                      {"mode", mode},
                      {"count", count}};
    if (filter) extension["filter"] = filter;
    Json view = {{"buffer", fallback_buffer}, {"byteOffset", unpacked_}, {"byteLength", count * stride}};
    const bool vertices = std::string_view(mode) == "ATTRIBUTES";
    if (vertices) view["byteStride"] = stride;
    view["target"] = vertices ? target_vertices : target_indices;
    view["extensions"][packing] = std::move(extension);
    to_.bytes.append(reinterpret_cast<const char*>(packed.data()), packed.size());
    fill_to_whole(to_.bytes, '\0');
    unpacked_ += (count * stride + 3) / 4 * 4;
    to_.json["bufferViews"].push_back(std::move(view));
    return to_.json["bufferViews"].size() - 1;
  }

  void pack_indices(std::size_t accessor, const Indices& indices, std::size_t vertices) {
    std::vector<unsigned char> packed(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
    to_.json["accessors"][accessor]["bufferView"] =
        add_view(packed, indices.size(), sizeof(std::uint32_t), "TRIANGLES", nullptr);
  }

  void pack_attribute(const std::string& name, std::size_t accessor, std::size_t mesh, const Indices& place,
                      std::size_t used) {
    if (!done_.insert(accessor).second) return;
    const std::vector<float> values = numbers<float>(accessor);
    const std::size_t n = components_of(from_.json["accessors"][accessor]["type"]);
    std::vector<float> moved(n * used);
    for (std::size_t v = 0; v < place.size(); ++v)
      if (place[v] < used) std::copy_n(values.begin() + n * v, n, moved.begin() + n * place[v]);
    Json& a = to_.json["accessors"][accessor];
    a["count"] = used;
    const Packed p = quantised(name, moved, n, a, mesh);
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(used, p.stride));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), p.values.data(), used, p.stride));
    a["componentType"] = p.component;
    if (p.component != type_float) a["normalized"] = true;
    a["bufferView"] = add_view(packed, used, p.stride, "ATTRIBUTES", p.filter);
  }

  Packed quantised(const std::string& name, const std::vector<float>& values, std::size_t n, Json& accessor,
                   std::size_t mesh) {
    if (name == "POSITION") return positions(values, accessor, mesh);
    if (name == "NORMAL" || name == "TANGENT") return unit_vectors(values, n);
    const bool fraction = std::ranges::all_of(values, [](float x) { return x >= 0 && x <= 1; });
    if (fraction && (name.starts_with("COLOR_") || name.starts_with("TEXCOORD_")))
      return fractions(values, n, [](std::size_t, float x) { return static_cast<double>(x); });
    return floats(values, n);
  }

  /// round(65535 f(k, x)) of component k.
  template <class F>
  static Packed fractions(const std::vector<float>& values, std::size_t n, F&& f) {
    const std::size_t stride = (2 * n + 3) / 4 * 4;
    Packed p{std::vector<char>(values.size() / n * stride), stride, type_ushort, nullptr};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto q = static_cast<std::uint16_t>(std::lround(65535 * f(i % n, values[i])));
      std::memcpy(p.values.data() + i / n * stride + 2 * (i % n), &q, sizeof q);
    }
    return p;
  }

  /// In a cube; the node takes its size and place.
  Packed positions(const std::vector<float>& values, Json& accessor, std::size_t mesh) {
    std::array<double, 3> low{}, high{};
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = accessor["min"][k];
      high[k] = accessor["max"][k];
      size = std::max(size, high[k] - low[k]);
    }
    if (!(size > 0)) size = 1;
    for (Json& node : to_.json["nodes"])
      if (node.value("mesh", mesh + 1) == mesh) place_node(node, low, size);
    const auto in_cube = [&](std::size_t k, double x) { return std::clamp((x - low[k]) / size, 0.0, 1.0); };
    for (std::size_t k = 0; k < 3; ++k) {
      accessor["min"][k] = std::lround(65535 * in_cube(k, low[k]));
      accessor["max"][k] = std::lround(65535 * in_cube(k, high[k]));
    }
    return fractions(values, 3, in_cube);
  }

  static void place_node(Json& node, const std::array<double, 3>& low, double size) {
    const auto scale = node.value("scale", std::array<double, 3>{1, 1, 1});
    auto translation = node.value("translation", std::array<double, 3>{});
    for (std::size_t k = 0; k < 3; ++k) translation[k] += scale[k] * low[k];
    node["translation"] = translation;
    node["scale"] = {scale[0] * size, scale[1] * size, scale[2] * size};
  }

  static Packed unit_vectors(const std::vector<float>& values, std::size_t n) {
    constexpr int bits = 12;
    constexpr std::size_t stride = 8;
    const std::size_t count = values.size() / n;
    std::vector<float> four(4 * count);
    for (std::size_t i = 0; i < count; ++i) std::copy_n(values.begin() + n * i, n, four.begin() + 4 * i);
    Packed p{std::vector<char>(count * stride), stride, type_short, "OCTAHEDRAL"};
    meshopt_encodeFilterOct(p.values.data(), count, stride, bits, four.data());
    return p;
  }

  static Packed floats(const std::vector<float>& values, std::size_t n) {
    constexpr int bits = 15;
    Packed p{std::vector<char>(values.size() * sizeof(float)), n * sizeof(float), type_float, "EXPONENTIAL"};
    meshopt_encodeFilterExp(p.values.data(), values.size() / n, p.stride, bits, values.data());
    return p;
  }

  std::size_t copy_view(std::size_t number) {
    Json view = from_.json["bufferViews"][number];
    const std::size_t offset = view.value("byteOffset", std::size_t{0}), length = view["byteLength"];
    view["byteOffset"] = to_.bytes.size();
    to_.bytes += from_.bytes.substr(offset, length);
    fill_to_whole(to_.bytes, '\0');
    to_.json["bufferViews"].push_back(std::move(view));
    return to_.json["bufferViews"].size() - 1;
  }

  const GlbChunks& from_;
  GlbChunks to_;
  std::size_t unpacked_ = 0;    ///< bytes of the buffer that nobody needs
  std::set<std::size_t> done_;  ///< accessors
};

}  // namespace

std::string compress_glb(const std::string& glb) {
  const GlbChunks whole = glb_chunks(glb);
  return glb_of(Compressor(whole).run());
}

}  // namespace pelage

#else

namespace pelage {

std::string compress_glb(const std::string&) {
  throw Error(Fault::usage, "this build has no meshoptimizer, which packs GLB files; write them as they are");
}

}  // namespace pelage

#endif
