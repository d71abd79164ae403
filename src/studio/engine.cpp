#include "studio/engine.h"

#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <new>
#include <optional>

#include "base/box.h"
#include "base/parallel.h"
#include "base/suggest.h"
#include "catalog/embedded.h"
#include "catalog/plan.h"
#include "catalog/recipes.h"
#include "catalog/shapes.h"
#include "io/write_mesh.h"
#include "pelage/error.h"
#include "shape/generators.h"
#include "shape/scalar_attributes.h"
#include "studio/catalogue.h"
#include "studio/live_coat.h"
#include "studio/parameter_plane.h"

namespace pelage {

namespace {

constexpr int protocol = 1;
constexpr std::size_t most_states = 64;
constexpr const char* recipe_file = "recipe.toml";
constexpr double longest_slice = 10'000;  ///< of an `advance` [milliseconds]

// --- what requests say -----------------------------------------------------------------------------------

[[noreturn]] void refuse(const std::string& why) { throw Error(Fault::usage, why); }

std::string text_of(const Header& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_string()) refuse(std::string("expected a text as \"") + key + "\"");
  return found->get<std::string>();
}

double number_of(const Header& request, const char* key, std::optional<double> otherwise = {}) {
  const auto found = request.find(key);
  if (found == request.end() && otherwise) return *otherwise;
  if (found == request.end() || !found->is_number() || !std::isfinite(found->get<double>()))
    refuse(std::string("expected a number as \"") + key + "\"");
  return found->get<double>();
}

std::size_t count_of(const Header& request, const char* key, std::optional<double> otherwise = {}, double most = 1e9) {
  const double value = number_of(request, key, otherwise);
  if (!(value >= 0 && value <= most) || value != std::floor(value))
    refuse(std::string("expected a whole number as \"") + key + "\"");
  return static_cast<std::size_t>(value);
}

/// An axis of a map; of one value where there is nothing to go through.
MapAxis axis_of(const Header& request, const char* key) {
  constexpr double most = 64;
  const Header axis = request.value(key, Header::object());
  if (!axis.is_object()) refuse(std::string("expected a parameter with its range as \"") + key + "\"");
  const double low = number_of(axis, "low");
  const std::size_t count = count_of(axis, "count", 1, most);
  return {text_of(axis, "parameter"), low, number_of(axis, "high", low), std::max(1, static_cast<int>(count))};
}

Point point_of(const Header& value) {
  const bool sound =
      value.is_array() && value.size() == 3 && value[0].is_number() && value[1].is_number() && value[2].is_number();
  if (!sound) refuse("expected a point, [x, y, z]");
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

BrushStroke stroke_of(const Header& request) {
  BrushStroke stroke{{}, number_of(request, "radius"), number_of(request, "hardness", 0.5)};
  if (!(stroke.radius > 0)) refuse("the radius of a brush must be positive");
  if (!(stroke.hardness >= 0 && stroke.hardness <= 1)) refuse("the hardness of a brush is from 0 to 1");
  const auto points = request.find("points");
  if (points == request.end() || !points->is_array() || points->empty()) refuse("a stroke has points");
  for (const Header& p : *points) stroke.points.push_back(point_of(p));
  return stroke;
}

/// A page may come with a recipe from anywhere, which has no folder to read from.
void refuse_files(const Recipe& recipe) {
  if (!recipe.textures.empty())
    throw Error(Fault::usage, "the studio reads no files that recipes name: paint a map instead of the texture",
                recipe.textures[0].name.where);
  for (const Stage& stage : recipe.stages)
    if (stage.model.value.find(".toml") != std::string::npos)
      throw Error(
          Fault::usage,
          "the studio reads no files that recipes name: put the text of \"" + stage.model.value + "\" under [models]",
          stage.model.where);
}

Recipe recipe_of(const Header& request) {
  Recipe recipe = parse_recipe(text_of(request, "recipe"), recipe_file);
  refuse_files(recipe);
  return recipe;
}

// --- what replies say ------------------------------------------------------------------------------------

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::usage:
      return "usage";
    case Fault::input:
      return "input";
    case Fault::numerics:
      return "numerics";
    case Fault::output:
      return "output";
    case Fault::cancelled:
      break;
  }
  return "cancelled";
}

/// The message without the place that it begins with.
std::string message_of(const Error& error) {
  const std::string text = error.what(), place = to_string(error.where()) + ": ";
  return text.starts_with(place) ? text.substr(place.size()) : text;
}

Message failed(Fault fault, const std::string& message, const Location& where = {}) {
  Header error = {{"fault", name_of(fault)}, {"message", message}};
  if (!where.file.empty()) error["file"] = where.file;
  if (where.line > 0) error["line"] = where.line;
  if (where.column > 0) error["column"] = where.column;
  Message m;
  m.header = {{"ok", false}, {"error", error}};
  return m;
}

Message shape_message(const ShapeFile& shape, const std::string& name) {
  const Box box = box_of(shape.mesh.points);
  Header attributes = Header::array(), findings = Header::array();
  for (const auto& [attribute, values] : scalar_attributes(shape.mesh)) attributes.push_back(attribute);
  for (const Finding& f : shape.findings)
    findings.push_back({{"kind", f.kind}, {"message", f.text}, {"repaired", f.repaired}});
  Message m;
  m.header = {{"name", name},
              {"vertices", shape.mesh.points.size()},
              {"triangles", shape.mesh.triangles.size()},
              {"low", box.low},
              {"high", box.high},
              {"diagonal", box.diagonal()},
              {"metres_per_unit", shape.mesh.metres_per_unit ? Header(*shape.mesh.metres_per_unit) : Header(nullptr)},
              {"up", shape.up == UpAxis::z ? "z" : "y"},
              {"attributes", attributes},
              {"findings", findings}};
  return m;
}

Message text_message(std::string_view text) {
  Message m;
  m.header["text"] = text;
  return m;
}

/// A coat as it stood, and what it grew by.
struct KeptState {
  std::size_t number = 0;
  std::string text;
  Recipe recipe;
  std::size_t shape = 0;
  std::string checkpoint;
};

}  // namespace

struct StudioEngine::Parts {
  Parts(std::string engine, std::atomic<bool>& stop) : kind(std::move(engine)), stop_asked(stop) {}

  std::string kind;
  std::atomic<bool>& stop_asked;
  std::optional<ShapeFile> shape;
  std::size_t shapes = 0;  ///< that there were: the number of this one
  std::string text;        ///< of the recipe
  Recipe recipe;
  std::optional<LiveCoat> coat;
  std::deque<KeptState> states;
  std::size_t kept = 0;

  LiveCoat& growing() {
    if (!coat) refuse("nothing grows: begin with a recipe");
    return *coat;
  }
  Progress progress() const {
    return [this](std::string_view, double) { return !stop_asked; };
  }

  Message hello(const Message&) const {
    Message m;
    m.header = {{"engine", kind}, {"version", PELAGE_VERSION}, {"protocol", protocol}, {"threads", concurrency()}};
    return m;
  }
  Message take_shape(const Message& request);
  Message begin(const Message& request);
  Message advance(const Message& request);
  Message look(const Message& request);
  Message paint(const Message& request);
  Message keep_state(const Message&);
  Message restore_state(const Message& request);
  Message export_coat(const Message& request);
};

Message StudioEngine::Parts::take_shape(const Message& request) {
  const std::string name = text_of(request.header, "name");
  const std::vector<std::uint8_t>* bytes = request.bytes("bytes");
  if (!bytes && !is_builtin_shape(name)) refuse("expected the bytes of the file \"" + name + "\"");
  ShapeFile made =
      bytes ? read_shape_bytes({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name) : find_shape(name);
  Message reply = shape_message(made, name);
  coat.reset();
  shape = std::move(made);
  ++shapes;
  return reply;
}

Message StudioEngine::Parts::begin(const Message& request) {
  if (!shape) refuse("there is no shape yet");
  Recipe asked = recipe_of(request.header);
  const bool keep = request.header.value("keep", Header(false)) == true;
  LiveCoat begun(*shape, asked, progress(), keep && coat ? &*coat : nullptr);
  recipe = std::move(asked);
  text = request.header["recipe"];
  coat.emplace(std::move(begun));
  return coat->described();
}

Message StudioEngine::Parts::advance(const Message& request) {
  using Clock = std::chrono::steady_clock;
  const double milliseconds = number_of(request.header, "milliseconds", longest_slice);
  if (!(milliseconds >= 0 && milliseconds <= longest_slice)) refuse("a slice takes at most ten seconds");
  const std::size_t steps = count_of(request.header, "steps", 1e9);
  const auto end = Clock::now() + std::chrono::duration<double, std::milli>(milliseconds);
  std::size_t done = 1;
  growing().advance([&] { return done++ < steps && Clock::now() < end && !stop_asked; });
  return coat->state();
}

/// The text goes on telling of the coat: what else has changed in it comes with the next `begin`.
Message StudioEngine::Parts::look(const Message& request) {
  const Recipe asked = recipe_of(request.header);
  growing().show(asked);
  recipe.look = asked.look;
  text = request.header["recipe"];
  return coat->colors();
}

Message StudioEngine::Parts::paint(const Message& request) {
  growing().paint(text_of(request.header, "species"), number_of(request.header, "value"), stroke_of(request.header));
  return coat->colors();
}

Message StudioEngine::Parts::keep_state(const Message&) {
  states.push_back({++kept, text, recipe, shapes, growing().checkpoint()});
  if (states.size() > most_states) states.pop_front();
  Message m;
  m.header["state"] = kept;
  return m;
}

Message StudioEngine::Parts::restore_state(const Message& request) {
  const std::size_t number = count_of(request.header, "state");
  const auto found = std::ranges::find(states, number, &KeptState::number);
  if (found == states.end() || found->shape != shapes) refuse("this state is no longer kept");
  LiveCoat begun(*shape, found->recipe, progress(), nullptr);
  begun.restore(found->checkpoint);
  recipe = found->recipe;
  text = found->text;
  coat.emplace(std::move(begun));
  Message reply = coat->described();
  reply.header["recipe"] = text;
  return reply;
}

Message StudioEngine::Parts::export_coat(const Message& request) {
  const std::string format = text_of(request.header, "format");
  const std::size_t texels = count_of(request.header, "bake", 0);
  if (texels > 0 && format != ".glb")
    refuse("of the studio's files only .glb holds images; leave them out of " + format);
  const SaveOptions options{request.header.value("name", std::string("coat")), shape->up};
  Message m;
  std::string bytes;
  if (texels > 0) {
    bytes = growing().baked(static_cast<int>(texels), options, progress());
  } else {
    const TriangleMesh mesh = growing().dressed();
    bytes = mesh_bytes(mesh, format, options);
    m.header["losses"] = losses(mesh, format);
  }
  m.blocks.push_back({"bytes", std::vector<std::uint8_t>(bytes.begin(), bytes.end())});
  return m;
}

namespace {

std::string_view model_text(const std::string& name) {
  const EmbeddedFile* file = find_embedded("models", name);
  if (!file) throw Error(Fault::usage, unknown_name("model", name, embedded_names("models")));
  return file->text;
}

}  // namespace

StudioEngine::StudioEngine(std::string kind) : parts_(std::make_unique<Parts>(std::move(kind), stop_)) {}
StudioEngine::~StudioEngine() = default;

std::string StudioEngine::handle(std::string_view bytes) {
  using Answer = std::function<Message(Parts&, const Message&)>;
  static const std::map<std::string, Answer, std::less<>> answers = {
      {"hello", [](Parts& p, const Message& m) { return p.hello(m); }},
      {"catalog", [](Parts&, const Message&) { return catalogue(); }},
      {"recipe_text", [](Parts&, const Message& m) { return text_message(recipe_text(text_of(m.header, "name"))); }},
      {"model_text", [](Parts&, const Message& m) { return text_message(model_text(text_of(m.header, "name"))); }},
      {"shape", [](Parts& p, const Message& m) { return p.take_shape(m); }},
      {"begin", [](Parts& p, const Message& m) { return p.begin(m); }},
      {"advance", [](Parts& p, const Message& m) { return p.advance(m); }},
      {"look", [](Parts& p, const Message& m) { return p.look(m); }},
      {"field", [](Parts& p, const Message& m) { return p.growing().field(text_of(m.header, "species")); }},
      {"fine", [](Parts& p, const Message&) { return p.growing().fine(); }},
      {"paint", [](Parts& p, const Message& m) { return p.paint(m); }},
      {"sample",
       [](Parts& p, const Message& m) { return p.growing().sampled(point_of(m.header.value("point", Header()))); }},
      {"keep_state", [](Parts& p, const Message& m) { return p.keep_state(m); }},
      {"restore_state", [](Parts& p, const Message& m) { return p.restore_state(m); }},
      {"analyse",
       [](Parts&, const Message& m) { return analysed(recipe_of(m.header), count_of(m.header, "stage", 0)); }},
      {"parameter_map",
       [](Parts&, const Message& m) {
         return parameter_map(recipe_of(m.header), count_of(m.header, "stage", 0), axis_of(m.header, "x"),
                              axis_of(m.header, "y"));
       }},
      {"map_tile",
       [](Parts& p, const Message& m) {
         return map_tile(recipe_of(m.header), count_of(m.header, "stage", 0), axis_of(m.header, "x"),
                         axis_of(m.header, "y"), std::max<std::size_t>(8, count_of(m.header, "texels", 64, 512)),
                         p.progress());
       }},
      {"export", [](Parts& p, const Message& m) { return p.export_coat(m); }},
      {"check",
       [](Parts&, const Message& m) {
         plan(recipe_of(m.header));
         return Message{};
       }},
  };
  stop_ = false;
  Message reply;
  try {
    const Message request = decode(bytes);
    const std::string asked = text_of(request.header, "do");
    const auto answer = answers.find(asked);
    if (answer == answers.end()) refuse("the studio does not know how to do \"" + asked + "\"");
    reply = answer->second(*parts_, request);
    Header header = {{"ok", true}};
    header.update(reply.header);
    reply.header = std::move(header);
  } catch (const Error& error) {
    reply = failed(error.fault(), message_of(error), error.where());
  } catch (const std::bad_alloc&) {
    reply = failed(Fault::numerics, "there is not enough memory for this");
  } catch (const nlohmann::json::exception& error) {
    reply = failed(Fault::input, std::string("not a message of the studio: ") + error.what());
  } catch (const std::exception& error) {
    reply = failed(Fault::numerics, std::string("unforeseen: ") + error.what());
  }
  return encode(reply);
}

}  // namespace pelage
