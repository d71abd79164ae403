#include "react/stability.h"

#include <cmath>
#include <numbers>

#include "catalog/models.h"
#include "react/support.h"

namespace pelage {
namespace {

using std::numbers::pi;

Stability analyse_model(const std::string& name, const Overrides& overrides = {}) {
  return analyse(compile(load_model(name), overrides));
}

TEST(Stability, TuringIsMarginalAtRatioFour) {
  for (const double s : {0.025, 0.0375, 0.05, 0.003125}) {
    const Stability stability = analyse_model("turing", {{"s", s}});
    ASSERT_EQ(stability.steady_states.size(), 1u);
    EXPECT_NEAR(stability.steady_states[0][0], 4, 1e-12);
    EXPECT_NEAR(stability.steady_states[0][1], 4, 1e-12);
    const double expected[] = {-4 * s, -4 * s, 4 * s, 3 * s};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(stability.jacobian[k], expected[k], 1e-13);
    ASSERT_TRUE(stability.wavelength);
    EXPECT_NEAR(*stability.wavelength, 2 * pi * std::sqrt(0.03125 / s), 1e-5);
    EXPECT_NEAR(stability.growth, 0, 1e-12);
    EXPECT_FALSE(stability.oscillatory);
    EXPECT_FALSE(stability.band_min);
  }
}

TEST(Stability, TuringDispersionHasTheDeterminantOfTheTheory) {
  const double Db = 0.03125, s = 0.05;
  const Stability stability = analyse_model("turing");
  for (const double k : {0.1, 0.5, 1.0, 1.4, 3.0}) {
    // sigma^2 - trace sigma + det = 0 with det = 4 (Db k^2 - s)^2
    const std::complex<double> sigma = growth_rate(stability, k);
    const double trace = -s - 5 * Db * k * k, det = 4 * std::pow(Db * k * k - s, 2);
    EXPECT_NEAR(std::abs(sigma * sigma - trace * sigma + det), 0, 1e-15 + 1e-12 * det);
  }
}

TEST(Stability, TuringBandAboveRatioFour) {
  const double s = 0.05, Db = 0.03125, Da = 4.5 * Db;
  const Stability stability = analyse_model("turing:production");
  // det = Da Db q^2 + (4 Db - 3 Da) s q + 4 s^2 is negative between its roots.
  const double b = (4 * Db - 3 * Da) * s, root = std::sqrt(b * b - 16 * Da * Db * s * s);
  ASSERT_TRUE(stability.band_min && stability.band_max);
  EXPECT_NEAR(std::pow(*stability.band_min, 2), (-b - root) / (2 * Da * Db), 1e-9);
  EXPECT_NEAR(std::pow(*stability.band_max, 2), (-b + root) / (2 * Da * Db), 1e-9);
  EXPECT_GT(stability.growth, 0);
}

TEST(Stability, NoPatternWhenDiffusionsAreExchanged) {
  const Model model = compile(load_model("turing"), {{"Da", 0.03125}, {"Db", 0.125}});
  EXPECT_FALSE(analyse(model).wavelength);
}

/// Fastest wave number squared of two species, where d sigma / d q = 0: with c the mixed and a the diagonal entries,
/// (D2 - D1) q + a11 - a22 = +- (D1 + D2) sqrt(-a12 a21 / (D1 D2)), the sign being that of D2 - D1.
double fastest_q(const std::vector<double>& J, double D1, double D2) {
  const double side = (D2 > D1 ? 1 : -1) * (D1 + D2) * std::sqrt(-J[1] * J[2] / (D1 * D2));
  return (side - (J[0] - J[3])) / (D2 - D1);
}

TEST(Stability, SchnakenbergAgreesWithClosedForms) {
  for (const double d : {10.0, 20.0, 40.0}) {
    const double a = 0.1, b = 0.9, u = a + b, v = b / (u * u);
    const Stability stability = analyse_model("schnakenberg", {{"d", d}});
    ASSERT_EQ(stability.steady_states.size(), 1u);
    EXPECT_NEAR(stability.steady_states[0][0], v, 1e-12);
    EXPECT_NEAR(stability.steady_states[0][1], u, 1e-12);
    const std::vector<double> J = {-u * u, -2 * u * v, u * u, -1 + 2 * u * v};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(stability.jacobian[k], J[k], 1e-12);
    ASSERT_TRUE(stability.wavelength);
    const double q = fastest_q(J, d, 1);
    EXPECT_NEAR(*stability.wavelength, 2 * pi / std::sqrt(q), 1e-5);
    const double trace = J[0] + J[3] - (1 + d) * q, det = (J[0] - d * q) * (J[3] - q) - J[1] * J[2];
    EXPECT_NEAR(stability.growth, (trace + std::sqrt(trace * trace - 4 * det)) / 2, 1e-12);
  }
  // d_c where d J11 + J22 = 2 sqrt(d det J): growth 0 at k_c^2 = sqrt(det J / d).
  const double critical = std::pow((1 + std::sqrt(1.8)) / 0.8, 2);
  const Stability onset = analyse_model("schnakenberg", {{"d", critical}});
  EXPECT_NEAR(onset.growth, 0, 1e-9);
  EXPECT_NEAR(*onset.wavelength, 2 * pi / std::pow(1 / critical, 0.25), 1e-4);
}

TEST(Stability, BrusselatorThreshold) {
  // Turing threshold Dv / Du = A^2 / (sqrt(B) - 1)^2.
  const double threshold = 4 / std::pow(std::sqrt(3.0) - 1, 2);
  EXPECT_GT(analyse_model("brusselator", {{"Dv", 1.01 * threshold}}).growth, 0);
  EXPECT_LT(analyse_model("brusselator", {{"Dv", 0.99 * threshold}}).growth, 0);
  // Hopf threshold B = 1 + A^2.
  const Stability oscillating = analyse_model("brusselator", {{"B", 5.5}, {"Dv", 1}});
  EXPECT_GT(oscillating.growth, 0);
  EXPECT_TRUE(oscillating.oscillatory);
  EXPECT_FALSE(oscillating.wavelength);
}

TEST(Stability, GrayScottFindsItsThreeStates) {
  // F = 0.03, k = 0.05: u = (1 +- sqrt(1 - 4 (F + k)^2 / F)) / 2 beside (1, 0).
  const Stability stability = analyse_model("gray-scott", {{"F", 0.03}, {"k", 0.05}});
  EXPECT_EQ(stability.steady_states.size(), 3u);
  EXPECT_NEAR(stability.steady_states[stability.chosen][0], 1, 1e-9);
  EXPECT_NEAR(stability.steady_states[stability.chosen][1], 0, 1e-9);
  EXPECT_FALSE(stability.wavelength);  // that of the file is measured
  const double u = (1 - std::sqrt(1 - 4 * 0.08 * 0.08 / 0.03)) / 2;
  int found = 0;
  for (const auto& state : stability.steady_states) found += std::fabs(state[0] - u) < 1e-9;
  EXPECT_EQ(found, 1);
}

/// About n = c = 1/2 waves of chemotaxis have the matrix [[-1 - k^2, 1], [chi n (1 - n) k^2, -D k^2]]: they grow where
/// D (1 + k^2) < chi / 4 (Painter, Hillen 2002).
TEST(Stability, CellsThatClimbGrowBelowAWaveNumber) {
  const double D = 0.25, chi = 4;
  const Stability stability = analyse_at(compile(load_model("keller-segel")), {0.5, 0.5});
  for (const double k : {0.2, 0.9, 1.6, 1.8, 3.0}) {
    const double k2 = k * k, trace = -1 - k2 - D * k2, det = (1 + k2) * D * k2 - chi / 4 * k2;
    const double larger = (trace + std::sqrt(trace * trace - 4 * det)) / 2;
    EXPECT_NEAR(growth_rate(stability, k).real(), larger, 1e-12);
    EXPECT_EQ(growth_rate(stability, k).real() > 0, D * (1 + k2) < chi / 4);
  }
}

TEST(Stability, SpeciesWithoutDiffusion) {
  const auto model = [](const char* text) { return compile(parse_model(text, "m.toml")); };
  // A relaxing third species that does not diffuse changes neither threshold nor wavelength.
  const Stability three = analyse(model(R"(
name = "m"
species.u = { diffusion = 1, rate = "0.1 - u + u^2*v + 0*w", initial = 1 }
species.v = { diffusion = 40, rate = "0.9 - u^2*v", initial = 0.9 }
species.w = { diffusion = 0, rate = "u - 2*w", initial = 0.5 }
)"));
  EXPECT_NEAR(*three.wavelength, *analyse_model("schnakenberg").wavelength, 1e-6);
  EXPECT_FALSE(analyse(model("name='m'\nspecies.u={diffusion=0, rate='1 - u'}")).wavelength);
}

TEST(Stability, ConservedQuantitiesGiveALineOfStates) {
  const Stability stability = analyse(compile(parse_model(
      "name='m'\nspecies.u={diffusion=1, rate='v - u', initial=3}\nspecies.v={diffusion=1, rate='u - v', initial=1}",
      "m.toml")));
  EXPECT_GT(stability.steady_states.size(), 1u);
  EXPECT_NEAR(stability.steady_states[stability.chosen][0], 2, 1e-9);
}

TEST(Stability, NoSteadyState) {
  const Model model = compile(parse_model("name='m'\nspecies.u={diffusion=1, rate='1 + u^2'}", "m.toml"));
  EXPECT_TRUE(analyse(model).steady_states.empty());
}

/// sigma = r - (1 - k^2)^2 of the Swift-Hohenberg equation.
TEST(Stability, SwiftHohenbergGrowsAtWaveNumberOne) {
  const Stability s = analyse_model("swift-hohenberg", {{"r", 0.25}});
  ASSERT_EQ(s.eigenvalues.size(), 1u);
  EXPECT_NEAR(*s.wavelength, 2 * pi, 1e-5);
  EXPECT_NEAR(s.growth, 0.25, 1e-12);
  EXPECT_NEAR(*s.band_min, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(*s.band_max, std::sqrt(1.5), 1e-9);
  for (const double k : {0.0, 0.3, 1.0, 2.5})
    EXPECT_NEAR(growth_rate(s, k).real(), 0.25 - std::pow(1 - k * k, 2), 1e-11 * (1 + std::pow(k, 4)));
  // u = 0, and u^2 = r - 1 where that is positive.
  EXPECT_EQ(s.steady_states.size(), 1u);
  EXPECT_EQ(analyse_model("swift-hohenberg", {{"r", 1.25}}).steady_states.size(), 3u);
}

/// sigma = -k^2 (3 m^2 - 1 + epsilon^2 k^2), at every mean m of the conserved c.
TEST(Stability, CahnHilliardStartsFromItsMean) {
  const double m = 0.2, epsilon = 0.5, drive = 1 - 3 * m * m;
  const Stability s = analyse_model("cahn-hilliard", {{"mean", m}, {"epsilon", epsilon}});
  EXPECT_NEAR(s.steady_states[s.chosen][1], m, 1e-9);
  EXPECT_NEAR(s.steady_states[s.chosen][0], m * m * m - 3 * m, 1e-9);
  EXPECT_NEAR(*s.wavelength, 2 * pi * epsilon * std::sqrt(2 / drive), 1e-5);
  EXPECT_NEAR(s.growth, drive * drive / (4 * epsilon * epsilon), 1e-9);
  EXPECT_NEAR(*s.band_max, std::sqrt(drive) / epsilon, 1e-8);
  EXPECT_EQ(growth_rate(s, 0).real(), 0);
}

TEST(Stability, OhtaKawasakiHasAThreshold) {
  EXPECT_GT(analyse_model("ohta-kawasaki", {{"sigma", 0.249}}).growth, 0);
  EXPECT_NEAR(analyse_model("ohta-kawasaki", {{"sigma", 0.25}}).growth, 0, 1e-9);
}

/// sigma = 1 - (1 +- i c1) k^2 around A = 0.
TEST(Stability, GinzburgLandauWavesTurn) {
  const Stability s = analyse_model("complex-ginzburg-landau", {{"c1", 2}});
  for (const double k : {0.0, 0.5, 3.0}) {
    EXPECT_NEAR(growth_rate(s, k).real(), 1 - k * k, 1e-12);
    EXPECT_NEAR(growth_rate(s, k).imag(), 2 * k * k, 1e-12);
  }
  EXPECT_FALSE(s.wavelength);
}

/// A fast inhibitor w - L^2 lap(w) = u: its answer to a wave is u / (1 + L^2 k^2).
TEST(Stability, AlgebraicSpeciesMayDiffuse) {
  const Stability s = analyse(compile(parse_model(
      "name='m'\nspecies.u={diffusion=0.1, rate='2*u - 3*w'}\nspecies.w={equals='u + 4*lap(w)'}", "m.toml")));
  for (const double k : {0.0, 0.7, 5.0})
    EXPECT_NEAR(growth_rate(s, k).real(), 2 - 0.1 * k * k - 3 / (1 + 4 * k * k), 1e-12);
}

}  // namespace
}  // namespace pelage
