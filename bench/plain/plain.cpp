// Grows one of three models with plain linear elements: what Pelage is measured against. Start and stop are Pelage's.
//   plain builtin:sphere?n=10242 --model schnakenberg --unit 0.03 --method rkc2 --step 0.1 -o grown.ply

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "catalog/models.h"
#include "pelage/io.h"
#include "react/kinetics.h"
#include "steppers.h"

namespace plain {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string mesh, model = "schnakenberg", method = "rkc2", real = "float", output;
  double unit = 1;
  std::uint64_t seed = 1;
  std::optional<double> step, until, stationary;
  std::optional<long> steps;
  int threads = 0;
};

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count(); }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

void use_threads([[maybe_unused]] int threads) {
#ifdef _OPENMP
  if (threads > 0) omp_set_num_threads(threads);
#endif
}

/// Bytes per second of a = b + 3 c over arrays far larger than the caches, the best of some.
double triad() {
  constexpr int n = 1 << 24;
  std::vector<float> a(n), b(n, 1), c(n, 2);
  double best = 0;
  for (int round = 0; round < 6; ++round) {
    const Clock clock;
#pragma omp parallel for
    for (int i = 0; i < n; ++i) a[i] = b[i] + 3 * c[i];
    best = std::max(best, 3.0 * n * sizeof(float) / clock.seconds());
  }
  return best;
}

/// What Pelage's own model says of the start, the bounds, and the place: of Turing's beta the rate at a = b = 0 tells.
struct Start {
  std::vector<Pair<double>> values;
  std::vector<double> place;
  Pair<double> lower;
};

Start start(const pelage::Model& model, const std::vector<pelage::Point>& points, double unit, std::uint64_t seed) {
  const pelage::Places places{.positions = points, .length_unit = unit};
  const pelage::Kinetics kinetics(model, places, seed);
  const std::size_t n = points.size();
  std::vector<double> u[2], rates[2];
  for (std::size_t s = 0; s < 2; ++s) {
    rates[s].resize(n);
    u[s] = pelage::initial_values(model, s, places, seed);
  }
  const std::vector<double> none(n, 0);
  const double* nothing[] = {none.data(), none.data()};
  double* out[] = {rates[0].data(), rates[1].data()};
  kinetics.rates(nothing, 0, 0, n, out);
  Start result{std::vector<Pair<double>>(n), std::move(rates[1]), {model.lower(0), model.lower(1)}};
  for (double& beta : result.place) beta /= -0.05;
  for (std::size_t i = 0; i < n; ++i) result.values[i] = {u[0][i], u[1][i]};
  return result;
}

/// StepReport::change (time/stepper.h): the root mean square of du/dt over that of the deviation from the mean, the
/// larger of both species.
template <class R>
double change(const Field<R>& before, const Field<R>& u, double dt) {
  const int n = static_cast<int>(u.size());
  double mean0 = 0, mean1 = 0, moved0 = 0, moved1 = 0, off0 = 0, off1 = 0;
#pragma omp parallel for reduction(+ : mean0, mean1, moved0, moved1)
  for (int i = 0; i < n; ++i) {
    const Pair<double> now = u[i].template cast<double>(), moved = now - before[i].template cast<double>();
    mean0 += now[0] / n;
    mean1 += now[1] / n;
    moved0 += moved[0] * moved[0];
    moved1 += moved[1] * moved[1];
  }
#pragma omp parallel for reduction(+ : off0, off1)
  for (int i = 0; i < n; ++i) {
    const Pair<double> off = u[i].template cast<double>() - Pair<double>(mean0, mean1);
    off0 += off[0] * off[0];
    off1 += off[1] * off[1];
  }
  const auto ratio = [](double moved, double off) { return moved == 0 ? 0 : moved / off; };
  return std::sqrt(std::max(ratio(moved0, off0), ratio(moved1, off1))) / dt;
}

struct Outcome {
  long steps = 0, evaluations = 0;
  double time = 0, step = 0, change = 0, seconds = 0;
  double bytes = 0;  ///< that evaluations have to move at least, per vertex and evaluation
};

/// Steps of equal length to the end, or until the pattern is at rest. Steps that are much shorter than the model's are
/// not all looked at.
template <class Stepper, class P, class R>
Outcome grow(const P& problem, Field<R>& u, double step, double until, double stationary, double look_every) {
  Outcome o;
  const long steps = std::max(1L, std::lround(std::ceil(until / step - 1e-9)));
  o.step = until / static_cast<double>(steps);
  const long every = std::max(1L, std::lround(look_every / o.step));
  Stepper stepper(problem);
  const Clock clock;
  while (o.steps < steps) {
    stepper.advance(u, o.step);
    if (++o.steps % every != 0 && o.steps != steps) continue;
    o.change = change(stepper.before(), u, o.step);
    if (!std::isfinite(o.change)) throw std::runtime_error("the fields grow beyond all bounds; take a smaller --step");
    if (o.change < stationary) break;
  }
  o.seconds = clock.seconds();
  o.time = static_cast<double>(o.steps) * o.step;
  o.evaluations = stepper.evaluations();
  const double entries = static_cast<double>(problem.column.size()) / problem.size();
  o.bytes = entries * (sizeof(R) + sizeof(int)) + sizeof(int) + Stepper::traffic * sizeof(R);
  return o;
}

template <class Model, class R>
Outcome grow(const Options& options, const Elements& elements, Start& start, const pelage::Suggestions& suggested) {
  using P = Problem<Model, R>;
  const P problem(elements, options.unit, start.place, start.lower);
  Field<R> u;
  for (const Pair<double>& value : start.values) u.push_back(value.cast<R>());
  const double usual = suggested.step.value();
  double step = options.step.value_or(usual);
  if (options.method == "euler" && !options.step) step = std::min(step, Euler<P>::longest_step(problem));
  const double until =
      options.steps ? static_cast<double>(*options.steps) * step : options.until.value_or(suggested.end.value());
  const double stationary = options.stationary.value_or(suggested.tolerance.value());
  Outcome o;
  if (options.method == "euler") o = grow<Euler<P>>(problem, u, step, until, stationary, usual);
  if (options.method == "rkc2") o = grow<Rkc2<P>>(problem, u, step, until, stationary, 0);
  if (options.method == "sbdf2") o = grow<Sbdf2<P>>(problem, u, step, until, stationary, 0);
  for (std::size_t i = 0; i < u.size(); ++i) start.values[i] = u[i].template cast<double>();
  return o;
}

template <class Model>
Outcome grow(const Options& options, const Elements& elements, Start& start, const pelage::Suggestions& suggested) {
  return options.real == "float" ? grow<Model, float>(options, elements, start, suggested)
                                 : grow<Model, double>(options, elements, start, suggested);
}

Outcome grow(const Options& o, const Elements& elements, Start& start, const pelage::Suggestions& suggested) {
  if (o.model == "schnakenberg") return grow<Schnakenberg>(o, elements, start, suggested);
  if (o.model == "turing:production") return grow<Turing>(o, elements, start, suggested);
  return grow<GrayScott>(o, elements, start, suggested);
}

/// The fields at the vertices of the mesh, in its own order.
void write(pelage::TriangleMesh mesh, const std::vector<int>& order, const Start& grown, const pelage::Model& model,
           const std::string& path) {
  mesh.attributes.clear();
  for (std::size_t s = 0; s < 2; ++s) {
    pelage::Attribute field{model.species_name(s), 1, pelage::Domain::vertex, std::vector<double>(order.size())};
    for (std::size_t i = 0; i < order.size(); ++i) field.values[order[i]] = grown.values[i][static_cast<int>(s)];
    mesh.set(std::move(field));
  }
  pelage::save(mesh, path);
}

Json run(const Options& options) {
  use_threads(options.threads);
  const Clock whole;
  const pelage::TriangleMesh shape = pelage::load_shape(options.mesh);
  const std::vector<int> order = breadth_first(shape);
  const pelage::TriangleMesh mesh = renumbered(shape, order);
  const Elements elements = assemble(mesh);
  const pelage::Model model = pelage::compile(pelage::load_model(options.model));
  Start fields = start(model, mesh.points, options.unit, options.seed);
  const Outcome o = grow(options, elements, fields, model.source().suggestions);
  if (!options.output.empty()) write(shape, order, fields, model, options.output);
  const double seconds = whole.seconds();
  const double vertices = static_cast<double>(order.size());
  return {{"vertices", order.size()},
          {"steps", o.steps},
          {"step", o.step},
          {"evaluations", o.evaluations},
          {"time", o.time},
          {"change", o.change},
          {"growth_seconds", o.seconds},
          {"seconds", seconds},
          {"bytes_per_second", o.bytes * vertices * static_cast<double>(o.evaluations) / o.seconds}};
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("mesh", o.mesh, "The mesh, as pelage grow reads it")->required();
  app.add_option("--model", o.model)->check(CLI::IsMember({"schnakenberg", "turing:production", "gray-scott:spots"}));
  app.add_option("--method", o.method)->check(CLI::IsMember({"euler", "rkc2", "sbdf2"}));
  app.add_option("--real", o.real)->check(CLI::IsMember({"float", "double"}));
  app.add_option("--unit", o.unit, "What one length unit of the model becomes");
  app.add_option("--seed", o.seed);
  app.add_option("--step", o.step, "Default: the model's suggestion; of euler the longest that is stable");
  app.add_option("--until", o.until);
  app.add_option("--steps", o.steps);
  app.add_option("--stationary", o.stationary);
  app.add_option("--threads", o.threads, "Default: all cores");
  app.add_option("-o,--output", o.output, "File for the mesh with its fields");
}

}  // namespace
}  // namespace plain

int main(int argc, char** argv) {
  CLI::App app("Grows a coat with plain linear elements, and says how as JSON.");
  plain::Options options;
  bool triad = false;
  plain::add_options(app, options);
  app.add_flag("--triad", triad, "Measure the memory bandwidth, too");
  CLI11_PARSE(app, argc, argv);
  try {
    plain::Json json = plain::run(options);
    if (triad) json["triad_bytes_per_second"] = plain::triad();
    std::cout << json.dump(2) << '\n';
  } catch (const std::exception& e) {
    std::cerr << "plain: error: " << e.what() << '\n';
    return 1;
  }
}
