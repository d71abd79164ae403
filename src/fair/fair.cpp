#include "pelage/fair.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/suggest.h"
#include "fair/boundary.h"
#include "fair/detail.h"
#include "fair/faces.h"
#include "fair/flow.h"
#include "fair/impulses.h"
#include "fair/noise.h"
#include "fair/volume.h"
#include "fair/whiteness.h"
#include "pelage/error.h"
#include "shape/normals.h"

namespace pelage {

namespace {

/// The noise is taken off when the vertices have moved by this share of its standard deviation: what has moved is a
/// little less than the noise (its longest waves look like shape), and the estimate more (details look like noise).
constexpr double noise_share = 0.95;
/// Where nothing tells that shape goes along with it, up to this share: the estimate may be too small.
constexpr double largest_share = 1.05;

/// Shape goes along with the noise when the correlation of the ways grows so many times as fast as of noise alone: the
/// first is enough when the noise should be off, the second at any time. In the first step there is no correlation
/// before it to compare with, so that it takes more. Details of bunnies, heads, horses and parts first make more error
/// than the noise did at 1.4 to 1.8.
constexpr double suspect_growth = 1.35, certain_growth = 1.6, certain_first_growth = 2;
/// After so many steps it is asked whether some vertices only have noise.
constexpr int impulse_steps = 3;
/// On top of that, growth in one step that is too little to matter in any number of steps that are taken.
constexpr double negligible_growth = 8e-4;

void require_between(const std::optional<double>& value, double low, double high, const std::string& name) {
  if (value && !(*value >= low && *value <= high))
    throw Error(Fault::usage, name + " " + number(*value) + " is out of range; it lies between " + number(low) +
                                  " and " + number(high));
}

void check(const FairOptions& options) {
  require_between(options.noise, 0, 10, "noise");
  if (options.steps) require_between(*options.steps, 0, 1000, "steps");
  require_between(options.tau, 1e-6, 100, "tau");
  require_between(options.sigma, 0, 100, "sigma");
  require_between(options.angle, 0.01, 180, "angle");
  require_between(options.mu, 0, 1, "mu");
}

std::unique_ptr<FairMethod> make_method(const FairState& state, const FairOptions& options, FairReport& report) {
  if (options.method == "guided") return make_guided_method(state);
  if (options.method == "paper") return make_paper_method(state, options, report);
  if (options.method == "isotropic") return make_isotropic_method(options, report);
  if (options.method == "taubin") return make_taubin_method();
  throw Error(Fault::usage, unknown_name("method", options.method, fair_methods()));
}

/// Root mean square of the way of the vertices along their present normals.
double moved_along_normals(const FairState& state, const std::vector<Point>& from) {
  double sum = 0;
  for (const double square : squared_ways(state.topology.triangles, state.fixed, from, state.points)) sum += square;
  const auto count = std::ranges::count(state.fixed, char{0});
  return count ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

std::vector<double> flattened(const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& p : points) values.insert(values.end(), p.begin(), p.end());
  return values;
}

}  // namespace

const std::vector<std::string>& fair_methods() {
  static const std::vector<std::string> names = {"guided", "paper", "isotropic", "taubin"};
  return names;
}

/// Everything that the steps need, in one place: the state refers to the connectivity.
struct Fairing::Parts {
  Parts(const TriangleMesh& mesh, bool slide)
      : topology(make_topology(mesh.points.size(), mesh.triangles)),
        from(mesh.points),
        state{topology, mesh.points, boundary_vertices(topology)},
        closed(topology) {
    if (!slide) return;
    rails.emplace(topology, mesh.points);
    state.fixed = rails->corner();
  }

  Topology topology;
  std::vector<Point> from;
  FairState state;
  ClosedParts closed;
  std::optional<BoundaryRails> rails;
  std::unique_ptr<FairMethod> method;
};

Fairing::Fairing(const TriangleMesh& mesh, const FairOptions& options) : options_(options) {
  check(options);
  parts_ = std::make_unique<Parts>(mesh, options.slide);
  report_.mean_edge = mean_edge(parts_->topology, mesh.points);
  if (!(report_.mean_edge > 0)) return;
  roughness_ = estimate_noise(parts_->topology, mesh.points) / report_.mean_edge;
  report_.noise = options.noise.value_or(roughness_);
  parts_->method = make_method(parts_->state, options, report_);
  most_steps_ = options.steps.value_or(report_.noise > 0 ? parts_->method->most_steps() : 0);
  report_.volume_before = parts_->closed.volume(mesh.points);
  correlation_ = correlation_of_noise(0);
}

Fairing::~Fairing() = default;
Fairing::Fairing(Fairing&&) noexcept = default;
Fairing& Fairing::operator=(Fairing&&) noexcept = default;

bool Fairing::done() const { return finished_ || report_.steps >= most_steps_; }

void Fairing::step() {
  std::vector<Point>& points = parts_->state.points;
  const std::vector<Point> before = points;
  const double moved_before = report_.moved, correlation_before = correlation_;
  parts_->method->step(parts_->state, report_);
  if (parts_->rails) parts_->rails->put_back(points);
  ++report_.steps;
  measure();
  const double wanted = noise_share * report_.noise;
  finished_ = !options_.steps && noise_is_off(correlation_before);
  if (settle_where_some_are_noisy()) return;
  if (!finished_ || moved_before >= wanted || report_.moved < wanted) return;
  // The last step ends where the noise is off: a whole one takes too much of a coarse mesh.
  const double part = (wanted - moved_before) / (report_.moved - moved_before);
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) points[v][k] = before[v][k] + part * (points[v][k] - before[v][k]);
  measure_way();
}

/// By then the ways tell noise on some vertices from noise on all.
bool Fairing::settle_where_some_are_noisy() {
  if (options_.method != "guided" || options_.noise || options_.steps) return false;
  if (report_.steps != impulse_steps && !(finished_ && report_.steps < impulse_steps)) return false;
  report_.kept = settle_impulses(parts_->state, parts_->from, *parts_->method, report_);
  if (report_.kept == 0) return false;
  finished_ = true;
  measure_way();
  return true;
}

bool Fairing::noise_is_off(double correlation_before) const {
  const bool enough = report_.moved >= noise_share * report_.noise;
  if (options_.noise || options_.method != "guided") return enough;
  const double growth = correlation_ - correlation_before, of_noise = growth_of_noise(report_.steps);
  const double certain = report_.steps == 1 ? certain_first_growth : certain_growth;
  return growth > certain * of_noise + negligible_growth || (enough && growth > suspect_growth * of_noise) ||
         report_.moved > largest_share * report_.noise;
}

void Fairing::measure() {
  measure_way();
  if (options_.noise || options_.steps) return;
  if (options_.method == "guided")
    correlation_ = correlation_of_ways(parts_->topology, parts_->state.fixed, parts_->from, parts_->state.points);
  // What still looks like noise when the noise is off is the shape, and the estimate at the start held it as well.
  const double left = estimate_noise(parts_->topology, parts_->state.points) / report_.mean_edge;
  report_.noise = std::sqrt(std::max(0.0, roughness_ * roughness_ - left * left));
}

void Fairing::measure_way() { report_.moved = moved_along_normals(parts_->state, parts_->from) / report_.mean_edge; }

std::vector<Point> Fairing::points() const {
  std::vector<Point> points = parts_->state.points;
  if (report_.kept > 0) return points;  // those that stay hold the volume
  if (done() && !options_.steps && options_.method == "guided")
    give_back_detail(parts_->topology, parts_->state.fixed, parts_->from, points);
  if (report_.steps > 0) parts_->closed.restore_volumes(parts_->from, points);
  return points;
}

Fairing::State Fairing::state() const { return {parts_->state.points, report_.steps, done(), report_.kept}; }

void Fairing::restore(State state) {
  if (state.points.size() != parts_->from.size())
    throw Error(Fault::usage, "the state has " + std::to_string(state.points.size()) + " points, the mesh " +
                                  std::to_string(parts_->from.size()) + " vertices");
  parts_->state.points = std::move(state.points);
  report_.steps = state.steps;
  finished_ = state.done;
  report_.kept = state.kept;
  if (state.steps > 0) measure();
}

Faired fair(const TriangleMesh& mesh, const FairOptions& options, const Progress& progress) {
  Fairing fairing(mesh, options);
  while (!fairing.done()) {
    if (progress && !progress("fairing", static_cast<double>(fairing.report().steps) / fairing.most_steps()))
      throw Error(Fault::cancelled, "cancelled");
    fairing.step();
  }
  Faired result{mesh, fairing.report()};
  result.mesh.points = fairing.points();
  result.report.volume_after =
      ClosedParts(make_topology(mesh.points.size(), mesh.triangles)).volume(result.mesh.points);
  if (result.mesh.find("normal"))
    result.mesh.set({"normal", 3, Domain::vertex, flattened(vertex_normals(mesh.triangles, result.mesh.points))});
  return result;
}

}  // namespace pelage
