#include "fair/fair.h"

#include <cmath>

#include "base/number.h"
#include "base/suggest.h"
#include "fair/faces.h"
#include "fair/flow.h"
#include "fair/noise.h"
#include "fair/volume.h"
#include "pelage/error.h"
#include "shape/normals.h"

namespace pelage {

namespace {

/// The noise is taken off when the vertices have moved by this share of its standard deviation: what has moved is a
/// little less than the noise (its longest waves look like shape), and the estimate a little more.
constexpr double noise_share = 0.95;

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
  const std::vector<Point> normal = vertex_normals(state.topology.triangles, state.points);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < from.size(); ++v) {
    if (state.fixed[v]) continue;
    const double way = vector3(normal[v]).dot(vector3(state.points[v]) - vector3(from[v]));
    sum += way * way;
    ++count;
  }
  return count ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

/// Steps until enough has moved.
void take_steps(FairState& state, FairMethod& method, const FairOptions& options, FairReport& report,
                const Progress& progress) {
  const std::vector<Point> from = state.points;
  const int most = options.steps.value_or(report.noise > 0 ? method.most_steps() : 0);
  while (report.steps < most) {
    if (progress && !progress("fairing", static_cast<double>(report.steps) / most))
      throw Error(Fault::cancelled, "cancelled");
    method.step(state, report);
    ++report.steps;
    report.moved = moved_along_normals(state, from) / report.mean_edge;
    if (!options.steps && report.moved >= noise_share * report.noise) break;
  }
}

std::vector<char> boundary_vertices(const Topology& topology) {
  std::vector<char> on_boundary(topology.vertex_count);
  for (Index v = 0; v < topology.vertex_count; ++v) on_boundary[v] = topology.on_boundary(v);
  return on_boundary;
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

Faired fair(const TriangleMesh& mesh, const FairOptions& options, const Progress& progress) {
  check(options);
  const Topology topology = make_topology(mesh.points.size(), mesh.triangles);
  FairState state{topology, mesh.points, boundary_vertices(topology)};
  Faired result{mesh, {}};
  FairReport& report = result.report;
  report.mean_edge = mean_edge(topology, mesh.points);
  if (!(report.mean_edge > 0)) return result;
  report.noise = options.noise ? *options.noise : estimate_noise(topology, mesh.points) / report.mean_edge;
  const auto method = make_method(state, options, report);
  take_steps(state, *method, options, report, progress);
  const ClosedParts parts(topology);
  report.volume_before = parts.volume(mesh.points);
  parts.restore_volumes(mesh.points, state.points);
  report.volume_after = parts.volume(state.points);
  result.mesh.points = std::move(state.points);
  if (result.mesh.find("normal"))
    result.mesh.set({"normal", 3, Domain::vertex, flattened(vertex_normals(mesh.triangles, result.mesh.points))});
  return result;
}

}  // namespace pelage
