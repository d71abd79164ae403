#include "catalog/bind.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box.h"
#include "base/number.h"
#include "base/suggest.h"
#include "catalog/brushes.h"
#include "catalog/images.h"
#include "catalog/marks.h"
#include "catalog/missing_attribute.h"
#include "catalog/names.h"
#include "catalog/size.h"
#include "react/place_values.h"
#include "run/constant_diffusion.h"
#include "run/directions.h"
#include "run/material.h"
#include "run/random_points.h"
#include "shape/cells.h"
#include "shape/creases.h"
#include "shape/finding.h"
#include "shape/grid.h"
#include "shape/refine.h"
#include "shape/soup_orient.h"
#include "shape/tet_mesh.h"
#include "solid/fill.h"

namespace pelage {

namespace {

/// All that attribute(NAME) may read from the shape and its images; Error for an image that hides something.
std::vector<std::string> attributes_of(const TriangleMesh& shape, const std::vector<TextureFile>& textures) {
  std::vector<std::string> names;
  for (const auto& [name, values] : scalar_attributes(shape)) names.push_back(name);
  for (const TextureFile& t : textures) take_texture_name(t.name, names);
  return names;
}

void require_uv(const TriangleMesh& shape, const std::vector<TextureFile>& textures) {
  const Attribute* uv = shape.find("uv");
  if (!textures.empty() && (!uv || uv->components != 2))
    throw Error(Fault::usage,
                "the shape has no uv, by which the texture \"" + textures[0].name.value +
                    "\" would be laid on it; unwrap it and export it with uv",
                textures[0].name.where);
}

/// What layers know beside the attributes: the species, and what these hide.
std::vector<std::string> names_of_look(std::vector<std::string> species, const std::vector<std::string>& known) {
  for (const std::string& name : known)
    if (std::ranges::count(species, name) > 0) species.push_back(input_name(name));
  return species;
}

/// Fields, which have a dot in their names, are known to be there.
void require_attributes(const std::vector<Symbol>& symbols, const TriangleMesh& shape, std::vector<std::string> known,
                        const std::vector<std::string>& more) {
  known.insert(known.end(), more.begin(), more.end());
  for (const Symbol& s : symbols)
    if (s.kind == Symbol::Kind::attribute && s.name.find('.') == std::string::npos && !matching_name(s.name, known))
      throw missing_attribute(s, shape, known);
}

/// All that the formulas of a stage read from the place.
std::vector<Symbol> symbols_of(const PlannedStage& stage) {
  std::vector<Symbol> symbols = place_symbols(stage.model);
  for (const auto* formula : {&stage.size_map, &stage.from, &stage.to})
    if (*formula)
      for (const Symbol& s : (*formula)->symbols()) symbols.push_back(s);
  return symbols;
}

/// A place that is given from -1 to 1 in the box.
Point in_box(const Point& place, const Box& box) {
  Point p = box.middle();
  for (std::size_t k = 0; k < 3; ++k) p[k] += place[k] * (box.high[k] - box.low[k]) / 2;
  return p;
}

FieldWish bind_directions(const PlannedStage& planned, const MeshPlaces& places, double diagonal) {
  const Directions& d = *planned.asked.directions;
  FieldWish wish;
  wish.axis = d.axis;
  if (d.centre) wish.centre = in_box(*d.centre, box_of(places.shape.points));
  wish.curvature = d.curvature;
  wish.strokes = d.strokes;
  if (planned.from) {
    wish.from = marked_vertices(*planned.from, places, d.from->where);
    wish.to = marked_vertices(*planned.to, places, d.to->where);
  }
  wish.across = d.across;
  wish.smooth = default_field_smoothing * diagonal;
  return wish;
}

/// Where conditions can hold; none on other shapes.
std::vector<std::string> sides_of(const std::shared_ptr<const NodeShape>& nodes) {
  if (const Grid* grid = as<Grid>(nodes)) return axis_ends(*grid);
  return as<TetMesh>(nodes) ? std::vector<std::string>{"skin"} : std::vector<std::string>{};
}

void require_sides(const std::vector<BorderCondition>& borders, const std::shared_ptr<const NodeShape>& nodes) {
  if (borders.empty()) return;
  const std::vector<std::string> sides = sides_of(nodes);
  for (const BorderCondition& c : borders) {
    if (sides.empty())
      throw Error(Fault::usage,
                  as<Grid>(nodes) ? "the grid has no sides: all its axes are periodic"
                                  : "conditions at borders are for grids and volumes; leave [boundary] out",
                  c.where);
    if (std::ranges::count(sides, c.side) == 0) throw Error(Fault::usage, unknown_name("side", c.side, sides), c.where);
  }
}

StageProgram bind_stage(const PlannedStage& planned, const Program& program, const ShapeScale& scale) {
  const Stage& asked = planned.asked;
  const Suggestions& suggested = planned.model.source().suggestions;
  StageProgram s;
  s.name = asked.name.value;
  s.model = planned.model;
  s.model_name = asked.model.value;
  s.stepper = planned.stepper;
  s.solver = planned.solver;
  s.solver_asked = !asked.solver.value.empty();
  if (asked.refresh) s.refresh = asked.refresh->value;
  const StageSize size = stage_size(asked, planned.wavelength, scale);
  s.size = size.wavelength;
  s.length_unit = size.length_unit;
  s.origin = scale.middle;
  s.size_known = planned.wavelength_known;
  s.step = asked.step;
  s.suggested_step = suggested.step.value_or(1);
  s.excluded = asked.inside.value == "excluded";
  if (asked.points) s.points = world_length(*asked.points, scale);
  if (asked.jitter) s.jitter = asked.jitter->value;
  s.until = planned.until;
  s.steps = asked.steps;
  s.stationary = asked.stationary.value_or(suggested.tolerance.value_or(0));
  s.seed = asked.seed;
  s.borders = planned.borders;
  require_sides(s.borders, program.nodes);
  if (asked.directions)
    s.directions = bind_directions(planned, {*program.shape, program.textures, s.length_unit, s.seed}, scale.diagonal);
  return s;
}

void note_directions(const Program& p, StageProgram& s, std::vector<std::string>& warnings) {
  if (!s.model.anisotropic()) return;
  const FollowedDirections followed = followed_directions(*p.shape, s.directions, p.nodes.get());
  s.follows = followed.text;
  if (!followed.warning.empty()) warnings.push_back(followed.warning);
}

/// Edges per size: where that is no wavelength but what diffusion needs, fronts are no thinner.
double resolution_of(const PlannedStage& planned) {
  return planned.wavelength_known ? planned.model.source().suggestions.resolution_or_default()
                                  : Suggestions{}.resolution_or_default();
}

/// Lowers the edges of the program to those that carry the patterns of its latest stage.
void need_edges_of(const PlannedStage& planned, const Quality& quality, Program& program) {
  const StageProgram& s = program.stages.back();
  const double edges = quality.edges * program.method->edges * resolution_of(planned);
  const double edge = s.size / edges;
  const MeshPlaces places{*program.shape, program.textures, s.length_unit, s.seed};
  double smallest = 1;
  std::vector<double> factor(program.edges.size(), 1.0);
  if (planned.size_map) {
    smallest = smallest_factor(*planned.size_map, places, edge, planned.asked.size_map->where);
    // Of an image the vertices may miss the details.
    if (textures_read(planned.size_map->symbols(), program.textures).empty())
      factor = vertex_values(*planned.size_map, places);
    else
      factor.assign(factor.size(), smallest);
  }
  program.edge = std::min(program.edge, edge * smallest);
  for (std::size_t v = 0; v < program.edges.size(); ++v)
    program.edges[v] = std::min(program.edges[v], edge * factor[v]);
}

/// Where all is as it was when the iterations of the model were counted, but for the end and the number of edges: with
/// more of them, every step takes as many iterations more.
std::optional<double> likely_iterations(const PlannedStage& planned, const Plan& plan, const Program& program,
                                        const StageProgram& s) {
  const Suggestions& suggested = planned.model.source().suggestions;
  const bool as_measured = !plan.method_asked && planned.asked.stepper.value.empty() && !s.step && !s.steps;
  if (!as_measured || !suggested.iterations || !suggested.end || !(*suggested.end > 0)) return {};
  const double edges = s.size / program.edge / (program.method->edges * resolution_of(planned));
  return *suggested.iterations * std::min(1.0, s.until / *suggested.end) * std::max(1.0, edges);
}

/// Whether the mesh of the run can have other edges where the size is another.
bool sizes_differ(const Plan& plan, const Method& method) {
  return method.own_mesh && std::ranges::any_of(plan.stages, [](const auto& s) { return s.size_map.has_value(); });
}

/// A method of surfaces makes room for one that fits the nodes where the recipe does not insist.
const Method* node_method_of(const Plan& plan, const NodeShape& nodes) {
  if (plan.method->fits && plan.method->fits(nodes)) return plan.method;
  const auto fits = [&](const Method* m) { return m->fits && m->fits(nodes); };
  const Method* fitting = *std::ranges::find_if(methods(), fits);
  if (!plan.method_asked) return fitting;
  throw Error(Fault::usage, "the method \"" + std::string(plan.method->name) + "\" is for " +
                                (plan.method->make_space ? "surfaces" : "other shapes") + "; here take \"" +
                                std::string(fitting->name) + "\"");
}

/// Before any work: steppers that know waves alone.
void require_even_diffusion(const PlannedStage& s) {
  if (s.stepper->lattice && !diffuses_evenly(s.model))
    throw Error(Fault::usage,
                "the stepper \"" + std::string(s.stepper->name) +
                    "\" needs a diffusion that is the same everywhere, and that of \"" + s.model.name() +
                    "\" is not here; leave the stepper out",
                s.asked.stepper.where);
}

void require_no_lattice(const Plan& plan) {
  for (const PlannedStage& s : plan.stages)
    if (s.stepper->lattice)
      throw Error(Fault::usage,
                  "the stepper \"" + std::string(s.stepper->name) +
                      "\" is for even grids, which the shape is not; leave the stepper out",
                  s.asked.stepper.where);
}

void require_no_creases(const Plan& plan) {
  if (plan.crease)
    throw Error(Fault::usage,
                "creases are those of the smooth surface of a mesh, for the methods \"" +
                    std::string(remeshed_method.name) + "\" and \"" + std::string(loop_method.name) +
                    "\"; leave them out here",
                plan.crease->where);
}

/// Of a shape that is faired they are found where they are going to be.
Creases creases_of(const Plan& plan, const TriangleMesh& shape) {
  if (!plan.crease) return {};
  const std::vector<Point> points = plan.fair ? fair(shape, *plan.fair).mesh.points : shape.points;
  return creases_above(plan.crease->value, make_topology(points.size(), shape.triangles), points);
}

/// Loop elements are made for moderate valences: where the recipe does not insist, others take their place.
const Method* fitting_method(const Plan& plan, const TriangleMesh& shape, std::vector<std::string>& warnings) {
  if (!plan.method->make_space)
    throw Error(Fault::usage,
                "the method \"" + std::string(plan.method->name) + "\" is not for meshes; leave the method away");
  const Index valence = max_valence(make_topology(shape.points.size(), shape.triangles));
  if (plan.method_asked || valence <= plan.method->max_valence) return plan.method;
  warnings.push_back("a vertex has " + std::to_string(valence) + " edges, more than the " +
                     std::to_string(plan.method->max_valence) + " that Loop elements take; using --method " +
                     std::string(linear_method.name));
  return &linear_method;
}

}  // namespace

namespace {

/// Whether the shape has all that the plan reads from it.
void require_fitting(const Plan& plan, const TriangleMesh& shape, const ShapeScale& scale) {
  const std::vector<std::string> known = attributes_of(shape, plan.textures);
  require_uv(shape, plan.textures);
  for (const PlannedStage& s : plan.stages)
    require_attributes(symbols_of(s), shape, known,
                       s.asked.points ? std::vector<std::string>{points_attribute} : std::vector<std::string>{});
  require_attributes(plan.paint.symbols(), shape, known, names_of_look(plan.paint.species, known));
  if (!(scale.diagonal > 0)) throw Error(Fault::input, "the shape has no extent: all its vertices are at one place");
}

/// All but method, shape and stages.
Program begin_program(const Plan& plan, std::vector<Texture> images) {
  Program p;
  p.textures = std::move(images);
  p.interpolate = plan.interpolate;
  p.step_error = plan.quality->step_error;
  p.motion = {plan.fair, plan.motion.growth, plan.motion.mode.value == "physical", plan.motion.every};
  return p;
}

void count_iterations(const Plan& plan, Program& p) {
  for (std::size_t k = 0; k < p.stages.size(); ++k)
    p.stages[k].iterations = likely_iterations(plan.stages[k], plan, p, p.stages[k]);
}

void require_at_rest(const Plan& plan) {
  if (plan.fair || plan.motion.growth != 0)
    throw Error(Fault::usage, "these nodes stay where they are: leave fairing and growth out");
}

/// Of all lengths, when the surface is at its largest: then edges have to do.
double largest_scale(const Plan& plan) { return std::exp(std::max(0.0, plan.motion.growth * plan.until)); }

/// The nodes of a grid are what they are.
void warn_if_coarse(const PlannedStage& planned, double largest_scale, Program& p) {
  const StageProgram& s = p.stages.back();
  const double needed = planned.model.source().suggestions.resolution_or_default(),
               nodes = s.size / (largest_scale * p.edge);
  if (nodes < needed)
    p.warnings.push_back((p.stages.size() > 1 ? s.name + ": " : "") + "the wavelength is " + number(nodes, 3) +
                         " times the distance of the nodes, fewer than the " + number(needed) +
                         " that the model needs: the nodes themselves may show in the pattern");
}

void bind_stages(const Plan& plan, const ShapeScale& scale, const Point& period, Program& p) {
  for (const PlannedStage& s : plan.stages) {
    require_even_diffusion(s);
    p.stages.push_back(bind_stage(s, p, scale));
    p.stages.back().period = period;
    note_directions(p, p.stages.back(), p.warnings);
    warn_if_coarse(s, largest_scale(plan), p);
  }
  count_iterations(plan, p);
}

}  // namespace

namespace {

/// With what is painted on it already.
Program bind_nodes(const Plan& plan, std::shared_ptr<const NodeShape> nodes, TriangleMesh mesh,
                   std::vector<Texture> images) {
  const Grid* grid = as<Grid>(nodes);
  if (!grid || !grid->even()) require_no_lattice(plan);
  require_no_creases(plan);
  if (grid && !plan.textures.empty() && !mesh.find("uv")) mesh.set(uv_of(*grid));
  const ShapeScale scale = scale_of(*nodes, mesh);
  require_fitting(plan, mesh, scale);
  if (!as<TetMesh>(nodes)) require_at_rest(plan);
  Program p = begin_program(plan, std::move(images));
  p.method = node_method_of(plan, *nodes);
  p.nodes = std::move(nodes);
  p.shape = std::make_shared<const TriangleMesh>(std::move(mesh));
  p.edge = *scale.cell;
  bind_stages(plan, scale, grid ? period_of(*grid) : Point{}, p);
  return p;
}

}  // namespace

Program bind_plan(const Plan& plan, std::shared_ptr<const NodeShape> nodes, TriangleMesh mesh,
                  std::vector<Texture> images) {
  paint_brushes(plan.brushes, scale_of(*nodes, mesh), false, mesh);
  return bind_nodes(plan, std::move(nodes), std::move(mesh), std::move(images));
}

namespace {

/// Stages on the surface of `p.shape`, and the edges that they need.
void bind_surface(const Plan& plan, const ShapeScale& scale, Program& p) {
  p.edge = std::numeric_limits<double>::infinity();
  if (sizes_differ(plan, *p.method)) p.edges.assign(p.shape->points.size(), p.edge);
  for (const PlannedStage& s : plan.stages) {
    p.stages.push_back(bind_stage(s, p, scale));
    note_directions(p, p.stages.back(), p.warnings);
    need_edges_of(s, *plan.quality, p);
  }
  // The shape itself needs some.
  constexpr double longest_share = 0.02;
  if (p.method->own_mesh || p.method->fits) p.edge = std::min(p.edge, longest_share * scale.diagonal);
  for (double& edge : p.edges) edge = std::min(edge, longest_share * scale.diagonal);
  const double growth = largest_scale(plan);
  p.edge /= growth;
  for (double& edge : p.edges) edge /= growth;
}

bool fills(const Method& method) { return method.fits && method.fits(TetMesh{}); }

/// What the patterns of all stages need in the volume that a shape encloses.
double edge_inside(const Plan& plan, TriangleMesh shape, std::vector<Texture> images) {
  const ShapeScale scale = scale_of(shape);
  paint_brushes(plan.brushes, scale, true, shape);
  require_fitting(plan, shape, scale);
  Program p = begin_program(plan, std::move(images));
  p.method = plan.method;
  p.nodes = std::make_shared<const NodeShape>(TetMesh{});
  p.shape = std::make_shared<const TriangleMesh>(std::move(shape));
  bind_surface(plan, scale, p);
  return p.edge;
}

/// More would need more memory than common machines have: about 0.3 kB each with two species.
constexpr std::size_t max_tets = 16'000'000;

Finding lost_volume(double share, double edge) {
  return {"lost-volume",
          number(100 * share, 2) + " % of the volume is lost, where the shape is thinner than " + number(edge, 3) +
              ", the edge of the tetrahedra; a finer quality or a smaller pattern keeps more",
          0, 0, false};
}

/// Clouds of points, which have no triangles, and meshes for which the recipe asks it.
bool grows_on_cells(const Plan& plan, const TriangleMesh& shape) {
  return shape.triangles.empty() || (plan.method->fits && plan.method->fits(Cells{}));
}

std::size_t number_of_cells(const Plan& plan, const CellMaker& maker, std::shared_ptr<const TriangleMesh> shape,
                            std::vector<Texture> images) {
  if (plan.cells) return static_cast<std::size_t>(plan.cells->value);
  const ShapeScale scale = scale_of(maker.box(), shape->metres_per_unit);
  require_fitting(plan, *shape, scale);
  Program p = begin_program(plan, std::move(images));
  p.method = node_method_of(plan, Cells{});
  p.shape = std::move(shape);
  bind_surface(plan, scale, p);
  return maker.for_edge(p.edge);
}

Program bind_cells(const Plan& plan, TriangleMesh mesh, std::vector<Texture> images) {
  require_at_rest(plan);
  const std::size_t reversed = orient_soup(mesh);
  paint_brushes(plan.brushes, scale_of(mesh), !mesh.triangles.empty(), mesh);
  const auto shape = std::make_shared<const TriangleMesh>(std::move(mesh));
  const CellMaker maker(shape);
  Cells cells = maker.make(number_of_cells(plan, maker, shape, images));
  constexpr double stretch = 2;  // as the ratio of rates up to which other methods are good
  if (std::ranges::any_of(plan.stages,
                          [](const PlannedStage& s) { return s.model.anisotropic() || s.model.has_tensor(); }))
    cells.stretch = stretch;
  TriangleMesh points = mesh_of(cells);
  Program p =
      bind_nodes(plan, std::make_shared<const NodeShape>(std::move(cells)), std::move(points), std::move(images));
  if (reversed > 0)
    p.warnings.push_back(counted(reversed, "triangle") + " turned over, so that all that meet have one side up");
  if (maker.covered_share() > 0)
    p.warnings.push_back(number(100 * maker.covered_share(), 2) +
                         " % of the area lies inside other parts: nothing grows there");
  if (maker.outliers() > 0)
    p.warnings.push_back(std::to_string(maker.outliers()) + " of the " + std::to_string(shape->points.size()) +
                         " points are far from all others: nothing grows on them");
  return p;
}

}  // namespace

void fill_solid(const Plan& plan, ShapeFile& shape, const std::vector<Texture>& images) {
  if (shape.nodes || !fills(*plan.method)) return;
  const double edge = edge_inside(plan, shape.mesh, images);
  constexpr double noticeable = 0.01;
  Filling filling = fill_within(shape.mesh, edge, noticeable, max_tets);
  if (filling.lost > noticeable) shape.findings.push_back(lost_volume(filling.lost, filling.edge));
  paint_brushes(plan.brushes, scale_of(shape.mesh), true, shape.mesh);
  filling.volume.surface = std::make_shared<const TriangleMesh>(std::move(shape.mesh));
  shape.mesh = mesh_of(filling.volume);
  shape.nodes = std::make_shared<const NodeShape>(std::move(filling.volume));
}

Program bind_plan(const Plan& plan, ShapeFile& shape, std::vector<Texture> images) {
  fill_solid(plan, shape, images);
  return shape.nodes ? bind_plan(plan, shape.nodes, std::move(shape.mesh), std::move(images))
                     : bind_plan(plan, std::move(shape.mesh), std::move(images));
}

Program bind_plan(const Plan& plan, TriangleMesh shape, std::vector<Texture> images) {
  require_no_lattice(plan);
  if (fills(*plan.method)) {
    ShapeFile file;
    file.mesh = std::move(shape);
    return bind_plan(plan, file, std::move(images));
  }
  if (grows_on_cells(plan, shape)) return bind_cells(plan, std::move(shape), std::move(images));
  const ShapeScale scale = scale_of(shape);
  paint_brushes(plan.brushes, scale, true, shape);
  require_fitting(plan, shape, scale);
  Program p = begin_program(plan, std::move(images));
  p.warnings = coarse_brushes(plan.brushes, scale, shape);
  p.method = fitting_method(plan, shape, p.warnings);
  if (!p.method->smooth) require_no_creases(plan);
  p.creases = creases_of(plan, shape);
  if (plan.crease && !p.creases.any())
    p.warnings.push_back("no edge of the shape bends by more than " + number(plan.crease->value) +
                         " degrees: there are no creases");
  p.shape = std::make_shared<const TriangleMesh>(std::move(shape));
  bind_surface(plan, scale, p);
  count_iterations(plan, p);
  return p;
}

Program make_program(const Recipe& recipe, Grid grid) {
  require_sound(grid);
  TriangleMesh mesh = mesh_of(grid);
  return bind_plan(plan(recipe), std::make_shared<const NodeShape>(std::move(grid)), std::move(mesh),
                   read_images(recipe.textures));
}

Program make_program(const Recipe& recipe, TriangleMesh shape) {
  return bind_plan(plan(recipe), std::move(shape), read_images(recipe.textures));
}

}  // namespace pelage
