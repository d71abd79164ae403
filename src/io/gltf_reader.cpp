#include "io/gltf_reader.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <utility>

#include "io/gltf_accessor.h"

namespace pelage {

namespace {

/// Column-major 4x4, as in glTF.
using Matrix = std::array<double, 16>;
constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

double determinant3(const Matrix& m) {
  return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]);
}

Matrix local_matrix(const tinygltf::Node& node) {
  Matrix m = identity;
  if (node.matrix.size() == 16) {
    std::copy(node.matrix.begin(), node.matrix.end(), m.begin());
    return m;
  }
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    m = {1 - 2 * (y * y + z * z),
         2 * (x * y + z * w),
         2 * (x * z - y * w),
         0,
         2 * (x * y - z * w),
         1 - 2 * (x * x + z * z),
         2 * (y * z + x * w),
         0,
         2 * (x * z + y * w),
         2 * (y * z - x * w),
         1 - 2 * (x * x + y * y),
         0,
         0,
         0,
         0,
         1};
  }
  if (node.scale.size() == 3)
    for (int i = 0; i < 12; ++i) m[i] *= node.scale[i / 4];
  if (node.translation.size() == 3) std::copy(node.translation.begin(), node.translation.end(), m.begin() + 12);
  return m;
}

/// Images are not needed; decoding them would cost time and could fail.
bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model parse(std::string_view bytes, const std::string& path) {
  if (bytes.size() > std::numeric_limits<unsigned>::max())
    throw Error(Fault::input, "is larger than 4 GiB, which glTF cannot be", {path});
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  std::string error, warning, folder = std::filesystem::path(path).parent_path().string();
  const auto size = static_cast<unsigned>(bytes.size());
  bool done = false;
  try {
    done = bytes.starts_with("glTF")
               ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  } catch (const std::exception& e) {
    error = e.what();
  }
  if (done) return model;
  std::replace(error.begin(), error.end(), '\n', ' ');
  throw Error(Fault::input, "is no valid glTF file: " + error, {path});
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const std::string& path)
      : model_(model), path_(path), seen_(model.nodes.size(), 0) {}

  RawShape read() {
    if (model_.nodes.empty()) {
      for (int m = 0; m < static_cast<int>(model_.meshes.size()); ++m) add_mesh(m, identity);
    } else {
      for (int root : roots()) visit(root);
    }
    if (skipped_.count > 0) {
      skipped_.text = counted(skipped_.count, "primitive") + " made of points or lines; left out";
      shape_.findings.push_back(skipped_);
    }
    complete_attributes(shape_.mesh.points.size());
    return std::move(shape_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Error(Fault::input, message, {path_}); }

  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int scene = model_.defaultScene < 0 ? 0 : model_.defaultScene;
      if (static_cast<std::size_t>(scene) >= model_.scenes.size()) fail("the default scene does not exist");
      return model_.scenes[scene].nodes;
    }
    std::vector<char> child(model_.nodes.size(), 0);
    for (const tinygltf::Node& node : model_.nodes)
      for (int c : node.children)
        if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[c] = 1;
    std::vector<int> result;
    for (std::size_t n = 0; n < child.size(); ++n)
      if (!child[n]) result.push_back(static_cast<int>(n));
    return result;
  }

  /// Depth first, without recursion: deep chains of nodes must not overflow the stack.
  void visit(int root) {
    std::vector<std::pair<int, Matrix>> stack = {{root, identity}};
    while (!stack.empty()) {
      const auto [n, parent] = stack.back();
      stack.pop_back();
      if (n < 0 || static_cast<std::size_t>(n) >= seen_.size()) fail("node " + std::to_string(n) + " does not exist");
      if (std::exchange(seen_[n], 1))
        fail("node " + std::to_string(n) + " has two parents; the nodes must form a tree");
      const tinygltf::Node& node = model_.nodes[n];
      const Matrix world = parent * local_matrix(node);
      if (node.mesh >= 0) add_mesh(node.mesh, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        stack.emplace_back(*child, world);
    }
  }

  void add_mesh(int mesh, const Matrix& world) {
    if (static_cast<std::size_t>(mesh) >= model_.meshes.size())
      fail("mesh " + std::to_string(mesh) + " does not exist");
    for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives) {
      const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
      if (mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN)
        add_primitive(primitive, mode, mesh, world);
      else
        ++skipped_.count;
    }
  }

  void add_primitive(const tinygltf::Primitive& primitive, int mode, int mesh, const Matrix& world) {
    const auto where = "mesh " + std::to_string(mesh) + " ";
    if (primitive.extensions.contains("KHR_draco_mesh_compression"))
      fail(where + "is compressed with Draco, which is not supported; export without compression");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail(where + "has no POSITION");
    const GltfAccessor points(model_, position->second, path_);
    if (points.components() != 3) fail(where + "has a POSITION that is not a VEC3");
    const std::size_t first = shape_.mesh.points.size();
    if (first + points.count() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      fail("has more than 2147483647 vertices");
    for (std::size_t i = 0; i < points.count(); ++i) {
      const double x = points.value(i, 0), y = points.value(i, 1), z = points.value(i, 2);
      Point p;
      for (int k = 0; k < 3; ++k) p[k] = world[k] * x + world[4 + k] * y + world[8 + k] * z + world[12 + k];
      shape_.mesh.points.push_back(p);
    }
    add_attributes(primitive, first, points.count());
    add_faces(corners_of(primitive, first, points.count(), where), mode, determinant3(world) < 0);
  }

  std::vector<std::int32_t> corners_of(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count,
                                       const std::string& where) const {
    std::vector<std::int32_t> corners;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < count; ++i) corners.push_back(static_cast<std::int32_t>(first + i));
      return corners;
    }
    const GltfAccessor indices(model_, primitive.indices, path_);
    corners.reserve(indices.count());
    for (std::size_t i = 0; i < indices.count(); ++i) {
      const std::uint32_t v = indices.index(i);
      if (v >= count)
        fail(where + "has index " + std::to_string(v) + ", but its vertices are 0 to " +
             std::to_string(static_cast<std::int64_t>(count) - 1));
      corners.push_back(static_cast<std::int32_t>(first + v));
    }
    return corners;
  }

  void add_faces(const std::vector<std::int32_t>& c, int mode, bool mirrored) {
    auto add = [&](std::int32_t a, std::int32_t b, std::int32_t d) {
      if (mirrored) std::swap(b, d);
      shape_.mesh.corners.insert(shape_.mesh.corners.end(), {a, b, d});
      shape_.mesh.end_face();
    };
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      for (std::size_t i = 0; i + 2 < c.size(); i += 3) add(c[i], c[i + 1], c[i + 2]);
    } else {
      for (std::size_t i = 0; i + 2 < c.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
          add(c[0], c[i + 1], c[i + 2]);
        else
          add(c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]);
      }
    }
  }

  static double absent_value(const std::string& name) { return name == "color" ? 1 : 0; }

  /// Fills what a part lacks, up to a number of vertices.
  void complete_attributes(std::size_t vertices) {
    for (Attribute& a : shape_.mesh.attributes) a.values.resize(vertices * a.components, absent_value(a.name));
  }

  void add_attributes(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count) {
    complete_attributes(first);
    for (const auto& [semantic, accessor] : primitive.attributes) {
      if (semantic == "COLOR_0")
        add_attribute("color", GltfAccessor(model_, accessor, path_), first, count);
      else if (semantic == "TEXCOORD_0")
        add_attribute("uv", GltfAccessor(model_, accessor, path_), first, count);
      else if (semantic.size() > 1 && semantic[0] == '_')
        add_attribute(semantic.substr(1), GltfAccessor(model_, accessor, path_), first, count);
    }
  }

  void add_attribute(const std::string& name, const GltfAccessor& source, std::size_t first, std::size_t count) {
    if (source.count() != count)
      fail("attribute \"" + name + "\" has " + std::to_string(source.count()) + " values for " + std::to_string(count) +
           " vertices");
    std::vector<Attribute>& all = shape_.mesh.attributes;
    auto a = std::find_if(all.begin(), all.end(), [&](const Attribute& b) { return b.name == name; });
    if (a == all.end()) {
      all.push_back({name, source.components(), Domain::vertex, {}});
      a = all.end() - 1;
      a->values.resize(first * a->components, absent_value(name));
    }
    const int shared = std::min(a->components, source.components());
    a->values.reserve((first + count) * a->components);
    for (std::size_t i = 0; i < count; ++i)
      for (int k = 0; k < a->components; ++k) {
        const double value = k < shared ? source.value(i, k) : absent_value(name);
        a->values.push_back(name == "uv" && k == 1 ? 1 - value : value);
      }
  }

  const tinygltf::Model& model_;
  const std::string& path_;
  std::vector<char> seen_;
  RawShape shape_;
  Finding skipped_{"points-and-lines", "", 0, 0, true};
};

}  // namespace

RawShape read_gltf(std::string_view bytes, const std::string& path) {
  const tinygltf::Model model = parse(bytes, path);
  return GltfReader(model, path).read();
}

}  // namespace pelage
