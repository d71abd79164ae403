// A space of another kind, written here alone: a flat periodic grid with the five-point Laplacian. Runs and steppers
// take it as it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "catalog/models.h"
#include "react/wavelength.h"
#include "run/run.h"

namespace pelage {
namespace {

using Growth = Run;  // in a test, Run is a function of its own

/// n x n nodes over [0, 1)^2; every node is a sample, a quadrature point and an unknown.
class FlatGrid final : public Space {
 public:
  explicit FlatGrid(Index n) : n_(n), area_(1.0 / (n * n)) {
    auto pattern = std::make_shared<SparsePattern>();
    pattern->rows = pattern->columns = unknowns();
    SparseMatrix five, one{pattern, {}};
    for (Index v = 0; v < unknowns(); ++v) {
      std::array<std::pair<Index, double>, 5> row = {
          {{v, 4}, {at(v, 1, 0), -1}, {at(v, -1, 0), -1}, {at(v, 0, 1), -1}, {at(v, 0, -1), -1}}};
      std::ranges::sort(row);
      for (const auto& [column, value] : row) {
        pattern->column.push_back(column);
        five.value.push_back(value);
        one.value.push_back(column == v ? 1.0 : 0.0);
      }
      pattern->start.push_back(static_cast<std::int64_t>(pattern->column.size()));
      position_.push_back({static_cast<double>(v % n) / n, static_cast<double>(v / n) / n, 0});
    }
    five.pattern = pattern;
    stiffness_ = std::make_shared<const SparseMatrix>(std::move(five));
    identity_ = one;
    Sampling sampling{one, one, Vector::Constant(unknowns(), area_), position_};
    for (double& value : one.value) value *= area_;
    sampled_ = {std::make_shared<const Sampling>(std::move(sampling)), std::make_shared<const SparseMatrix>(one)};
  }

  Index unknowns() const override { return n_ * n_; }
  SampledMass sampled(SampleRule) const override { return sampled_; }
  const SparseMatrix& node_values() const override { return identity_; }
  SparseMatrix quadrature_values() const override { return identity_; }
  SharedMatrix stiffness() const override { return stiffness_; }
  SparseMatrix weighted_mass(const std::vector<double>& c) const override {
    SparseMatrix mass = *sampled_.mass;
    for (Index v = 0; v < unknowns(); ++v)
      for (auto k = mass.pattern->start[v]; k < mass.pattern->start[v + 1]; ++k)
        mass.value[static_cast<std::size_t>(k)] *= c[static_cast<std::size_t>(v)];
    return mass;
  }
  /// Between two nodes the mean of their coefficients.
  SparseMatrix stiffness(const std::vector<double>& c) const override {
    SparseMatrix k = *stiffness_;
    for (Index v = 0; v < unknowns(); ++v) {
      double sum = 0;
      for (auto e = k.pattern->start[v]; e < k.pattern->start[v + 1]; ++e) {
        const Index w = k.pattern->column[static_cast<std::size_t>(e)];
        if (w == v) continue;
        k.value[static_cast<std::size_t>(e)] = -(c[static_cast<std::size_t>(v)] + c[static_cast<std::size_t>(w)]) / 2;
        sum -= k.value[static_cast<std::size_t>(e)];
      }
      k.value[static_cast<std::size_t>(k.pattern->find(v, v))] = sum;
    }
    return k;
  }
  SparseMatrix stiffness(const std::vector<Tensor>&) const override { return *stiffness_; }  // no test asks for it
  /// By the means of central differences in three rows, and columns, with weights 1/4, 1/2, 1/4.
  Vector gradient_product(SampleRule, const Vector& u, const Vector& v) const override {
    const auto slope = [&](const Vector& f, Index k, Index dx, Index dy) {
      const auto difference = [&](Index other) { return f[at(other, dx, dy)] - f[at(other, -dx, -dy)]; };
      return (2 * difference(k) + difference(at(k, dy, dx)) + difference(at(k, -dy, -dx))) / 4;
    };
    Vector product(unknowns());
    for (Index k = 0; k < unknowns(); ++k)
      product[k] = slope(u, k, 1, 0) * slope(v, k, 1, 0) + slope(u, k, 0, 1) * slope(v, k, 0, 1);
    return product / (4 * area_);
  }
  ElementPoint element_point(Index face, double, double) const override {  // as if there were one node to a face
    return {{face}, RowMatrix::Identity(3, 1)};
  }
  PlaceGeometry geometry(SampleRule, bool) const override {
    return {position_, std::vector<Point>(position_.size(), Point{0, 0, 1}), {}};
  }
  std::vector<double> at_quadrature_points(const std::vector<double>& at_nodes) const override { return at_nodes; }
  std::vector<Tensor> tensors(const std::vector<Tensor>& lines, const Kinetics::TensorField&) const override {
    return lines;
  }
  std::vector<char> interior(std::vector<char> nodes) const override { return nodes; }
  const std::vector<Point>& control() const override { return position_; }
  std::shared_ptr<const Space> moved(std::vector<Point>) const override { return std::make_shared<FlatGrid>(n_); }

 private:
  Index at(Index v, Index dx, Index dy) const { return (v % n_ + dx + n_) % n_ + n_ * ((v / n_ + dy + n_) % n_); }
  Index n_;
  double area_;
  std::vector<Point> position_;
  SharedMatrix stiffness_;
  SparseMatrix identity_;
  SampledMass sampled_;
};

Growth grow_on_grid(const std::string& model, Index n, const StepperKind& stepper, double size,
                    const ModelChanges& changes = {}) {
  Program program;
  StageProgram& stage = program.stages.emplace_back();
  stage.name = "only";
  const ModelSource source = load_model(model);
  stage.model = compile(source, {}, changes);
  stage.stepper = &stepper;
  stage.size = size;
  stage.length_unit = size / model_wavelength(compile(source));
  stage.suggested_step = source.suggestions.step.value();
  stage.until = source.suggestions.end.value();
  stage.stationary = source.suggestions.tolerance.value();
  return Growth(std::make_shared<const Program>(std::move(program)), World(std::make_shared<FlatGrid>(n)));
}

/// Spots on a torus: as far apart as asked for.
TEST(FlatGrid, APatternGrowsOnItAtItsSize) {
  for (const StepperKind* stepper : {&sbdf2, &semi_implicit, &explicit_euler}) {
    Growth run = grow_on_grid("turing", 48, *stepper, 0.2);
    run.advance(stepper == &sbdf2 ? 1'000'000 : 400);
    ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
    if (stepper != &sbdf2) continue;  // these take their time
    EXPECT_FALSE(run.uniform());
    EXPECT_NEAR(measured_wavelength(*run.system().mass, *run.space().stiffness(), run.coefficients()[0]) / 0.2, 1,
                0.15);
  }
}

/// exp(-D k^2 t) of a wave, with the k^2 of five points; and checkpoints hold.
TEST(FlatGrid, WavesDecayAndCheckpointsGoOn) {
  const auto path = testing::TempDir() + "pelage_flat_grid_wave.toml";
  ModelSource source = parse_model(
      "name = \"wave\"\nwavelength = 1\n[species.u]\ndiffusion = 0.01\nrate = \"0\"\ninitial = \"cos(2*pi*x)\"\n"
      "[suggested]\nstep = 0.02\n",
      path);
  Program program;
  StageProgram& stage = program.stages.emplace_back();
  stage.model = compile(source);
  stage.length_unit = stage.size = 1;
  stage.step = stage.suggested_step = 0.02;
  stage.until = 1;
  const auto shared = std::make_shared<const Program>(std::move(program));
  const Index n = 32;
  const auto start = [&] { return Growth(shared, World(std::make_shared<FlatGrid>(n))); };
  Growth run = start(), resumed = start();
  run.advance(20);
  resumed.restore(run.checkpoint());
  run.advance(1000);
  resumed.advance(1000);
  EXPECT_TRUE(run.checkpoint() == resumed.checkpoint());
  const double k2 = std::pow(2 * n * std::sin(std::numbers::pi / n), 2);
  EXPECT_NEAR(run.coefficients()[0].maxCoeff(), std::exp(-0.01 * k2), 1e-4);
}

/// Masks, maps and pins work on it without change.
TEST(FlatGrid, StagesHoldPinAndMap) {
  ModelChanges changes;
  changes.mask = Formula{"x < 0.5", {}};
  changes.pin = {{"b", {"3 + y", {}}}};
  changes.size = Formula{"1 + 0.5*y", {}};
  Growth run = grow_on_grid("turing", 32, sbdf2, 0.25, changes);
  run.advance(50);
  ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
  for (Index v = 0; v < run.space().unknowns(); ++v) {
    const Point& p = run.space().control()[static_cast<std::size_t>(v)];
    if (p[0] < 0.5) {
      EXPECT_NEAR(run.coefficients()[1][v], 3 + p[1], 1e-12);
    }
  }
}

/// Kuramoto-Sivashinsky on a flat torus of `waves` of its fastest waves along each side.
Growth kuramoto_sivashinsky(Index n, double waves, const ModelSource& source) {
  Program program;
  StageProgram& stage = program.stages.emplace_back();
  stage.model = compile(source);
  stage.stepper = &sbdf2;
  stage.length_unit = 1 / (waves * 2 * std::numbers::pi * std::numbers::sqrt2);
  stage.size = stage.length_unit * model_wavelength(stage.model);
  stage.suggested_step = 0.1;
  stage.until = 1e9;
  return Growth(std::make_shared<const Program>(std::move(program)), World(std::make_shared<FlatGrid>(n)));
}

/// The wave number that five points see in m waves along a side of 1, squared.
double seen_k2(Index n, Index m) { return std::pow(2 * n * std::sin(std::numbers::pi * m / n), 2); }

/// sigma = k^2 - k^4.
TEST(FlatGrid, OneWaveOfKuramotoSivashinskyGrowsAsItsDispersionRelationSays) {
  ModelSource source = load_model("kuramoto-sivashinsky");
  const Index n = 48, m = 4;
  source.species[1].initial = Formula{"1e-6*cos(8*pi*x)", {}};
  Growth run = kuramoto_sivashinsky(n, 4, source);
  run.advance(20);
  const double before = run.coefficients()[1].maxCoeff(), begun = run.summary().time;
  run.advance(80);
  const double k2 = seen_k2(n, m) * std::pow(run.stage_program().length_unit, 2);
  const double rate = std::log(run.coefficients()[1].maxCoeff() / before) / (run.summary().time - begun);
  EXPECT_NEAR(rate / (k2 - k2 * k2), 1, 0.05);
  EXPECT_NEAR(k2, 0.5, 0.02);
}

/// Mean energy k^2 |u_k|^2 of the waves of a field whose wave numbers round to m times 2 pi / side.
std::vector<double> energy_by_waves(Index n, const Vector& u) {
  Eigen::MatrixXcd wave(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) wave(i, j) = std::polar(1.0, -2 * std::numbers::pi * (i * j % n) / n);
  const Eigen::MatrixXcd field = Eigen::Map<const Eigen::MatrixXd>(u.data(), n, n).cast<std::complex<double>>();
  const Eigen::MatrixXcd transform = wave * field * wave;
  std::vector<double> energy(static_cast<std::size_t>(n)), count = energy;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double k2 = seen_k2(n, i) + seen_k2(n, j);
      const auto m = static_cast<std::size_t>(std::lround(std::sqrt(k2) / (2 * std::numbers::pi)));
      energy[m] += k2 * std::norm(transform(i, j));
      ++count[m];
    }
  for (std::size_t m = 0; m < energy.size(); ++m) energy[m] /= std::max(count[m], 1.0);
  return energy;
}

/// The energy of the chaos has its peak near the fastest wave, k = 1/sqrt(2).
TEST(FlatGrid, KuramotoSivashinskyIsChaoticNearItsFastestWave) {
  const Index n = 56;
  const double waves = 5;
  Growth run = kuramoto_sivashinsky(n, waves, load_model("kuramoto-sivashinsky"));
  constexpr int moments = 60;
  std::vector<double> energy(static_cast<std::size_t>(n));
  double variance = 0;
  for (int k = 0; k < moments; ++k) {
    run.advance(k == 0 ? 400 : 10);
    ASSERT_NE(run.summary().status, RunStatus::failed) << run.summary().message;
    const Vector& u = run.coefficients()[1];
    std::ranges::transform(energy, energy_by_waves(n, u), energy.begin(), std::plus<>());
    variance += (u.array() - u.mean()).square().mean() / moments;
  }
  const auto peak = std::ranges::max_element(energy);
  const double below = peak[-1], at = peak[0], above = peak[1];
  const double k = static_cast<double>(peak - energy.begin()) + (below - above) / (2 * (below - 2 * at + above));
  RecordProperty("peak", std::to_string(k / waves));
  EXPECT_NEAR(k / waves, 1, 0.1);
  EXPECT_NEAR(std::sqrt(variance), 4.2, 0.8);
}

}  // namespace
}  // namespace pelage
