#include "io/gltf_scene.h"

#include <algorithm>
#include <utility>

#include "shape/vectors.h"

namespace pelage {

GltfMatrix operator*(const GltfMatrix& a, const GltfMatrix& b) {
  GltfMatrix c{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

Point transformed(const GltfMatrix& m, const Point& p) {
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
  return q;
}

Point turned(const GltfMatrix& m, const Point& v) {
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2];
  return q;
}

Point turned_normal(const GltfMatrix& m, const Point& n) {
  const double sign = determinant3(m) < 0 ? -1 : 1;
  const Point x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
  const Point yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);  // the inverse transposed, times the determinant
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = sign * (yz[k] * n[0] + zx[k] * n[1] + xy[k] * n[2]);
  return unit(q);
}

double determinant3(const GltfMatrix& m) {
  return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]);
}

GltfMatrix compose(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                   const std::array<double, 3>& scale) {
  const auto [x, y, z, w] = rotation;
  GltfMatrix m = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),     0,
                  2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),     0,
                  2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y), 0,
                  translation[0],          translation[1],          translation[2],          1};
  for (std::size_t i = 0; i < 12; ++i) m[i] *= scale[i / 4];
  return m;
}

GltfScene::GltfScene(const GltfDocument& document)
    : document_(document), children_(document.count("nodes")), is_child_(children_.size(), 0) {
  for (std::size_t n = 0; n < children_.size(); ++n) {
    children_[n] = document.indices(document.get("nodes", n), "children");
    for (std::size_t child : children_[n]) {
      document.get("nodes", child);
      if (std::exchange(is_child_[child], 1))
        document.fail("node " + std::to_string(child) + " has two parents; the nodes must form a tree");
    }
  }
  place_nodes();
}

GltfMatrix GltfScene::local(std::size_t node) const {
  const GltfJson& json = document_.get("nodes", node);
  if (const std::vector<double> m = document_.numbers(json, "matrix", 16); !m.empty()) {
    GltfMatrix matrix;
    std::copy(m.begin(), m.end(), matrix.begin());
    return matrix;
  }
  const std::vector<double> t = document_.numbers(json, "translation", 3), r = document_.numbers(json, "rotation", 4),
                            s = document_.numbers(json, "scale", 3);
  return compose(t.empty() ? std::array{0.0, 0.0, 0.0} : std::array{t[0], t[1], t[2]},
                 r.empty() ? std::array{0.0, 0.0, 0.0, 1.0} : std::array{r[0], r[1], r[2], r[3]},
                 s.empty() ? std::array{1.0, 1.0, 1.0} : std::array{s[0], s[1], s[2]});
}

/// Without recursion: deep chains of nodes must not overflow the stack.
void GltfScene::place_nodes() {
  world_.resize(children_.size());
  std::vector<std::size_t> queue;
  for (std::size_t n = 0; n < children_.size(); ++n) {
    if (is_child_[n]) continue;
    world_[n] = local(n);
    queue.push_back(n);
  }
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (std::size_t child : children_[queue[i]]) {
      world_[child] = world_[queue[i]] * local(child);
      queue.push_back(child);
    }
  if (queue.size() < children_.size())
    document_.fail("some nodes are their own descendants; the nodes must form a tree");
}

std::vector<std::size_t> GltfScene::roots(std::vector<Finding>& findings) const {
  const std::size_t scenes = document_.count("scenes");
  if (scenes == 0) {
    std::vector<std::size_t> result;
    for (std::size_t n = 0; n < children_.size(); ++n)
      if (!is_child_[n]) result.push_back(n);
    return result;
  }
  const auto given = document_.index(document_.root(), "scene");
  const std::size_t scene = given.value_or(0);
  if (scene >= scenes) document_.fail("the default scene " + std::to_string(scene) + " does not exist");
  if (scenes > 1) {
    std::string others;
    for (std::size_t s = 0; s < scenes; ++s)
      if (s != scene && others.size() < 100) others += (others.empty() ? "" : ", ") + document_.label("scenes", s);
    findings.push_back({"other-scenes",
                        document_.label("scenes", scene) + (given ? ", the default one," : ", the first one,") +
                            " is taken; left out: " + others,
                        scenes - 1, scene == 0 ? std::size_t{1} : std::size_t{0}, true});
  }
  return document_.indices(document_.get("scenes", scene), "nodes");
}

std::vector<std::size_t> GltfScene::shown(std::vector<Finding>& findings, const char* what) const {
  std::vector<std::size_t> result, stack = roots(findings);
  std::reverse(stack.begin(), stack.end());
  std::vector<char> seen(children_.size(), 0);
  Finding hidden{"hidden-nodes", "", 0, 0, true};
  while (!stack.empty()) {
    const std::size_t n = stack.back();
    stack.pop_back();
    const GltfJson& node = document_.get("nodes", n);
    if (std::exchange(seen[n], 1)) continue;
    const GltfJson* visibility = document_.extension(node, "KHR_node_visibility");
    const GltfJson* visible = visibility ? document_.find(*visibility, "visible") : nullptr;
    if (visible && visible->is_boolean() && !visible->get<bool>()) {
      if (hidden.count++ == 0) hidden.element = n;
      continue;
    }
    if (document_.find(node, what)) result.push_back(n);
    stack.insert(stack.end(), children_[n].rbegin(), children_[n].rend());
  }
  if (hidden.count > 0) {
    hidden.text = counted(hidden.count, "hidden node") + " (first: " + document_.label("nodes", hidden.element) +
                  ") with all below; left out";
    findings.push_back(hidden);
  }
  return result;
}

GltfSkin::GltfSkin(GltfDocument& document, const GltfScene& scene, std::size_t skin) {
  const GltfJson& json = document.get("skins", skin);
  const std::vector<std::size_t> nodes = document.indices(json, "joints");
  const std::string label = document.label("skins", skin);
  if (nodes.empty()) document.fail(label + " has no joints");
  for (std::size_t n : nodes) {
    document.get("nodes", n);
    joints_.push_back(scene.world(n));
  }
  const auto inverse = document.index(json, "inverseBindMatrices");
  if (!inverse) return;
  const GltfAccessor matrices(document, *inverse);
  if (matrices.components() != 16 || matrices.count() < nodes.size())
    document.fail(label + " has fewer inverse bind matrices than joints");
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    GltfMatrix bind;
    for (int k = 0; k < 16; ++k) bind[k] = matrices.value(j, k);
    joints_[j] = joints_[j] * bind;
  }
}

}  // namespace pelage
