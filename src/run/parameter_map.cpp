#include "run/parameter_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/job_progress.h"
#include "base/number.h"
#include "base/parallel.h"
#include "pelage/error.h"
#include "react/wavelength.h"
#include "shape/topology.h"

namespace pelage {

namespace {

constexpr double wavelengths_per_side = 5;
/// A cell whose pattern would be finer than this share of the longest wavelength is run at this resolution.
constexpr double finest_share = 0.4;
constexpr std::int64_t steps_per_slice = 20;
/// With deviations this small against the fields nothing is left that could grow again.
constexpr double dead_contrast = 1e-7;

/// A finer mesh would fill the memory: it has six million triangles.
constexpr double most_edges = 1600;

/// work(), unless the cell has failed; an error of it makes the cell fail and leaves the others alone.
template <class Work>
void try_cell(MapCell& cell, Work&& work) {
  if (cell.outcome == CellOutcome::failed) return;
  try {
    work();
  } catch (const Error& error) {
    if (error.fault() == Fault::cancelled || error.fault() == Fault::output) throw;
    cell.outcome = CellOutcome::failed;
    cell.summary.message = error.what();
  }
}

Model compile_cell(const MapRequest& request, const MapCell& cell) {
  Overrides overrides = request.settings;
  overrides[request.x.parameter] = cell.x;
  overrides[request.y.parameter] = cell.y;
  return compile(request.model, overrides);
}

/// A fault that no cell is without is one of the request.
void require_a_model(const MapRequest& request, const std::vector<MapCell>& cells) {
  for (const MapCell& cell : cells)
    if (cell.outcome != CellOutcome::failed) return;
  compile_cell(request, cells.front());
}

/// The finest and the coarsest length that linear theory, or the model's file, gives.
struct Lengths {
  double shortest = 0, longest = 0;
};

Lengths pattern_lengths(const MapRequest& request, const std::vector<MapCell>& cells) {
  std::vector<double> lengths;
  if (states_wavelength(request.model))
    if (const auto own = known_wavelength(compile(request.model, request.settings))) lengths.push_back(*own);
  for (const MapCell& cell : cells)
    if (cell.linear.band_min) lengths.push_back(*cell.linear.wavelength);
  if (lengths.empty() && request.side) lengths.push_back(*request.side / wavelengths_per_side);
  if (lengths.empty())
    throw Error(Fault::usage,
                "no wave grows in any cell and the model names no wavelength: give the side of the squares, or other "
                "ranges");
  const auto [shortest, longest] = std::ranges::minmax(lengths);
  return {std::max(shortest, finest_share * longest), longest};
}

/// Points of one row of the square: from side to side, every other row shifted by half an edge inside.
std::vector<Point> row_of_points(int edges, bool shifted, double y) {
  std::vector<Point> row = {{0, y, 0}};
  for (int i = shifted ? 0 : 1; i < edges; ++i) row.push_back({(i + (shifted ? 0.5 : 0)) / edges, y, 0});
  row.push_back({1, y, 0});
  return row;
}

/// Triangles between two rows whose points begin at the given numbers, the lower one first.
void join_rows(TriangleMesh& mesh, Index lower, Index upper, Index end) {
  const auto x = [&](Index v) { return mesh.points[static_cast<std::size_t>(v)][0]; };
  Index a = lower, b = upper;
  while (a + 1 < upper || b + 1 < end) {
    const bool below = b + 1 == end || (a + 1 < upper && x(a + 1) <= x(b + 1));
    mesh.triangles.push_back({a, below ? a + 1 : b + 1, b});
    ++(below ? a : b);
  }
}

/// The unit square cut into equilateral triangles so small that no run refines them.
TriangleMesh square(double wavelength, double resolution) {
  const double needed = std::ceil(resolution / wavelength);
  if (!(needed <= most_edges))
    throw Error(Fault::usage, "the squares are " + number(1 / wavelength) +
                                  " wavelengths wide; give a side of at most " + number(most_edges / resolution) +
                                  " wavelengths");
  const int edges = std::max(1, static_cast<int>(needed));
  const int rows = static_cast<int>(std::ceil(edges * 2 / std::sqrt(3.0)));
  TriangleMesh mesh;
  Index lower = 0;
  for (int j = 0; j <= rows; ++j) {
    const auto row = row_of_points(edges, j % 2 == 1, static_cast<double>(j) / rows);
    const auto upper = static_cast<Index>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), row.begin(), row.end());
    if (j > 0) join_rows(mesh, lower, upper, static_cast<Index>(mesh.points.size()));
    lower = upper;
  }
  return mesh;
}

Program cell_program(const MapRequest& request, const Model& model, std::shared_ptr<const TriangleMesh> shape,
                     double wavelength, double side) {
  const Suggestions& suggested = model.source().suggestions;
  Program p;
  p.shape = std::move(shape);
  StageProgram& s = p.stages.emplace_back();
  s.name = "stage1";
  s.model = model;
  s.size = wavelength / side;
  s.length_unit = 1 / side;
  s.suggested_step = suggested.step.value_or(1);
  s.until = request.until.value_or(suggested.end.value_or(1000));
  s.stationary = suggested.tolerance.value_or(0);
  s.seed = request.seed;
  p.edge = s.size / suggested.resolution_or_default();
  return p;
}

double range_of(const Vector& u) { return u.maxCoeff() - u.minCoeff(); }

/// Contrast of the coefficients against the largest magnitude of each species so far.
class Contrast {
 public:
  explicit Contrast(const Run& run) : scale_(run.coefficients().size(), 0.0) { update(run); }
  void update(const Run& run) {
    for (std::size_t i = 0; i < scale_.size(); ++i)
      scale_[i] = std::max(scale_[i], run.coefficients()[i].lpNorm<Eigen::Infinity>());
  }
  double of(const Run& run, std::size_t i) const {
    return scale_[i] > 0 ? range_of(run.coefficients()[i]) / scale_[i] : 0;
  }
  double largest(const Run& run) const {
    double contrast = 0;
    for (std::size_t i = 0; i < scale_.size(); ++i) contrast = std::max(contrast, of(run, i));
    return contrast;
  }

 private:
  std::vector<double> scale_;
};

/// The contrast of a cell that has ended before, whose state the run takes over; nothing where that makes no sense.
std::optional<double> restored(Run& run, const std::string& bytes) {
  try {
    const std::string note = note_of_checkpoint(bytes);
    double contrast = 0;
    if (std::from_chars(note.data(), note.data() + note.size(), contrast).ec != std::errc{}) return {};
    run.restore(bytes);
    return contrast;
  } catch (const Error&) {
    return {};
  }
}

/// The contrast at the end; nothing where it was asked to stop.
std::optional<double> run_to_end(Run& run, std::size_t species, const std::function<bool(double)>& report) {
  Contrast contrast(run);
  while (!run.done() && contrast.largest(run) > dead_contrast) {
    if (!report(run.fraction())) return {};
    run.advance(steps_per_slice);
    contrast.update(run);
  }
  return contrast.of(run, species);
}

/// `before`: what is kept of it from a command that was cut off. Returns what is to be kept, if it is new.
std::string run_cell(MapCell& cell, Program program, std::size_t species, const std::optional<std::string>& before,
                     const std::function<bool(double)>& report) {
  Run run(std::move(program));
  std::optional<double> contrast = before ? restored(run, *before) : std::nullopt;
  const bool known = contrast.has_value();
  if (!known) contrast = run_to_end(run, species, report);
  if (!contrast) return {};
  cell.summary = run.summary();
  cell.contrast = *contrast;
  cell.outcome = cell.contrast < uniform_contrast ? CellOutcome::uniform : CellOutcome::pattern;
  if (run.summary().status == RunStatus::failed) cell.outcome = CellOutcome::failed;
  cell.fields = run.fields();
  return known || cell.outcome == CellOutcome::failed ? "" : run.checkpoint(exact_number(cell.contrast));
}

std::vector<MapCell> empty_cells(const MapRequest& request) {
  std::vector<MapCell> cells;
  for (int j = 0; j < request.y.count; ++j)
    for (int i = 0; i < request.x.count; ++i) {
      cells.emplace_back().x = request.x.at(i);
      cells.back().y = request.y.at(j);
    }
  return cells;
}

}  // namespace

ParameterMap run_map(const MapRequest& request, const Progress& progress, const MapParts& parts) {
  ParameterMap map;
  map.cells = empty_cells(request);
  std::vector<Model> models(map.cells.size());
  for (std::size_t c = 0; c < models.size(); ++c)
    try_cell(map.cells[c], [&] { models[c] = compile_cell(request, map.cells[c]); });
  require_a_model(request, map.cells);
  parallel_chunks(models.size(),
                  [&](std::size_t c) { try_cell(map.cells[c], [&] { map.cells[c].linear = analyse(models[c]); }); });
  const Lengths lengths = pattern_lengths(request, map.cells);
  map.side = request.side.value_or(wavelengths_per_side * lengths.longest);
  const auto shape = std::make_shared<const TriangleMesh>(
      square(lengths.shortest / map.side, request.model.suggestions.resolution_or_default()));
  JobProgress jobs(progress, "running the cells", models.size());
  parallel_chunks(models.size(), [&](std::size_t c) {
    const auto report = [&](double fraction) { return jobs.report(c, fraction); };
    if (!report(0)) return;
    try_cell(map.cells[c], [&] {
      Program program = cell_program(request, models[c], shape, lengths.shortest, map.side);
      // Cells are too small to be shared among threads, and there are enough of them.
      run_on_one_thread([&] {
        const auto before = parts.find ? parts.find(c) : std::nullopt;
        const std::string ended = run_cell(map.cells[c], std::move(program), request.species, before, report);
        if (parts.keep && !ended.empty()) parts.keep(c, ended);
      });
    });
    report(1);
  });
  if (jobs.cancelled()) throw Error(Fault::cancelled, "cancelled");
  return map;
}

}  // namespace pelage
