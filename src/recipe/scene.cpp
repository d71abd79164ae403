#include "recipe/scene.h"

#include <algorithm>
#include <cmath>

#include "base/named_files.h"
#include "base/number.h"
#include "recipe/read_recipe.h"

namespace pelage {

namespace {

/// A number within these bounds, where there is one.
void read_number(const Value& table, const std::string& key, double low, double high, double& target) {
  const Value* v = table.find(key);
  if (!v) return;
  target = v->number();
  if (!(target >= low && target <= high))
    throw Error(Fault::usage, "'" + key + "' must lie between " + pelage::number(low) + " and " + pelage::number(high),
                v->where());
}

template <std::size_t n>
std::array<double, n> read_numbers(const Value& v, const std::string& what) {
  if (v.items().size() != n) throw Error(Fault::usage, what + " takes " + std::to_string(n) + " numbers", v.where());
  std::array<double, n> numbers{};
  for (std::size_t k = 0; k < n; ++k) {
    numbers[k] = v.items()[k].number();
    if (!std::isfinite(numbers[k])) throw Error(Fault::usage, what + " must be finite", v.items()[k].where());
  }
  return numbers;
}

constexpr double far_off = 1e6, turns = 3600, smallest = 1e-6;

ScenePlace read_place(const Value& table) {
  ScenePlace place;
  if (const Value* at = table.find("at")) place.at = read_numbers<3>(*at, "'at'");
  read_number(table, "turn", -turns, turns, place.turn);
  read_number(table, "tilt", -turns, turns, place.tilt);
  read_number(table, "scale", smallest, far_off, place.scale);
  return place;
}

std::vector<std::array<double, 2>> read_profile(const Value& v) {
  std::vector<std::array<double, 2>> profile;
  for (const Value& corner : v.items()) {
    profile.push_back(read_numbers<2>(corner, "a corner of 'turned', radius and height,"));
    if (profile.back()[0] < 0)
      throw Error(Fault::usage, "the radius of a corner of 'turned' is below 0", corner.where());
  }
  if (profile.size() < 3)
    throw Error(Fault::usage, "'turned' takes three corners at least, radius and height each", v.where());
  if (profile.front()[0] > 0 || profile.back()[0] > 0)
    throw Error(Fault::usage, "the first and the last corner of 'turned' lie on the axis: their radius is 0",
                v.where());
  return profile;
}

void read_material(const Value& table, SceneThing& thing) {
  if (const Value* color = table.find("color")) thing.color = Given<std::string>{color->string(), color->where()};
  for (const ChannelKind& kind : channel_kinds)
    if (const std::string name(kind.name); kind.channel != Channel::height && table.find(name)) {
      read_number(table, name, std::max(kind.low, -far_off), std::min(kind.high, far_off),
                  thing.material[kind.channel]);
    }
}

void read_coat(const Value& table, SceneThing& thing) {
  const Value* name = table.find("recipe");
  const bool own = table.find("stage") != nullptr;
  if (name && own) throw Error(Fault::usage, "give a 'recipe' by its name, or a 'stage' here, not both", name->where());
  if (name) thing.recipe_name = Given<std::string>{named_text(name->string(), name->where()), name->where()};
  if (own) thing.recipe = read_recipe(table, "");
  const Value* material = table.find("material");
  if (material && (name || own))
    throw Error(Fault::usage, "a 'material' is for things without a coat; say in the 'look' what the coat is like",
                material->where());
  if (material) read_material(*material, thing);
  if (const Value* size = table.find("size"))
    thing.size = Given<Length>{
        size->kind() == Value::Kind::number ? Length{size->number()} : parse_length(size->string(), size->where()),
        size->where()};
  double seed = -1;
  read_number(table, "seed", 0, 9007199254740992.0, seed);
  if (seed >= 0) thing.seed = static_cast<std::uint64_t>(seed);
}

SceneThing read_thing(const Value& table) {
  SceneThing thing;
  thing.where = table.where();
  const Value *shape = table.find("shape"), *turned = table.find("turned");
  if ((shape != nullptr) == (turned != nullptr))
    throw Error(Fault::usage, "a thing has either a 'shape' or a profile that is 'turned'", table.where());
  if (shape) thing.shape = {named_shape(shape->string(), shape->where()), shape->where()};
  if (turned) thing.turned = read_profile(*turned);
  read_coat(table, thing);
  if (const Value* framed = table.find("framed")) thing.framed = framed->boolean();
  if (const Value* places = table.find("places"))
    for (const Value& place : places->items()) thing.places.push_back(read_place(place));
  else
    thing.places.push_back(read_place(table));
  if (thing.places.empty()) throw Error(Fault::usage, "'places' is empty", table.where());
  return thing;
}

SceneCamera read_camera(const Value& table) {
  SceneCamera camera;
  read_number(table, "azimuth", -turns, turns, camera.azimuth);
  read_number(table, "elevation", -89, 89, camera.elevation);
  read_number(table, "angle", 1, 120, camera.angle);
  read_number(table, "margin", -0.45, 0.45, camera.margin);
  read_number(table, "aspect", 0.1, 10, camera.aspect);
  return camera;
}

SceneLamp read_lamp(const Value& table) {
  SceneLamp lamp;
  read_number(table, "azimuth", -turns, turns, lamp.azimuth);
  read_number(table, "elevation", 10, 90, lamp.elevation);
  read_number(table, "size", 0.02, 1, lamp.size);
  return lamp;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& file) {
  const Value document = parse_document(text, file);
  Scene scene;
  scene.name = document.string_or("name", file);
  scene.summary = document.string_or("summary", "");
  if (const Value* camera = document.find("camera")) scene.camera = read_camera(*camera);
  if (const Value* lamp = document.find("lamp")) scene.lamp = read_lamp(*lamp);
  if (const Value* v = document.find("background")) scene.background = Given<std::string>{v->string(), v->where()};
  read_number(document, "exposure", -20, 20, scene.exposure);
  for (const Value& thing : document.at("thing").items()) scene.things.push_back(read_thing(thing));
  if (scene.things.empty()) throw Error(Fault::usage, "a scene needs a [[thing]]", {file});
  document.require_all_read();
  return scene;
}

}  // namespace pelage
