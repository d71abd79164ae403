#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/srgb.h"
#include "catalog/bind.h"
#include "io/texture_reader.h"
#include "look/dress.h"
#include "pelage/io.h"
#include "run/run.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

const std::filesystem::path folder = std::filesystem::path(PELAGE_BINARY_DIR) / "textures_test";

/// A recipe in the folder of the images.
Recipe recipe(const std::string& text) { return parse_recipe(text, (folder / "coat.toml").string()); }

void write_grey(const std::string& name, int width, int height, const std::function<int(int x, int y)>& byte) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.rgb.insert(image.rgb.end(), 3, static_cast<float>(linear_from_srgb(byte(x, y) / 255.0)));
  std::filesystem::create_directories(folder);
  write_png(image, (folder / name).string());
}

/// The square [0, 1]^2 as 2 n^2 triangles, with uv at the corners that keep away from the edges of the image: there it
/// would begin again.
TriangleMesh square(int n) {
  TriangleMesh mesh;
  Attribute uv{"uv", 2, Domain::corner, {}};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back({1.0 * i / n, 1.0 * j / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
    }
  for (const Triangle& t : mesh.triangles)
    for (const std::int32_t v : t)
      for (std::size_t k = 0; k < 2; ++k) uv.values.push_back(0.25 + 0.5 * mesh.points[static_cast<std::size_t>(v)][k]);
  mesh.attributes = {uv};
  return mesh;
}

std::string with_texture(const std::string& stage) {
  return "[[texture]]\nname = \"age\"\nfile = \"age.png\"\n[stage]\n" + stage;
}

/// A model of one species that starts as `initial` and stays so.
std::string standing(const std::string& initial) {
  const std::string path = (folder / "standing.toml").string();
  std::ofstream(path) << "name = 'standing'\nwavelength = 1\n[species.w]\ndiffusion = 0\nrate = '0'\ninitial = '"
                      << initial << "'\n";
  return "model = \"" + path + "\"\nsteps = 0\n";
}

Vector samples(const Growth& run) { return run.system().sampling->values * run.coefficients()[0]; }

class Textures : public ::testing::Test {
 protected:
  /// Rows grow by 5/255 upwards.
  void SetUp() override {
    write_grey("age.png", 1, 52, [](int, int y) { return 5 * (51 - y); });
    write_grey("dot.png", 64, 64, [](int x, int y) { return std::hypot(x - 25, y - 21) < 3 ? 0 : 255; });
  }
  /// The same as a function of the height in the square.
  static double age(double y) { return (52 * (0.25 + 0.5 * y) - 0.5) * 5 / 255; }
};

TEST_F(Textures, DriveParametersAndSizeAsTheSameValuesAtVerticesDo) {
  TriangleMesh painted = square(6);
  Attribute same{"same", 1, Domain::vertex, {}}, flipped{"flipped", 1, Domain::vertex, {}};
  for (const Point& p : painted.points) {
    same.values.push_back(age(p[1]));
    flipped.values.push_back(age(1 - p[1]));
  }
  painted.set(same);
  painted.set(flipped);
  const auto grown = [&](const std::string& attribute, const std::string& stepper) {
    Growth run(make_program(
        recipe(with_texture("model = \"turing\"\nsize = 0.4\nmethod = \"loop\"\nstepper = \"" + stepper +
                            "\"\nsize-map = \"1 + attribute(" + attribute +
                            ")\"\n[stage.parameters]\nDa = \"0.2 + 0.05*attribute(" + attribute + ")\"\n")),
        painted));
    run.advance(5);
    return run.coefficients()[0];
  };
  for (const std::string stepper : {"sbdf2", "paper"}) {
    const Vector a = grown("age", stepper), b = grown("same", stepper);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-8) << stepper;
    EXPECT_GT((a - grown("flipped", stepper)).cwiseAbs().maxCoeff(), 1e-4);
  }
}

/// Far finer than the vertices of the shape.
TEST_F(Textures, AreReadAtTheVerticesOfTheRefinedMesh) {
  const Texture dot = read_texture((folder / "dot.png").string());
  const Growth run(make_program(recipe("texture = { name = \"dot\", file = \"dot.png\" }\n[stage]\n" +
                                       standing("attribute(dot)") + "method = \"linear\"\nsize = 0.1\n"),
                                square(1)));
  ASSERT_GE(run.world().levels(), 5);
  const Vector u = samples(run);
  const auto& places = run.system().sampling->position;
  for (std::size_t i = 0; i < places.size(); ++i)
    ASSERT_NEAR(u[static_cast<Eigen::Index>(i)], color_at(dot, 0.25 + 0.5 * places[i][0], 0.25 + 0.5 * places[i][1])[1],
                1e-9);
  EXPECT_LT(u.minCoeff(), 0.1);
}

TEST_F(Textures, TheMeshIsFineEnoughForTheSmallestSizeBetweenTheVertices) {
  const auto edge = [](const std::string& map) {
    return make_program(recipe("texture = { name = \"dot\", file = \"dot.png\" }\n[stage]\nmodel = \"turing\"\nsize = "
                               "0.1\nsize-map = \"" +
                               map + "\"\n"),
                        square(1))
        .edge;
  };
  EXPECT_NEAR(edge("0.2 + 0.8*attribute(dot)") / edge("1"), 0.2, 0.05);
  EXPECT_THROW(edge("attribute(dot) - 0.5"), Error);
}

TEST_F(Textures, LayersReadThemAtTheVerticesOfTheCoat) {
  const Texture dot = read_texture((folder / "dot.png").string());
  const Recipe coat = recipe(
      "texture = { name = \"dot\", file = \"dot.png\" }\n[stage]\n" + standing("1") +
      "size = 1\nmethod = \"linear\"\n[look]\ndetail = 6\n[[look.layers]]\ncolor = \"#000000\"\n[[look.layers]]\n"
      "color = \"#ffffff\"\nopacity = \"attribute(dot)\"\n");
  const TriangleMesh mesh = dress(Growth(make_program(coat, square(1))).fields(), coat.look);
  const std::vector<double>& color = mesh.find("color")->values;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    ASSERT_NEAR(color[3 * v], color_at(dot, 0.25 + 0.5 * mesh.points[v][0], 0.25 + 0.5 * mesh.points[v][1])[0], 1e-6);
  EXPECT_LT(*std::ranges::min_element(color), 0.01);
}

std::string message_of(const std::string& text, TriangleMesh shape, Fault fault = Fault::usage) {
  try {
    make_program(recipe(text), std::move(shape));
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault) << error.what();
    return error.what();
  }
  return "";
}

TEST_F(Textures, FaultsAreSaidWithTheirPlace) {
  const std::string stage = "[stage]\nmodel = \"turing\"\n";
  TriangleMesh bare = square(2), taken = square(2);
  bare.attributes.clear();
  taken.set({"age_2", 1, Domain::vertex, std::vector<double>(taken.points.size(), 0.0)});
  const auto named = [&](const std::string& name, const std::string& file = "age.png") {
    return "[[texture]]\nname = \"" + name + "\"\nfile = \"" + file + "\"\n" + stage;
  };
  const auto expect = [&](const std::string& message, const std::string& place, const std::string& words) {
    EXPECT_NE(message.find(place), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  EXPECT_EQ(message_of(named("age"), square(2)), "");
  expect(message_of(named("age"), bare), "coat.toml:2:", "the shape has no uv");
  expect(message_of(named("age"), taken), "coat.toml:2:", "hide another attribute \"age_2\"");
  expect(message_of("[[texture]]\nname = \"age\"\nfile = \"age.png\"\n" + named("age"), square(2)),
         "coat.toml:5:", "hide another");
  expect(message_of(named("points"), square(2)), "coat.toml:2:", "hide another attribute \"points\"");
  expect(message_of(named("b"), square(2)), "coat.toml:2:", "called like a species");
  expect(message_of(named("my map"), square(2)), "coat.toml:2:", "is not a name");
  expect(message_of(named(""), square(2)), "coat.toml:2:", "is not a name");
  expect(message_of("[[texture]]\nname = \"age\"\n" + stage, square(2)), "coat.toml:1:", "\"file\" is missing");
  expect(message_of("[[texture]]\nname = \"age\"\nflie = \"age.png\"\n" + stage, square(2)),
         "coat.toml:3:", "did you mean \"file\"");
  expect(message_of("[[texture]]\nname = \"age\"\nfile = \"age.png\"\nwrap = 1\n" + stage, square(2)),
         "coat.toml:4:", "unknown key \"wrap\"");
  expect(message_of(named("age", "missing.png"), square(2), Fault::input), "missing.png: ", "cannot be opened");
  EXPECT_NO_THROW(plan(recipe(named("age", "missing.png"))));  // images are none of its business
}

}  // namespace
}  // namespace pelage
