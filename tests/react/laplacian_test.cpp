#include "react/laplacian.h"

#include "catalog/models.h"
#include "react/model.h"
#include "react/support.h"

namespace pelage {
namespace {

Model model_of(const std::string& body) { return compile(parse_model("name = 'm'\n" + body, "m.toml")); }

std::string fault(const std::string& body) {
  return error_of([&] { model_of(body); });
}

/// A model of a species u with this rate, and v that diffuses.
std::string with_rate(const std::string& rate) {
  return "[species.u]\nrate = '" + rate + "'\n[species.v]\ndiffusion = 3\nrate = '-v'\n[parameters]\nD = 5\n";
}

TEST(Laplacian, ConstantCoefficientsAreTakenOutOfTheRate) {
  const Model m = model_of(with_rate("u*v - 2*D*lap(v)/4 + 7 - (lap(u) - 3*(lap(v) + u))*(-2)"));
  EXPECT_EQ(m.coupled(), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(m.cross_diffusion(0, 1), -2.5 - 6);
  EXPECT_EQ(m.cross_diffusion(1, 0), 0);
  EXPECT_EQ(m.diffusion_constant(0), 2);
  EXPECT_EQ(m.diffusion_constant(1), 3);
  const std::vector<NodeId> rate = {m.equations().rate[0]};
  const auto value = [](const Symbol& s) { return s.index == 0 ? 1.5 : 4.0; };
  EXPECT_EQ(evaluate(m.equations().graph, rate, value)[0], 1.5 * 4 + 7 - 6 * 1.5);
}

TEST(Laplacian, OfTheSpeciesItselfIsDiffusion) {
  const Model m = model_of(with_rate("-u + D*lap(u)"));
  EXPECT_TRUE(m.coupled().empty());
  EXPECT_EQ(m.diffusion_constant(0), 5);
  EXPECT_EQ(fault(with_rate("u - D*lap(u)")),
            "m.toml:3:9: diffusion and lap(u) in the rate of \"u\" add up to -5; it must be 0 or more");
}

TEST(Laplacian, DefinitionsMayHoldThem) {
  const Model m = model_of(with_rate("flux - u") + "[definitions]\nflux = 'D*lap(v)'\n");
  EXPECT_EQ(m.cross_diffusion(0, 1), 5);
}

TEST(Laplacian, AlgebraicSpeciesAreDeterminedByTheOthers) {
  const Model m =
      model_of("[species.w]\nequals = 'u^2 - 3*lap(u) + lap(w)'\n[species.u]\nrate = 'w - u'\ndiffusion = 1\n");
  EXPECT_TRUE(m.algebraic(0));
  EXPECT_FALSE(m.algebraic(1));
  EXPECT_EQ(m.cross_diffusion(0, 1), -3);
  EXPECT_EQ(m.diffusion_constant(0), 1);
  EXPECT_EQ(m.coupled(), (std::vector<std::size_t>{0, 1}));
}

TEST(Laplacian, AlgebraicSpeciesThatNobodyReadsFollow) {
  const std::string u = "[species.u]\nrate = '-u'\ndiffusion = 1\n";
  const auto follows = [](const std::string& text) { return model_of(text).follows(1); };
  EXPECT_TRUE(follows(u + "[species.w]\nequals = 'u^2'\n"));
  EXPECT_TRUE(model_of(u + "[species.w]\nequals = 'u^2'\n").coupled().empty());
  EXPECT_FALSE(follows(u + "[species.w]\nequals = 'u^2 + lap(w)'\n"));
  EXPECT_FALSE(follows(u + "[species.w]\nequals = 'lap(u)'\n"));
  EXPECT_FALSE(follows("[species.u]\ndiffusion = 1\nrate = 'w - u'\n[species.w]\nequals = 'u^2'\n"));
  EXPECT_FALSE(follows("[species.u]\ndiffusion = 1\nrate = 'lap(w) - u'\n[species.w]\nequals = 'u^2'\n"));
  EXPECT_FALSE(follows("[species.u]\nrate = '-u'\ndiffusion = '1 + w^2'\n[species.w]\nequals = 'u^2'\n"));
  EXPECT_FALSE(follows("[species.u]\nrate = '-u'\ndiffusion = 1\n[species.w]\ndiffusion = 0\nrate = 'u'\n"));
}

TEST(Laplacian, FaultsAreLocated) {
  const std::string varies =
      "must stand alone or times numbers and parameters; a coefficient that varies belongs in `diffusion`";
  for (const char* rate :
       {"u*lap(v)", "lap(v)^2", "x*lap(v)", "floor(lap(v))", "if(u > 1, lap(v), 0)", "lap(v)/t", "1/lap(v)"})
    EXPECT_EQ(fault(with_rate(rate)), "m.toml:3:9: lap(v) " + varies) << rate;
  EXPECT_EQ(fault(with_rate("lap(q)")), "m.toml:3:13: expected the name of a species in lap(), found 'q'");
  EXPECT_EQ(fault(with_rate("lap(D)")), "m.toml:3:13: expected the name of a species in lap(), found 'D'");
  EXPECT_EQ(fault(with_rate("lap(u*v)")),
            "m.toml:3:14: expected ')' after the name of the species; for lap(formula) make a species that equals the "
            "formula, found '*'");
  EXPECT_EQ(fault(with_rate("lap u")), "m.toml:3:9: \"lap\" is a function: expected '(' after it");
  EXPECT_EQ(fault("[species.u]\nrate = 'u'\ndiffusion = 'lap(u)'"),
            "m.toml:4:14: lap() can stand in `rate` and in `equals` only; make a species that equals it");
  EXPECT_EQ(fault("[species.u]\nrate = 'lap(v)'\ndiffusion = 'x'\n[species.v]\nrate = '0'\ndiffusion = 1"),
            "m.toml:4:14: the diffusion of species \"u\" varies; one that is linked to others by lap() must be made of "
            "numbers and parameters");
}

TEST(Laplacian, FaultsOfAlgebraicSpecies) {
  const std::string u = "[species.u]\nrate = '-u'\ndiffusion = 1\n";
  EXPECT_EQ(fault(u + "[species.w]\nequals = 'u'\ninitial = 1"),
            "m.toml:7:11: species \"w\" is determined by `equals`; give nothing else beside it");
  EXPECT_EQ(fault(u + "[species.w]\nequals = 'u + 2*w'"),
            "m.toml:6:11: `equals` of \"w\" uses \"w\" outside of lap(), which has no rate of its own; write its "
            "formula out");
  EXPECT_EQ(fault("[species.w]\nequals = 'x'"), "m.toml:1:1: model \"m\" has no species with a rate");
}

}  // namespace
}  // namespace pelage
