#include "react/model.h"

#include "catalog/models.h"
#include "react/support.h"

namespace pelage {
namespace {

const char* const text = R"toml(name = "test"
[species.u]
diffusion = "2*D"
rate = "-u*w + feed"
initial = "1"
min = "-feed"
[species.v]
C0 = "x"
C1 = "D*u"
C2 = "cos(t)"
C3 = "feed*u"
[definitions]
w = "v^2"
[parameters]
D = 0.5
feed = { value = 0.1, min = 0, max = 1 }
[variants.hungry]
title = "more"
parameters = { feed = 0.9 }
)toml";

std::string replaced(std::string in, const std::string& from, const std::string& to) {
  EXPECT_NE(in.find(from), std::string::npos) << from;
  return in.replace(in.find(from), from.size(), to);
}

/// The message when one piece of the text above is replaced.
std::string fault(const std::string& from, const std::string& to) {
  return error_of([&] { compile(parse_model(replaced(text, from, to), "m.toml")); });
}

TEST(Model, CompilesToTheGeneralisedEquation) {
  const Model model = compile(parse_model(text, "m.toml"));
  ASSERT_EQ(model.species_count(), 2u);
  EXPECT_EQ(model.species_name(0), "u");
  EXPECT_EQ(model.diffusion_constant(0), 1.0);
  EXPECT_EQ(model.diffusion_constant(1), std::nullopt);
  EXPECT_EQ(model.diffusion_dependence(0), 0u);
  EXPECT_EQ(model.diffusion_dependence(1), unsigned{on_place} | unsigned{on_species});
  EXPECT_EQ(model.lower(0), -0.1);
  EXPECT_EQ(model.upper(0), std::numeric_limits<double>::infinity());
  const Equations& e = model.equations();
  EXPECT_EQ(e.c3[0], compile(parse_model(text, "m.toml"), {{"feed", 0.1}}).equations().c3[0]);
  EXPECT_EQ(e.graph.constant_value(e.c3[0]), 0.1);
}

TEST(Model, ConstantC0AndC1AreMultiplied) {
  const Model model = compile(parse_model(replaced(replaced(text, "\"x\"", "3"), "D*u", "D"), "m.toml"));
  EXPECT_EQ(model.diffusion_constant(1), 1.5);
}

TEST(Model, OverridesRoundTrip) {
  const ModelSource source = parse_model(text, "m.toml");
  const Model model = compile(source, {{"feed", 0.25}, {"D", 0.75}});
  EXPECT_EQ(model.parameters()[0].value, 0.75);
  EXPECT_EQ(model.parameters()[1].value, 0.25);
  EXPECT_EQ(model.diffusion_constant(0), 1.5);
  EXPECT_EQ(compile(model.source()).diffusion_constant(0), 1.5);
  EXPECT_EQ(compile(source).diffusion_constant(0), 1.0);
  EXPECT_EQ(with_variant(source, "hungry").parameters[1].value, 0.9);
  EXPECT_EQ(with_variant(source, "hungry").title, "more");
}

TEST(Model, UnknownAndOutOfRangeParameters) {
  const ModelSource source = parse_model(text, "m.toml");
  EXPECT_EQ(error_of([&] {
              compile(source, {{"fed", {0.5, {"r.toml", 4, 9}}}});
            }),
            "r.toml:4:9: model \"test\" has no parameter \"fed\"; did you mean \"feed\"?");
  EXPECT_EQ(error_of([&] {
              compile(source, {{"quux", 0.5}});
            }),
            "model \"test\" has no parameter \"quux\"; it has D, feed");
  EXPECT_EQ(error_of([&] {
              compile(source, {{"feed", {1.5, {"r.toml", 4, 9}}}});
            }),
            "r.toml:4:9: parameter \"feed\" is 1.5; it must be from 0 to 1");
  EXPECT_EQ(error_of([&] {
              compile(source, {{"D", std::numeric_limits<double>::quiet_NaN()}});
            }),
            "parameter \"D\" is nan; it must be finite");
  EXPECT_EQ(error_of([&] { with_variant(source, "hungri"); }),
            "model \"test\" has no variant \"hungri\"; did you mean \"hungry\"?");
}

TEST(Model, KnowsWhetherRatesJump) {
  const auto jumps = [](const std::string& rate) {
    return compile(parse_model("name = 'm'\n[species.u]\ndiffusion = 1\nrate = '" + rate + "'\n[parameters]\np = 1\n",
                               "m.toml"))
        .jumps();
  };
  for (const char* rate : {"if(u > 0.5, 1, 0)", "floor(u)", "if(u, x, 0)", "(u > 1)*u"})
    EXPECT_TRUE(jumps(rate)) << rate;
  for (const char* rate : {"u*u", "if(p > 0.5, u, 0)", "if(x > 0, u, -u)", "max(u, 0)", "abs(u)", "floor(x)*u"})
    EXPECT_FALSE(jumps(rate)) << rate;
}

TEST(Model, FaultsAreLocated) {
  EXPECT_EQ(fault("-u*w + feed", "-u*w + fed"), "m.toml:4:16: unknown name \"fed\"; did you mean \"feed\"?");
  EXPECT_EQ(fault("v^2", "v^2 + w"), "m.toml:13:12: \"w\" is being defined here; a definition cannot use itself");
  EXPECT_EQ(fault("v^2\"", "q\"\nq = \"1\""),
            "m.toml:13:6: \"q\" is defined further down; definitions use those above them");
  EXPECT_EQ(fault("w = \"v^2\"", "sin = \"v^2\"\nw = \"1\""),
            "m.toml:13:8: \"sin\" has a meaning in formulas already; choose another name");
  EXPECT_EQ(fault("w = \"v^2\"", "D = \"v^2\"\nw = \"1\""), "m.toml:13:6: \"D\" is given twice; choose another name");
  EXPECT_EQ(fault("w = \"v^2\"", "\"w-1\" = \"v^2\""),
            "m.toml:13:10: \"w-1\" is not a name; use letters, digits and _, starting with a letter");
  EXPECT_EQ(fault("initial = \"1\"", "initial = \"v\""),
            "m.toml:5:12: initial values cannot depend on species or on time");
  EXPECT_EQ(fault("min = \"-feed\"", "min = \"u\""), "m.toml:6:8: a bound must be a number or made of parameters");
  EXPECT_EQ(fault("min = \"-feed\"", "min = 2\nmax = 1"),
            "m.toml:6:7: the lower bound of species \"u\" is above its upper bound");
  EXPECT_EQ(fault("\"2*D\"", "\"-D\""), "m.toml:3:14: the diffusion of species \"u\" is -0.5; it must be 0 or more");
  EXPECT_EQ(fault("diffusion = \"2*D\"\n", ""),
            "m.toml:2:1: species \"u\" has no diffusion; give 0 if it does not diffuse");
  EXPECT_EQ(fault("C0 = \"x\"", "diffusion = 1\nC0 = \"x\""),
            "m.toml:7:1: species \"v\": give diffusion, or C0 and C1, not both");
  EXPECT_EQ(fault("C2 = \"cos(t)\"\nC3 = \"feed*u\"", ""),
            "m.toml:7:1: species \"v\" has no rate; give rate, or C2 and C3");
  EXPECT_EQ(fault("rate = ", "C3 = 1\nrate = "), "m.toml:2:1: species \"u\": give rate, or C2 and C3, not both");
  EXPECT_EQ(fault("value = 0.1", "value = -3"), "m.toml:16:8: parameter \"feed\" is -3; it must be from 0 to 1");
  EXPECT_EQ(error_of([] { compile(parse_model("name = 'x'", "m.toml")); }), "m.toml:1:1: model \"x\" has no species");
}

}  // namespace
}  // namespace pelage
