#include "catalog/scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/shapes.h"
#include "look/ramp.h"
#include "pelage/grow.h"
#include "recipe/document.h"
#include "shape/normals.h"
#include "shape/split_corners.h"
#include "shape/turned.h"

namespace pelage {

namespace {

using Eigen::Vector3d;

/// What the pictures need, other attributes are dropped.
constexpr int vertices_of_turned = 4000;

const EmbeddedFile& scene_file(const std::string& name) {
  if (const EmbeddedFile* f = find_embedded("scenes", name)) return *f;
  throw Error(Fault::usage, unknown_name("scene", name, scene_names()));
}

/// work(), whose faults are said to be those of a place in the scene unless they have one of their own.
template <class Work>
auto located(const Location& where, Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.fault() == Fault::cancelled || error.where().line > 0) throw;
    throw Error(error.fault(), error.what(), where);
  }
}

TriangleMesh shape_of(const SceneThing& thing) {
  if (!thing.turned.empty()) return turned_shape(thing.turned, vertices_of_turned);
  return located(thing.shape.where, [&] {
    ShapeFile file = find_shape(thing.shape.value);
    if (file.mesh.triangles.empty() || file.nodes)
      throw Error(Fault::usage, thing.shape.value + " is no surface; scenes are made of these");
    return std::move(file.mesh);
  });
}

/// Smooth normals, one colour and one material all over.
TriangleMesh plain_coat(TriangleMesh mesh, const SceneThing& thing) {
  const std::size_t n = mesh.points.size();
  Attribute normal{"normal", 3, Domain::vertex, {}}, color{"color", 3, Domain::vertex, {}};
  for (const Point& v : normals_of(mesh)) normal.values.insert(normal.values.end(), v.begin(), v.end());
  Color paint = {0.55, 0.52, 0.48};
  if (thing.color) paint = located(thing.color->where, [&] { return parse_hex_color(thing.color->value); });
  for (std::size_t v = 0; v < n; ++v) color.values.insert(color.values.end(), paint.begin(), paint.end());
  mesh.attributes = {std::move(normal), std::move(color)};
  for (const auto& [channel, value] : thing.material)
    mesh.set({std::string(kind_of(channel).attribute), 1, Domain::vertex, std::vector<double>(n, value)});
  return mesh;
}

TriangleMesh coated(const SceneThing& thing, const std::string& quality, const Progress& progress) {
  TriangleMesh shape = shape_of(thing);
  if (!thing.recipe_name && !thing.recipe) return plain_coat(std::move(shape), thing);
  Recipe recipe = thing.recipe
                      ? *thing.recipe
                      : located(thing.recipe_name->where, [&] { return load_recipe(thing.recipe_name->value); });
  if (!quality.empty()) recipe.quality = {quality, {}};
  if (thing.size) recipe.stages.front().size = thing.size;
  if (thing.seed) recipe.stages.front().seed = *thing.seed;
  recipe.look.fields = false;
  return located(thing.where, [&] { return split_corners(grow(shape, recipe, progress)); });
}

Eigen::Affine3d motion_of(const ScenePlace& place) {
  constexpr double radian = std::numbers::pi / 180;
  return Eigen::Translation3d(place.at[0], place.at[1], place.at[2]) *
         Eigen::AngleAxisd(place.turn * radian, Vector3d::UnitY()) *
         Eigen::AngleAxisd(place.tilt * radian, Vector3d::UnitX()) * Eigen::Scaling(place.scale);
}

/// The values of a copy: normals turn, lengths grow.
std::vector<double> moved(const Attribute& a, const Eigen::Affine3d& motion, double scale) {
  std::vector<double> values = a.values;
  if (a.name == "normal")
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      Eigen::Map<Vector3d> normal(&values[i]);
      normal = (motion.linear() * normal / scale).eval();
    }
  for (const ChannelKind& kind : channel_kinds)
    if (kind.length && a.name == kind.attribute)
      for (double& value : values) value *= scale;
  return values;
}

/// What things without an attribute have instead.
double usual_value(const std::string& attribute) {
  for (const ChannelKind& kind : channel_kinds)
    if (attribute == kind.attribute) return kind.usual;
  return 0;
}

/// `from` values, or the usual ones, for so many vertices behind those of `to`.
void append_values(const std::string& name, int components, std::vector<double> from, std::size_t count,
                   std::size_t before, TriangleMesh& to) {
  if (!to.find(name))
    to.set({name, components, Domain::vertex,
            std::vector<double>(before * static_cast<std::size_t>(components), usual_value(name))});
  std::vector<double>& values = to.find(name)->values;
  from.resize(count * static_cast<std::size_t>(components), usual_value(name));
  values.insert(values.end(), from.begin(), from.end());
}

bool is_seen(const Attribute& a) {
  if (a.domain != Domain::vertex) return false;
  return a.name == "normal" || a.name == "color" ||
         std::ranges::any_of(channel_kinds, [&](const ChannelKind& kind) { return kind.attribute == a.name; });
}

/// Of all things together: 8 GB of a picture's tree and of vertices. A row of "places" asks for more in a few bytes.
constexpr std::size_t most_triangles = 20000000;

void require_room(const SceneThing& thing, std::size_t triangles, std::size_t before) {
  const std::size_t all = before + thing.places.size() * triangles;
  if (all >= most_triangles)
    throw Error(Fault::usage,
                "so far the scene has " + std::to_string(all) + " triangles, and has to stay below " +
                    std::to_string(most_triangles) + "; take fewer places or coarser shapes",
                thing.where);
}

void append(const TriangleMesh& coat, const ScenePlace& place, bool framed, BuiltScene& scene) {
  const Eigen::Affine3d motion = motion_of(place);
  const std::size_t before = scene.mesh.points.size(), count = coat.points.size();
  for (const Point& p : coat.points) {
    const Vector3d q = motion * Vector3d(p[0], p[1], p[2]);
    scene.mesh.points.push_back({q.x(), q.y(), q.z()});
    if (framed) scene.framed.push_back(scene.mesh.points.back());
  }
  const auto first = static_cast<std::int32_t>(before);
  for (const Triangle& t : coat.triangles) scene.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const Attribute& a : coat.attributes) {
    if (!is_seen(a)) continue;
    append_values(a.name, a.components, moved(a, motion, place.scale), count, before, scene.mesh);
  }
  for (const Attribute& a : scene.mesh.attributes)
    if (!coat.find(a.name)) append_values(a.name, a.components, {}, count, before, scene.mesh);
}

}  // namespace

std::vector<std::string> scene_names() { return embedded_names("scenes"); }

Scene load_scene(const std::string& name_or_path) {
  if (name_or_path.ends_with(".toml")) return parse_scene(read_text(name_or_path), name_or_path);
  const EmbeddedFile& f = scene_file(name_or_path);
  return parse_scene(std::string(f.text), std::string(f.path));
}

BuiltScene build_scene(const Scene& scene, const std::string& quality, const Progress& progress) {
  BuiltScene built;
  for (std::size_t i = 0; i < scene.things.size(); ++i) {
    const std::string task = "thing " + std::to_string(i + 1) + " of " + std::to_string(scene.things.size());
    if (progress && !progress(task, 0)) throw Error(Fault::cancelled, "the scene was cancelled");
    const TriangleMesh coat = coated(scene.things[i], quality, [&](std::string_view, double fraction) {
      return !progress || progress(task, fraction);
    });
    require_room(scene.things[i], coat.triangles.size(), built.mesh.triangles.size());
    for (const ScenePlace& place : scene.things[i].places) append(coat, place, scene.things[i].framed, built);
  }
  if (built.framed.empty()) built.framed = built.mesh.points;
  return built;
}

}  // namespace pelage
