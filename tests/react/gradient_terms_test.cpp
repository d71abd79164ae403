#include "react/gradient_terms.h"

#include <cmath>

#include "catalog/models.h"
#include "react/kinetics.h"
#include "react/model.h"
#include "react/stability.h"
#include "react/support.h"

namespace pelage {
namespace {

Model model_of(const std::string& body, const ModelChanges& changes = {}) {
  return compile(parse_model("name = 'm'\n" + body, "m.toml"), {}, changes);
}

std::string fault(const std::string& body) {
  return error_of([&] { model_of(body); });
}

/// A model of a species u with this rate, and v that diffuses.
std::string with_rate(const std::string& rate) {
  return "[species.u]\ndiffusion = 1\nrate = '" + rate +
         "'\n[species.v]\ndiffusion = 3\nrate = '-v'\n[parameters]\nD = 5\n";
}

/// The value of an expression at u = 2, v = 3, grad u . grad u = 10, grad u . grad v = 20, grad v . grad v = 30.
double value(const Model& m, NodeId id) {
  return evaluate(m.equations().graph, std::array{id}, [](const Symbol& s) {
    if (s.kind == Symbol::Kind::gradients) return 10.0 * (1 + s.index + s.other);
    return s.index == 0 ? 2.0 : 3.0;
  })[0];
}

TEST(GradientTerms, ProductsAreInputsOfTheRate) {
  const Model m = model_of(with_rate("u*grad2(u) - D*dot(grad v, grad u) + sqrt(dot(grad(v), grad v)) + grad2(u)/2"));
  EXPECT_EQ(m.equations().gradients.size(), 3u);
  EXPECT_TRUE(m.equations().fluxes.empty());
  EXPECT_DOUBLE_EQ(value(m, m.equations().rate[0]), 2 * 10 - 5 * 20 + std::sqrt(30.0) + 5);
  EXPECT_DOUBLE_EQ(value(m, m.equations().jacobian[0]), 10);  // at fixed gradients
  EXPECT_DOUBLE_EQ(value(m, m.equations().c2[0]) * 2 + value(m, m.equations().c3[0]), value(m, m.equations().rate[0]));
}

TEST(GradientTerms, KineticsReadThemBehindTheSpecies) {
  const Model m = model_of(with_rate("u*grad2(u) + x*dot(grad u, grad v)"));
  const std::vector<Point> places = {{7, 0, 0}, {8, 0, 0}};
  const Kinetics kinetics(m, {.positions = places}, 1);
  ASSERT_EQ(kinetics.input_count(), 4u);
  const std::vector<double> u = {2, 3}, v = {0, 0}, uu = {10, 100}, uv = {1, 2};
  std::vector<double> ru(2), rv(2), j(8);
  const double* in[] = {u.data(), v.data(), uu.data(), uv.data()};
  double* out[] = {ru.data(), rv.data()};
  kinetics.rates(in, 0, 0, 2, out);
  EXPECT_EQ(ru, (std::vector<double>{2 * 10 + 7 * 1, 3 * 100 + 8 * 2}));
  const std::vector<float> fu = {2, 3}, fv = {0, 0}, fuu = {10, 100}, fuv = {1, 2};
  std::vector<float> single(2), other(2);
  const float* float_in[] = {fu.data(), fv.data(), fuu.data(), fuv.data()};
  float* float_out[] = {single.data(), other.data()};
  kinetics.float_rates(0)(float_in, 0, 2, float_out);
  EXPECT_EQ(single, (std::vector<float>{27, 316}));
}

TEST(GradientTerms, FluxesAreTakenOutOfTheRate) {
  const Model m = model_of(with_rate("7 - 2*(div(u/D * grad v) + u) + div(v grad v - u^2 grad(v))/4"));
  ASSERT_EQ(m.equations().fluxes.size(), 1u);
  const Flux& flux = m.equations().fluxes[0];
  EXPECT_EQ(flux.species, 0u);
  EXPECT_EQ(flux.of, 1u);
  EXPECT_DOUBLE_EQ(value(m, flux.coefficient), -2 * 2.0 / 5 + (3.0 - 4.0) / 4);
  EXPECT_DOUBLE_EQ(value(m, m.equations().rate[0]), 7 - 4);
}

/// With a number for c it is lap(), which is implicit; of its own gradient, where that may vary, diffusion.
TEST(GradientTerms, WhatIsDiffusionIsDiffusion) {
  const Model lap = model_of(with_rate("div(2*D grad v) + div(grad u)"));
  EXPECT_EQ(lap.cross_diffusion(0, 1), 10);
  EXPECT_EQ(lap.diffusion_constant(0), 2);
  const Model own = model_of("[species.u]\nrate = 'div(u^2 grad u)*3'\n");
  EXPECT_TRUE(own.equations().fluxes.empty());
  EXPECT_DOUBLE_EQ(value(own, own.equations().diffusion[0]), 12);
  const Model coupled = model_of("[species.w]\nequals = 'lap(u)'\n[species.u]\nrate = 'div(u^2 grad u) - lap(w)'\n");
  EXPECT_EQ(coupled.equations().fluxes.size(), 1u);
}

/// An algebraic species whose gradient others use is not left behind.
TEST(GradientTerms, SpeciesWhoseGradientsAreReadAreKept) {
  const std::string w = "[species.w]\nequals = 'u^2'\n[species.u]\ndiffusion = 1\n";
  EXPECT_TRUE(model_of(w + "rate = '-u'\n").follows(0));
  EXPECT_FALSE(model_of(w + "rate = 'grad2(w)'\n").follows(0));
  EXPECT_FALSE(model_of(w + "rate = 'div(u grad w)'\n").follows(0));
  EXPECT_FALSE(model_of(w + "rate = 'div(w grad u)'\n").follows(0));
}

/// |grad u|^2 and div(c grad u) of a pattern that is twice as large are those of the model four times.
TEST(GradientTerms, TheyScaleWithAMapOfTheSize) {
  ModelChanges changes;
  changes.size = Formula{"2", {}};
  const Model m = model_of(with_rate("grad2(u) + div(u grad v)"), changes);
  EXPECT_DOUBLE_EQ(value(m, m.equations().rate[0]), 40);
  EXPECT_DOUBLE_EQ(value(m, m.equations().fluxes[0].coefficient), 8);
}

/// c of a wave exp(ikx) about u = 1, v = 2: -k^2 c in the Jacobian; products of gradients are of second order.
TEST(GradientTerms, DispersionRelation) {
  const Model m = model_of(
      "[species.v]\ndiffusion = 0.5\nrate = '2*u - v'\n"
      "[species.u]\ndiffusion = 0.3\nrate = '1 - u + 4*grad2(u)*v - 3*dot(grad u, grad v) - div(u^2*v/2 grad v)'\n"
      "initial = 1\n");
  const Stability s = analyse_at(m, {2, 1});
  for (const double k : {0.0, 0.4, 2.0}) {
    const double k2 = k * k, a = -1 - 0.5 * k2, b = 2, c = k2, d = -1 - 0.3 * k2;  // -(-k^2) u^2 v / 2
    const double half = (a + d) / 2, root = half * half - (a * d - b * c);
    EXPECT_NEAR(growth_rate(s, k).real(), half + (root > 0 ? std::sqrt(root) : 0), 1e-12) << k;
  }
}

TEST(GradientTerms, WhatIsNotPossibleIsRefused) {
  const std::string at = "m.toml:4:9: ", term = "m.toml:4:9: div() must stand alone or times numbers and parameters; ";
  EXPECT_EQ(fault(with_rate("u*div(u grad v)")), term + "what varies belongs inside");
  EXPECT_EQ(fault(with_rate("div(u grad v)^2")), term + "what varies belongs inside");
  const std::string alone =
      "a gradient is no number: |grad u|^2 is written grad2(u), and gradients stand in dot(grad u, grad v) and div(c "
      "grad u) only";
  EXPECT_EQ(fault(with_rate("grad(u)^2")), at + alone);
  EXPECT_EQ(fault(with_rate("2*grad u")), "m.toml:4:11: " + alone);
  EXPECT_EQ(fault(with_rate("|grad u|^2")),
            at + "'|' has no meaning in a formula; |a| is written abs(a), and |grad u|^2 grad2(u)");
  EXPECT_EQ(fault(with_rate("nabla(u)")),
            at + "unknown function \"nabla\"; |grad u|^2 is written grad2(u), the Laplacian of u lap(u)");
  EXPECT_EQ(
      fault(with_rate("\xE2\x88\x87u")),
      at + "'\xE2\x88\x87' has no meaning in a formula; the Laplacian of u is written lap(u), |grad u|^2 grad2(u)");
  EXPECT_EQ(fault(with_rate("u_x^2")), at + "unknown name \"u_x\"; a surface has no derivatives along x: |grad u|^2 is "
                                            "written grad2(u), the Laplacian lap(u)");
  EXPECT_EQ(
      fault(with_rate("grad2(u*v)")),
      "m.toml:4:16: expected ')' after the name of the species; for grad2(formula) make a species that equals the "
      "formula, found '*'");
  EXPECT_EQ(
      fault(with_rate("lap(grad2(u))")),
      "m.toml:4:13: expected the name of a species in lap() (for lap of a formula make a species that equals it), "
      "found 'grad2'");
  EXPECT_EQ(fault(with_rate("dot(u, v)")),
            "m.toml:4:13: expected grad of a species or the name of a vector in dot(), one u of which u_1, u_2 and u_3 "
            "are known, found 'u'");
  EXPECT_EQ(fault(with_rate("div(u)")),
            "m.toml:4:14: expected a gradient in each term of div(), as in div(c grad u), found ')'");
  EXPECT_EQ(fault(with_rate("div(1/grad u)")), "m.toml:4:15: " + alone);
  EXPECT_EQ(fault(with_rate("div(lap(u) grad v)")),
            at +
                "the coefficient c of div(c grad u) cannot contain lap(), grad2(), dot() or div(); make a species that "
                "equals it");
  EXPECT_EQ(fault("[species.u]\nrate = 'u'\ndiffusion = '1/(1 + grad2(u))'"),
            "m.toml:4:14: grad2() can stand in `rate` and in `equals` only; make a species that equals it");
  EXPECT_EQ(fault("[species.u]\nrate = 'u'\ndiffusion = 1\ninitial = 'dot(grad u, grad v)'\n[species.v]\nrate = "
                  "'1'\ndiffusion = 1"),
            "m.toml:5:12: dot() can stand in `rate` and in `equals` only");
  EXPECT_EQ(fault("[species.u]\nrate = 'u'\ndiffusion = 1\n[species.w]\nequals = 'div(u grad u)'"),
            "m.toml:6:11: div() can stand in `rate` only");
  EXPECT_EQ(fault("[species.u]\nC0 = '1 + x^2'\nrate = 'div(v grad v)'\n[species.v]\nrate = '1'\ndiffusion = 1"),
            "m.toml:3:7: C0 of species \"u\" varies; its rate cannot contain div()");
}

}  // namespace
}  // namespace pelage
