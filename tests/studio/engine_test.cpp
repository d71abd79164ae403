#include "studio/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "pelage/analyse.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "studio/message.h"

namespace pelage {
namespace {

constexpr const char* sphere = "builtin:sphere?n=642";
constexpr const char* spots = R"(
[[stage]]
model = "turing:production"
size = 0.3
until = 40
)";

class Studio {
 public:
  Message ask(const std::string& what, Header request = Header::object(), std::vector<MessageBlock> blocks = {}) {
    request["do"] = what;
    return decode(engine_->handle(encode({std::move(request), std::move(blocks)})));
  }
  /// The same where it has to be answered.
  Message told(const std::string& what, Header request = Header::object(), std::vector<MessageBlock> blocks = {}) {
    Message reply = ask(what, std::move(request), std::move(blocks));
    EXPECT_EQ(reply.header["ok"], true) << what << ": " << reply.header.dump();
    return reply;
  }
  Message begin(const std::string& recipe, bool keep = false) {
    return told("begin", {{"recipe", recipe}, {"keep", keep}});
  }
  Message grow(std::size_t steps) { return told("advance", {{"steps", steps}}); }

 private:
  std::unique_ptr<StudioEngine> engine_ = std::make_unique<StudioEngine>("test");
};

template <class T>
const std::vector<T>& block(const Message& message, const std::string& name) {
  for (const MessageBlock& b : message.blocks)
    if (b.name == name) return std::get<std::vector<T>>(b.values);
  throw std::runtime_error("no block " + name);
}

Studio on_sphere(const std::string& recipe = spots) {
  Studio studio;
  studio.told("shape", {{"name", sphere}});
  studio.begin(recipe);
  return studio;
}

std::vector<float> values(Studio& studio, const std::string& species) {
  return block<float>(studio.told("field", {{"species", species}}), "values");
}

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(StudioEngine, GrowsTheCoatOfTheProgram) {
  Studio studio = on_sphere();
  while (studio.grow(7).header["running"] == true) {
  }
  const std::string studios = text_of(block<std::uint8_t>(studio.told("export", {{"format", ".ply"}}), "bytes"));
  const TriangleMesh coat = grow(load_shape(sphere), parse_recipe(spots, "spots.toml"));
  EXPECT_EQ(studios, mesh_bytes(coat, ".ply", {.name = "coat"}));
}

TEST(StudioEngine, GoesOnAfterItsEnd) {
  Studio studio = on_sphere();
  Message state;
  do state = studio.grow(50);
  while (state.header["running"] == true);
  EXPECT_EQ(state.header["status"], "time reached");
  EXPECT_EQ(state.header["time"], 40);
  state = studio.grow(3);
  EXPECT_GT(state.header["time"].get<double>(), 40);
  EXPECT_LT(state.header["time"].get<double>(), 80);
  EXPECT_EQ(state.header["running"], true);
}

// The ramp goes from white to black.
TEST(StudioEngine, ColoursAreThoseOfTheRampAtTheNodes) {
  Studio studio = on_sphere(std::string(spots) + "[look]\nramp = \"mono\"\nspecies = \"b\"\n");
  const Message state = studio.grow(40);
  const std::vector<float> b = values(studio, "b");
  const auto& colors = block<std::uint8_t>(state, "colors");
  ASSERT_EQ(colors.size(), 4 * b.size());
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    EXPECT_EQ(colors[4 * i + 3], 255);
    if (b[i] < b[i + 1]) {
      EXPECT_GE(colors[4 * i], colors[4 * i + 4]) << i;
    }
  }
}

TEST(StudioEngine, ParametersMayChangeWhileItGrows) {
  Studio studio = on_sphere();
  const double time = studio.grow(20).header["time"];
  const std::vector<float> before = values(studio, "a");
  const Message kept = studio.begin(std::string(spots) + "[stage.parameters]\ns = 0.06\n", true);
  EXPECT_EQ(kept.header["kept"], true);
  EXPECT_EQ(kept.header["time"], time);
  EXPECT_EQ(values(studio, "a"), before);
  for (const Header& p : kept.header["stages"][0]["parameters"]) {
    if (p["name"] == "s") {
      EXPECT_EQ(p["value"], 0.06);
    }
  }
  EXPECT_GT(studio.grow(1).header["time"].get<double>(), time);

  const Message other = studio.begin("[[stage]]\nmodel = \"schnakenberg\"\nsize = 0.3\n", true);
  EXPECT_EQ(other.header["kept"], false);
  EXPECT_EQ(other.header["time"], 0);
}

TEST(StudioEngine, PaintComesToTheSideOfTheBrush) {
  Studio studio = on_sphere();
  studio.grow(5);
  const std::vector<float> before = values(studio, "b");
  studio.told(
      "paint",
      {{"species", "b"}, {"value", 50}, {"radius", 0.5}, {"hardness", 0.4}, {"points", {{0, 0, 1}, {0.2, 0, 0.98}}}});
  const std::vector<float> after = values(studio, "b");
  const Message described = studio.told("fine");
  std::size_t full = 0, none = 0, part = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] == 50)
      ++full;
    else
      ++(after[i] == before[i] ? none : part);
  }
  EXPECT_GT(full, 5U);
  EXPECT_GT(part, 5U);
  EXPECT_GT(none, after.size() / 2);
  const Message top = studio.told("sample", {{"point", {0, 0, 1}}}),
                foot = studio.told("sample", {{"point", {0, 0, -1}}});
  EXPECT_EQ(top.header["values"][1]["value"], 50);
  EXPECT_LT(foot.header["values"][1]["value"].get<double>(), 10);
  studio.grow(3);
  EXPECT_NE(values(studio, "b"), after);
}

TEST(StudioEngine, StatesComeBack) {
  Studio studio = on_sphere();
  studio.grow(10);
  const Header kept = studio.told("keep_state").header;
  const Message unbroken = studio.grow(6);
  studio.begin("[[stage]]\nmodel = \"schnakenberg\"\nsize = 0.3\n");
  const Message restored = studio.told("restore_state", {{"state", kept["state"]}});
  EXPECT_EQ(restored.header["steps"], 10);
  EXPECT_EQ(restored.header["recipe"], spots);
  EXPECT_EQ(block<std::uint8_t>(studio.grow(6), "colors"), block<std::uint8_t>(unbroken, "colors"));
  EXPECT_EQ(studio.ask("restore_state", {{"state", 99}}).header["ok"], false);
  studio.told("shape", {{"name", "builtin:cube"}});
  EXPECT_EQ(studio.ask("restore_state", {{"state", kept["state"]}}).header["ok"], false);
}

TEST(StudioEngine, StatesKeepTheLookThatTheyHad) {
  Studio studio = on_sphere();
  studio.grow(10);
  const std::string looked = std::string(spots) + "[look]\nramp = \"mono\"\n";
  const auto colors = block<std::uint8_t>(studio.told("look", {{"recipe", looked}}), "colors");
  const Header kept = studio.told("keep_state").header;
  studio.begin(spots);
  const Message restored = studio.told("restore_state", {{"state", kept["state"]}});
  EXPECT_EQ(restored.header["recipe"], looked);
  EXPECT_EQ(block<std::uint8_t>(restored, "colors"), colors);
}

TEST(StudioEngine, FaultsAreLocatedAndChangeNothing) {
  Studio studio = on_sphere();
  const Message before = studio.grow(4);
  const Header error = studio.ask("begin", {{"recipe", "[[stage]]\nmodel = \"turing\"\nsise = 0.1\n"}}).header["error"];
  EXPECT_EQ(error["fault"], "usage");
  EXPECT_EQ(error["line"], 3);
  EXPECT_EQ(studio.ask("check", {{"recipe", "[[stage]]\nmodel = \"turng\"\n"}}).header["error"]["line"], 2);
  EXPECT_EQ(error["file"], "recipe.toml");
  EXPECT_EQ(error["message"].get<std::string>().find("recipe.toml"), std::string::npos);
  EXPECT_EQ(studio.ask("look", {{"recipe", std::string(spots) + "[look]\nramp = \"gry\"\n"}}).header["ok"], false);
  EXPECT_EQ(studio.ask("paint", {{"species", "q"}, {"value", 1}, {"radius", 1}, {"points", {{0, 0, 0}}}}).header["ok"],
            false);
  EXPECT_EQ(studio.ask("shape", {{"name", "cow.obj"}}).header["ok"], false);
  EXPECT_EQ(
      studio.ask("shape", {{"name", "cow.obj"}}, {{"bytes", std::vector<std::uint8_t>{'v', ' ', 'x'}}}).header["ok"],
      false);
  EXPECT_EQ(studio.grow(1).header["steps"], 5);
}

TEST(StudioEngine, RecipesReadNoFiles) {
  Studio studio = on_sphere();
  for (const char* recipe :
       {"[[texture]]\nname = \"age\"\nfile = \"age.png\"\n[[stage]]\nmodel = \"turing\"\n",
        "[[stage]]\nmodel = \"/etc/model.toml\"\n", "[[stage]]\nmodel = \"mine.toml:variant\"\n"}) {
    for (const char* what : {"begin", "check", "look", "analyse"}) {
      const Header refused = studio.ask(what, {{"recipe", recipe}}).header;
      EXPECT_EQ(refused["ok"], false) << what << recipe;
      EXPECT_NE(refused["error"]["message"].get<std::string>().find("file"), std::string::npos) << refused;
    }
  }
}

TEST(StudioEngine, RecipesHoldModelsOfTheirOwn) {
  Studio studio = on_sphere();
  const std::string model = studio.told("model_text", {{"name", "schnakenberg"}}).header["text"];
  const auto recipe = [](const std::string& text) {
    return "[[stage]]\nmodel = \"mine\"\nsize = 0.3\n\n[models]\nmine = '''\n" + text + "'''\n";
  };
  const Message begun = studio.begin(recipe(model));
  EXPECT_EQ(begun.header["stages"][0]["species"].size(), 2U);
  studio.grow(3);
  const Header error = studio.ask("check", {{"recipe", recipe("spices = 3\n" + model)}}).header["error"];
  EXPECT_EQ(error["file"], "recipe.toml");
  EXPECT_EQ(error["line"], 7) << error;
  EXPECT_EQ(
      studio.ask("check", {{"recipe", "[stage]\nmodel = \"a.b\"\n[models]\n\"a.b\" = \"\"\n"}}).header["error"]["line"],
      4);
}

// Gray and Scott's spots grow from seeds alone; Schnakenberg's a + b decides.
TEST(StudioEngine, MapsTellWherePatternsGrow) {
  Studio studio;
  const Header x = {{"parameter", "a"}, {"low", 0.02}, {"high", 0.5}, {"count", 7}},
               y = {{"parameter", "b"}, {"low", 0.4}, {"high", 1.4}, {"count", 5}};
  const Header recipe = "[[stage]]\nmodel = \"schnakenberg\"\n";
  const Message map = studio.told("parameter_map", {{"recipe", recipe}, {"stage", 0}, {"x", x}, {"y", y}});
  const auto& regime = block<std::uint8_t>(map, "regime");
  ASSERT_EQ(regime.size(), 35U);
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      const double a = 0.02 + 0.48 * static_cast<double>(i) / 6, b = 0.4 + static_cast<double>(j) / 4;
      const Analysis known = analyse("schnakenberg", {{"a", a}, {"b", b}});
      EXPECT_EQ(map.header["regimes"][regime[7 * j + i]], known.verdict) << a << " " << b;
      EXPECT_FLOAT_EQ(block<float>(map, "growth")[7 * j + i], static_cast<float>(known.stability.growth));
    }
  const Header other = {{"parameter", "q"}, {"low", 0}};
  EXPECT_EQ(studio.ask("parameter_map", {{"recipe", recipe}, {"x", other}, {"y", y}}).header["ok"], false);
  EXPECT_EQ(studio.ask("parameter_map", {{"recipe", recipe}, {"x", x}, {"y", x}}).header["ok"], false);
}

TEST(StudioEngine, TilesShowWhatGrows) {
  Studio studio;
  const auto tile = [&](double a) {
    return studio.told("map_tile", {{"recipe", "[[stage]]\nmodel = \"schnakenberg\"\n"},
                                    {"x", {{"parameter", "a"}, {"low", a}}},
                                    {"y", {{"parameter", "b"}, {"low", 0.9}}},
                                    {"texels", 24}});
  };
  const Message grown = tile(0.1), plain = tile(0.4);
  EXPECT_EQ(grown.header["outcome"], "pattern");
  EXPECT_EQ(plain.header["outcome"], "uniform");
  const auto& pixels = block<std::uint8_t>(grown, "pixels");
  ASSERT_EQ(pixels.size(), 4U * 24 * 24);
  const auto [low, high] = std::ranges::minmax(pixels);
  EXPECT_GT(high - low, 100);
}

TEST(StudioEngine, AnswersWhatIsNoRequest) {
  StudioEngine engine("test");
  for (const std::string& bytes : {std::string(), std::string(5, '\xff'), encode({}), encode({{{"do", 3}}, {}}),
                                   encode({{{"do", "dance"}}, {}}), encode({{{"do", "advance"}}, {}})})
    EXPECT_EQ(decode(engine.handle(bytes)).header["ok"], false);
  Studio studio = on_sphere();
  for (const Header& request : {Header{{"steps", -1}}, Header{{"steps", 0.5}}, Header{{"steps", "3"}},
                                Header{{"milliseconds", 1e9}}, Header{{"milliseconds", -1}}})
    EXPECT_EQ(studio.ask("advance", request).header["ok"], false) << request.dump();
}

TEST(StudioEngine, StagesBeforeTheLastShowThemselves) {
  Studio studio;
  studio.told("shape", {{"name", sphere}});
  const std::string leopard = studio.told("recipe_text", {{"name", "leopard"}}).header["text"];
  const Message begun = studio.begin(leopard);
  EXPECT_EQ(begun.header["stages"].size(), 2U);
  EXPECT_EQ(begun.header["stage"], 0);
  EXPECT_EQ(block<std::uint8_t>(begun, "colors").size(), 4 * begun.header["nodes"].get<std::size_t>());
}

TEST(StudioEngine, KnowsWhatThereIs) {
  Studio studio;
  const Header all = studio.told("catalog").header;
  EXPECT_EQ(all["recipes"].size(), recipe_names().size());
  EXPECT_EQ(all["reads"], Header(readable_extensions()));
  for (const Header& model : all["models"]) EXPECT_FALSE(model["parameters"].is_null());
  EXPECT_EQ(studio.told("hello").header["engine"], "test");
}

TEST(StudioEngine, DispersionHasItsMaximumAtTheWavelength) {
  Studio studio;
  const Header a = studio.told("analyse", {{"recipe", "[[stage]]\nmodel = \"schnakenberg\"\n"}, {"stage", 0}}).header;
  const auto lengths = a["wavelengths"].get<std::vector<double>>(),
             rates = a["growth_rates"].get<std::vector<double>>();
  ASSERT_EQ(lengths.size(), rates.size());
  const auto highest = std::ranges::max_element(rates) - rates.begin();
  EXPECT_NEAR(lengths[static_cast<std::size_t>(highest)] / a["wavelength"].get<double>(), 1, 0.02);
  EXPECT_GT(rates[static_cast<std::size_t>(highest)], 0);
}

TEST(StudioEngine, BakesOnTheMeshAsItWasGiven) {
  Studio studio;
  studio.told("shape", {{"name", "builtin:cube?n=152"}});
  studio.begin(spots);
  studio.grow(10);
  const std::string glb =
      text_of(block<std::uint8_t>(studio.told("export", {{"format", ".glb"}, {"bake", 64}}), "bytes"));
  const ShapeFile read = read_shape_bytes(glb, "coat.glb");
  EXPECT_EQ(read.mesh.triangles.size(), load_shape("builtin:cube?n=152").triangles.size());
  EXPECT_NE(read.mesh.find("uv"), nullptr);
  EXPECT_NE(glb.find("image/png"), std::string::npos);
  EXPECT_EQ(studio.ask("export", {{"format", ".ply"}, {"bake", 64}}).header["ok"], false);
}

}  // namespace
}  // namespace pelage
