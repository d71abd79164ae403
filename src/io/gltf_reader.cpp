#include "io/gltf_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/ascii.h"
#include "base/number.h"
#include "base/suggest.h"
#include "io/gltf_attributes.h"
#include "io/gltf_extensions.h"
#include "io/gltf_material.h"
#include "io/gltf_primitive.h"
#include "io/gltf_scene.h"

namespace pelage {

namespace {

/// Names for a message, as many as fit on its line.
class ShortList {
 public:
  void add(const std::string& name) {
    constexpr std::size_t most = 80;  // characters
    if (text_.size() > most) {
      ++more_;
      return;
    }
    text_ += (text_.empty() ? "" : ", ") + name;
  }
  std::string text() const { return text_ + (more_ > 0 ? " and " + std::to_string(more_) + " more" : ""); }

 private:
  std::string text_;
  std::size_t more_ = 0;
};

/// The copies of a mesh in the world: by matrices, or one by the joints of a skin.
struct Placement {
  std::vector<GltfMatrix> matrices;
  std::optional<GltfSkin> skin;
  std::string name;  ///< of the node
};

/// Which of several named things every face belongs to.
class FaceLabels {
 public:
  /// Returns the number of the label, which becomes unique: "wheel", "wheel.2".
  std::size_t add(const std::string& name) {
    const int same = ++uses_[name];
    labels_.push_back(same == 1 ? name : name + "." + std::to_string(same));
    return labels_.size() - 1;
  }
  std::size_t count() const { return labels_.size(); }
  void add_faces(std::size_t count, std::size_t label) {
    values_.resize(values_.size() + count, static_cast<double>(label));
  }
  /// Nothing where all faces are of one kind.
  void move_to(std::vector<Attribute>& attributes, const char* name) {
    if (std::adjacent_find(values_.begin(), values_.end(), std::not_equal_to<>()) != values_.end())
      attributes.push_back({name, 1, Domain::face, std::move(values_), NumberType::int32, std::move(labels_)});
  }

 private:
  std::map<std::string, int> uses_;
  std::vector<std::string> labels_;
  std::vector<double> values_;
};

struct Values {
  std::string name;
  int components = 0;
  NumberType type = NumberType::float32;
  std::vector<double> values;
  Point (*turn)(const GltfMatrix&, const Point&) = nullptr;  ///< how vectors follow the surface; nullptr for numbers
};

/// Vertices of a part without vertex colours.
struct Uncolored {
  std::size_t first = 0, end = 0;
  std::array<double, 4> color;
};

const std::string direction_name = "direction";  ///< of vectors along the surface

const std::array<double, 4> white = {1, 1, 1, 1};

/// Names of colours have them here, and capitals in glTF.
std::string in_small_letters(std::string name) {
  for (char& c : name) c = to_lower(c);
  return name;
}

/// The number behind a name like TEXCOORD_0.
std::optional<std::size_t> set_number(const std::string& semantic, const std::string& name) {
  if (!semantic.starts_with(name)) return {};
  std::size_t number = 0;
  const char* end = semantic.data() + semantic.size();
  const auto [rest, error] = std::from_chars(semantic.data() + name.size(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::string& path) : document_(bytes, path) {}

  RawShape read() {
    check_extensions(document_, shape_.findings);
    const GltfScene scene(document_);
    used_.assign(document_.count("meshes"), 0);
    if (document_.count("nodes") == 0)
      for (std::size_t m = 0; m < used_.size(); ++m) add_mesh(m, {{gltf_identity}, {}, ""}, {});
    for (std::size_t n : scene.shown(shape_.findings)) add_node(scene, n);
    attributes_.complete(shape_.mesh.points.size());
    shape_.mesh.attributes = attributes_.take();
    drop_incomplete_normals();
    fill_colors();
    if (object_.count() != 1) shape_.name.clear();
    object_.move_to(shape_.mesh.attributes, "object");
    material_.move_to(shape_.mesh.attributes, "material");
    report();
    return std::move(shape_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { document_.fail(message); }

  // --- nodes ---

  void add_node(const GltfScene& scene, std::size_t n) {
    const GltfJson& node = document_.get("nodes", n);
    const std::size_t mesh = *document_.index(node, "mesh");
    const GltfJson* instancing = document_.extension(node, "EXT_mesh_gpu_instancing");
    Placement placement{{scene.world(n)}, {}, document_.text(node, "name")};
    if (const auto skin = document_.index(node, "skin"))
      placement.skin.emplace(document_, scene, *skin);
    else if (instancing)
      placement.matrices = instances(*instancing, scene.world(n), document_.label("nodes", n));
    add_mesh(mesh, placement, document_.numbers(node, "weights", 0));
  }

  std::vector<GltfMatrix> instances(const GltfJson& instancing, const GltfMatrix& world, const std::string& label) {
    const GltfJson* names = document_.find(instancing, "attributes");
    std::optional<std::size_t> count;
    const auto array = [&](const char* name, int components) -> std::optional<GltfAccessor> {
      const auto accessor = names ? document_.index(*names, name) : std::nullopt;
      if (!accessor) return {};
      GltfAccessor values(document_, *accessor);
      if (values.components() != components || count.value_or(values.count()) != values.count())
        fail(label + " has instances whose " + name + " does not fit");
      count = values.count();
      return values;
    };
    const auto moves = array("TRANSLATION", 3), turns = array("ROTATION", 4), scales = array("SCALE", 3);
    if (names && names->is_object())
      for (const auto& [name, value] : names->items())
        if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE") left_out_.insert(name + " of instances");
    std::vector<GltfMatrix> result;
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
      std::array<double, 3> move{}, scale = {1, 1, 1};
      std::array<double, 4> turn = {0, 0, 0, 1};
      for (int k = 0; moves && k < 3; ++k) move[k] = moves->value(i, k);
      for (int k = 0; turns && k < 4; ++k) turn[k] = turns->value(i, k);
      for (int k = 0; scales && k < 3; ++k) scale[k] = scales->value(i, k);
      result.push_back(world * compose(move, turn, scale));
    }
    return result;
  }

  // --- meshes ---

  void add_mesh(std::size_t m, const Placement& placement, std::vector<double> weights) {
    const GltfJson& mesh = document_.get("meshes", m);
    if (weights.empty()) weights = document_.numbers(mesh, "weights", 0);
    const GltfJson* primitives = document_.find(mesh, "primitives");
    if (!primitives || !primitives->is_array()) fail(document_.label("meshes", m) + " has no primitives");
    shape_.name = placement.name.empty() ? document_.text(mesh, "name") : placement.name;
    std::vector<std::size_t> objects;
    for (std::size_t copy = 0; copy < placement.matrices.size(); ++copy)
      objects.push_back(object_.add(placement.name.empty() ? document_.label("meshes", m) : placement.name));
    for (const GltfJson& json : *primitives) {
      if (!json.is_object()) fail(document_.label("meshes", m) + " has a primitive that is no object");
      if (has_triangles(document_, json))
        add_primitive(GltfPrimitive(document_, json, document_.label("meshes", m)), placement, objects, weights);
      else
        ++lines_;
    }
    if (!std::exchange(used_[m], 1)) note_targets(mesh, *primitives, weights);
  }

  void add_primitive(const GltfPrimitive& primitive, const Placement& placement,
                     const std::vector<std::size_t>& objects, const std::vector<double>& weights) {
    require_room(primitive.vertices(), shape_.mesh.points.size(), placement.matrices.size(), "vertices");
    const std::vector<Point> points = morphed_points(primitive, weights);
    const std::vector<Values> values = values_of(primitive, weights);
    if (!placement.skin) note_joints(primitive);
    std::size_t left_over = 0;
    const std::vector<std::uint32_t> corners = primitive.triangles(left_over);
    require_room(corners.size(), shape_.mesh.corners.size(), placement.matrices.size(), "corners");
    left_over_ += left_over;
    const bool skinned = placement.skin && has_weights(primitive);
    for (std::size_t copy = 0; copy < objects.size(); ++copy) {
      const std::size_t first = shape_.mesh.points.size();
      const std::vector<GltfMatrix> matrices =
          skinned ? skin_matrices(primitive, *placement.skin) : std::vector{placement.matrices[copy]};
      const bool mirrored = add_points(points, matrices);
      add_faces(corners, first, mirrored);
      object_.add_faces(corners.size() / 3, objects[copy]);
      material_.add_faces(corners.size() / 3, material_label(primitive));
      for (const Values& v : values) attributes_.append(v.name, v.components, v.type, first, placed(v, matrices));
      note_color(primitive, first);
    }
  }

  /// Room for `more` in every copy beside those that are there.
  void require_room(std::size_t more, std::size_t there, std::size_t copies, const char* what) const {
    const std::size_t most = std::min<std::size_t>(document_.most_values(), std::numeric_limits<std::int32_t>::max());
    if (more > 0 && copies > (most - there) / more)
      fail("has more than " + std::to_string(most) + " " + what + ", too many for its size; it is damaged, or shows " +
           "the same meshes too often");
  }

  /// By one matrix for all, or one for each. Returns whether the surface is turned inside out.
  bool add_points(const std::vector<Point>& points, const std::vector<GltfMatrix>& matrices) {
    for (std::size_t i = 0; i < points.size(); ++i)
      shape_.mesh.points.push_back(transformed(matrices[matrices.size() == 1 ? 0 : i], points[i]));
    return !points.empty() && determinant3(matrices[0]) < 0;
  }

  static std::vector<double> placed(const Values& v, const std::vector<GltfMatrix>& matrices) {
    std::vector<double> values = v.values;
    for (std::size_t i = 0; v.turn && i < values.size() / 3; ++i) {
      double* vector = values.data() + 3 * i;
      const Point p = v.turn(matrices[matrices.size() == 1 ? 0 : i], {vector[0], vector[1], vector[2]});
      std::copy(p.begin(), p.end(), vector);
    }
    return values;
  }

  void add_faces(const std::vector<std::uint32_t>& corners, std::size_t first, bool mirrored) {
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      std::array<std::size_t, 3> t = {first + corners[i], first + corners[i + 1], first + corners[i + 2]};
      if (mirrored) std::swap(t[1], t[2]);
      for (const std::size_t v : t) shape_.mesh.corners.push_back(static_cast<std::int32_t>(v));
      shape_.mesh.end_face();
    }
  }

  // --- morph targets ---

  /// Adds the weighted changes to tuples of so many numbers.
  static void add_changes(const std::vector<std::optional<GltfAccessor>>& changes, const std::vector<double>& weights,
                          int components, double* values) {
    for (std::size_t t = 0; t < std::min(changes.size(), weights.size()); ++t) {
      if (!changes[t] || weights[t] == 0) continue;
      const int width = std::min(components, changes[t]->components());
      for (std::size_t i = 0; i < changes[t]->count(); ++i)
        for (int k = 0; k < width; ++k)
          values[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(k)] +=
              weights[t] * changes[t]->value(i, k);
    }
  }

  static std::vector<double> morphed(const GltfPrimitive& primitive, const std::string& name,
                                     const std::vector<double>& weights) {
    const GltfAccessor source = primitive.attribute(name);
    std::vector<double> values;
    values.reserve(source.count() * static_cast<std::size_t>(source.components()));
    for (std::size_t i = 0; i < source.count(); ++i)
      for (int k = 0; k < source.components(); ++k) values.push_back(source.value(i, k));
    add_changes(primitive.changes(name), weights, source.components(), values.data());
    return values;
  }

  static std::vector<Point> morphed_points(const GltfPrimitive& primitive, const std::vector<double>& weights) {
    const std::vector<double> values = morphed(primitive, "POSITION", weights);
    std::vector<Point> points(primitive.vertices());
    for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(values.data() + 3 * i, 3, points[i].begin());
    return points;
  }

  void note_targets(const GltfJson& mesh, const GltfJson& primitives, const std::vector<double>& weights) {
    std::size_t count = 0;
    for (const GltfJson& primitive : primitives)
      if (const GltfJson* list = document_.find(primitive, "targets"); list && list->is_array())
        count = std::max(count, list->size());
    const GltfJson* extras = document_.find(mesh, "extras");
    const std::vector<std::string> names =
        extras ? document_.texts(*extras, "targetNames") : std::vector<std::string>();
    for (std::size_t t = 0; t < count; ++t)
      target_names_.add((t < names.size() ? names[t] : "target " + std::to_string(t)) + " " +
                        number(t < weights.size() ? weights[t] : 0));
    targets_ += count;
  }

  // --- skins ---

  void note_joints(const GltfPrimitive& primitive) {
    for (const auto& [semantic, accessor] : primitive.attributes())
      if (set_number(semantic, "JOINTS_") || set_number(semantic, "WEIGHTS_")) left_out_.insert(semantic);
  }

  bool has_weights(const GltfPrimitive& primitive) {
    const auto& all = primitive.attributes();
    if (all.contains("JOINTS_0") && all.contains("WEIGHTS_0")) return true;
    ++unskinned_;
    return false;
  }

  /// How the skin moves every vertex.
  std::vector<GltfMatrix> skin_matrices(const GltfPrimitive& primitive, const GltfSkin& skin) {
    std::vector<std::pair<GltfAccessor, GltfAccessor>> sets;
    for (int s = 0; primitive.attributes().contains("JOINTS_" + std::to_string(s)) &&
                    primitive.attributes().contains("WEIGHTS_" + std::to_string(s));
         ++s) {
      sets.emplace_back(primitive.attribute("JOINTS_" + std::to_string(s)),
                        primitive.attribute("WEIGHTS_" + std::to_string(s)));
      if (sets.back().first.components() != 4 || sets.back().second.components() != 4)
        fail(primitive.label() + " has joints or weights that are not VEC4");
    }
    std::vector<GltfMatrix> matrices;
    for (std::size_t i = 0; i < primitive.vertices(); ++i) matrices.push_back(blended(primitive, skin, sets, i));
    return matrices;
  }

  /// The joints' matrices by their weights, which are taken relative to their sum; without any, the first joint.
  GltfMatrix blended(const GltfPrimitive& primitive, const GltfSkin& skin,
                     const std::vector<std::pair<GltfAccessor, GltfAccessor>>& sets, std::size_t i) {
    const auto joint = [&](std::size_t s, int k) -> const GltfMatrix& {
      const double j = sets[s].first.value(i, k);
      if (!(j >= 0 && j < static_cast<double>(skin.size())))
        fail(primitive.label() + " refers to joint " + number(j) + ", but its skin has " + std::to_string(skin.size()));
      return skin.joint(static_cast<std::size_t>(j));
    };
    GltfMatrix matrix{};
    double sum = 0;
    for (std::size_t s = 0; s < sets.size(); ++s)
      for (int k = 0; k < 4; ++k) {
        const double weight = sets[s].second.value(i, k);
        if (weight == 0) continue;
        const GltfMatrix& m = joint(s, k);
        for (std::size_t e = 0; e < 16; ++e) matrix[e] += weight * m[e];
        sum += weight;
      }
    constexpr double rounding = 0.02;  // of eight weights in bytes, generously
    if (!(std::abs(sum - 1) <= rounding)) ++odd_weights_;
    if (sum == 0) return joint(0, 0);
    for (double& x : matrix) x /= sum;
    return matrix;
  }

  // --- attributes ---

  /// The number of its material among the labels; parts without are of a material without a name.
  std::size_t material_label(const GltfPrimitive& primitive) {
    const auto material = primitive.material();
    const auto [known, is_new] = material_labels_.try_emplace(material, 0);
    if (is_new) {
      const std::string name = material ? document_.text(document_.get("materials", *material), "name") : "";
      known->second = material_.add(name.empty() && material ? "material " + std::to_string(*material) : name);
    }
    return known->second;
  }

  GltfMaterial material_of(const GltfPrimitive& primitive) const {
    const auto material = primitive.material();
    return material ? read_material(document_, *material) : GltfMaterial();
  }

  std::vector<Values> values_of(const GltfPrimitive& primitive, const std::vector<double>& weights) {
    const GltfMaterial material = material_of(primitive);
    note_textures(material);
    std::vector<Values> result;
    std::set<std::string> taken;
    if (!primitive.attributes().contains("NORMAL")) {
      ++without_normals_;
      taken.insert("normal");
    }
    for (const auto& [semantic, accessor] : primitive.attributes()) {
      std::string name = name_of(semantic, material);
      if (name.empty()) continue;
      const GltfAccessor source = primitive.attribute(semantic);
      if (is_color({in_small_letters(name), source.components(), Domain::vertex, {}})) name = in_small_letters(name);
      while (!taken.insert(name).second) name += '_';
      Values v{name, source.components(), source.number_type(), morphed(primitive, semantic, weights)};
      if (const auto set = set_number(semantic, "TEXCOORD_")) turn_uv(primitive, v, *set, material);
      if (v.components == 3) v.turn = turning(semantic, name);
      if (semantic == "NORMAL" && v.components != 3) fail(primitive.label() + " has a NORMAL that is no VEC3");
      if (set_number(semantic, "COLOR_") && v.components != 3 && v.components != 4)
        fail(primitive.label() + " has a " + semantic + " that is no VEC3 or VEC4");
      result.push_back(std::move(v));
    }
    return result;
  }

  /// The name of an attribute here; "" for those that are no attributes here, which are noted where nobody uses them.
  std::string name_of(const std::string& semantic, const GltfMaterial& material) {
    if (const auto set = set_number(semantic, "COLOR_")) return *set == 0 ? "color" : "color" + std::to_string(*set);
    if (const auto set = set_number(semantic, "TEXCOORD_"))
      return *set == material.uv_set ? "uv" : "uv" + std::to_string(*set);
    if (semantic == "NORMAL") return "normal";
    if (const auto own = semantic.find_first_not_of('_'); own > 0 && own != std::string::npos)
      return semantic.substr(own);
    if (semantic != "POSITION" && !set_number(semantic, "JOINTS_") && !set_number(semantic, "WEIGHTS_"))
      left_out_.insert(semantic);
    return "";
  }

  /// Directions are painted on the mesh as it lies in its own node. Blender's exporter turns points to y up, and leaves
  /// vectors that it does not know.
  Point (*turning(const std::string& semantic, const std::string& name))(const GltfMatrix&, const Point&) {
    if (semantic == "NORMAL") return turned_normal;
    if (!matching_name(name, {direction_name})) return nullptr;
    const GltfJson* asset = document_.find(document_.root(), "asset");
    if (!asset || document_.text(*asset, "generator").find("Blender") == std::string::npos) return turned;
    ++from_blender_;
    return [](const GltfMatrix& m, const Point& v) { return turned(m, {v[0], v[2], -v[1]}); };
  }

  void turn_uv(const GltfPrimitive& primitive, Values& v, std::size_t set, const GltfMaterial& material) const {
    if (v.components != 2) fail(primitive.label() + " has a TEXCOORD_" + std::to_string(set) + " that is no VEC2");
    const auto& map = set == material.uv_set ? material.uv_map : GltfMaterial().uv_map;
    for (std::size_t i = 0; i < v.values.size(); i += 2) {
      const double a = v.values[i], b = v.values[i + 1];
      v.values[i] = map[0][0] * a + map[1][0] * b + map[2][0];
      v.values[i + 1] = 1 - (map[0][1] * a + map[1][1] * b + map[2][1]);
    }
  }

  void note_textures(const GltfMaterial& material) {
    if (!material.image.empty()) images_.insert(material.image);
    other_uv_ = other_uv_ || material.other_uv;
  }

  void note_color(const GltfPrimitive& primitive, std::size_t first) {
    const std::array<double, 4> color = material_of(primitive).base_color;
    if (!primitive.attributes().contains("COLOR_0"))
      uncolored_.push_back({first, first + primitive.vertices(), color});
    else if (color != white)
      ++tinted_;
  }

  /// Where parts have none, viewers make them, and none of the others are of use.
  void drop_incomplete_normals() {
    if (without_normals_ == 0) return;
    if (std::erase_if(shape_.mesh.attributes, [](const Attribute& a) { return a.name == "normal"; }) > 0)
      left_out_.insert("NORMAL");
  }

  /// Parts without vertex colours have the base colours of their materials.
  void fill_colors() {
    auto& all = shape_.mesh.attributes;
    auto color = std::find_if(all.begin(), all.end(), [](const Attribute& a) { return a.name == "color"; });
    const auto is_tinted = [](const Uncolored& part) { return part.color != white; };
    if (std::none_of(uncolored_.begin(), uncolored_.end(), is_tinted)) return;
    if (color != all.end() && !is_color(*color)) return;  // a "_color" of another form
    if (color == all.end()) {
      const bool opaque =
          std::all_of(uncolored_.begin(), uncolored_.end(), [](const auto& p) { return p.color[3] == 1; });
      color = all.insert(color, {"color", opaque ? 3 : 4, Domain::vertex, {}});
      color->values.resize(shape_.mesh.points.size() * color->components, 1);
    }
    for (const Uncolored& part : uncolored_)
      for (std::size_t v = part.first; v < part.end; ++v)
        std::copy_n(part.color.begin(), color->components,
                    color->values.begin() + static_cast<std::ptrdiff_t>(v * color->components));
    note("base-colors", uncolored_.size(),
         counted(uncolored_.size(), "part") +
             " without vertex colours; their color is the base colour of their material");
  }

  // --- findings ---

  void note(const char* kind, std::size_t count, const std::string& text) {
    if (count > 0) shape_.findings.push_back({kind, text, count, 0, true});
  }

  void report() {
    note("points-and-lines", lines_, counted(lines_, "primitive") + " made of points or lines; left out");
    note("left-over-corners", left_over_,
         counted(left_over_, "corner") + " behind the last triangle of a part; left out");
    note("morph-targets", targets_,
         counted(targets_, "morph target") + ", taken at the weights " + target_names_.text());
    note("unskinned-parts", unskinned_,
         counted(unskinned_, "part") + " of skinned nodes without joints and weights; placed by the node");
    note("skin-weights", odd_weights_,
         counted(odd_weights_, "vertex") + " whose skin weights do not sum to 1; taken relative to their sum");
    note("blender-directions", from_blender_,
         "directions written by Blender, which leaves them with z up; turned as it turns the points");
    note("tinted-colors", tinted_,
         counted(tinted_, "part") +
             " whose vertex colours viewers multiply with a base colour; the vertex colours are kept as they are");
    ShortList names;
    for (const std::string& name : left_out_) names.add(name);
    note("left-out-attributes", left_out_.size(),
         names.text() + ": left out" +
             (left_out_.contains("NORMAL") ? ", since some parts have none; normals are those of the surface" : ""));
    report_textures();
    report_unused();
  }

  void report_textures() {
    ShortList files;
    for (const std::string& image : images_)
      if (image != "?") files.add(image);
    note("textures", images_.size(),
         counted(images_.size(), "base colour texture") +
             (images_.contains("?") ? " inside the file" : " (" + files.text() + ")") +
             " left out; formulas read an image with --texture NAME=FILE" +
             (images_.contains("?") ? ", which may be this file" : ""));
    note("several-uv", other_uv_ ? 1 : 0,
         "textures of one material with different uv or transforms; uv is that of the base colour");
  }

  void report_unused() {
    ShortList meshes, others;
    std::size_t count = 0;
    for (std::size_t m = 0; m < used_.size(); ++m)
      if (!used_[m] && ++count > 0) meshes.add(document_.label("meshes", m));
    note("unused-meshes", count, meshes.text() + ": not in the scene, left out");
    std::size_t left = 0;
    const auto add = [&](std::size_t n, const char* what) {
      if (n > 0) others.add(counted(n, what));
      left += n;
    };
    const GltfJson* punctual = document_.extension(document_.root(), "KHR_lights_punctual");
    const GltfJson* lights = punctual ? document_.find(*punctual, "lights") : nullptr;
    add(document_.count("animations"), "animation");
    add(document_.count("cameras"), "camera");
    add(lights && lights->is_array() ? lights->size() : 0, "light");
    note("not-surface", left, others.text() + ": no part of a surface, left out");
  }

  GltfDocument document_;
  RawShape shape_;
  JoinedAttributes attributes_;
  FaceLabels object_, material_;
  std::map<std::optional<std::size_t>, std::size_t> material_labels_;
  std::vector<char> used_;  // per mesh
  std::vector<Uncolored> uncolored_;
  std::set<std::string> left_out_, images_;
  ShortList target_names_;
  std::size_t lines_ = 0, left_over_ = 0, targets_ = 0, unskinned_ = 0, odd_weights_ = 0, tinted_ = 0,
              without_normals_ = 0, from_blender_ = 0;
  bool other_uv_ = false;
};

}  // namespace

RawShape read_gltf(std::string_view bytes, const std::string& path) { return GltfReader(bytes, path).read(); }

}  // namespace pelage
