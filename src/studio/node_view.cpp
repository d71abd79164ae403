#include "studio/node_view.h"

#include "base/parallel.h"
#include "base/srgb.h"
#include "look/tessellation.h"

namespace pelage {

namespace {

/// Whether the nodes are vertices of a surface that the run knows.
bool has_surface(const Run& run) { return !run.program().nodes && run.world().hierarchy(); }

std::vector<std::vector<double>> fields_at_nodes(const Run& run) {
  std::vector<std::vector<double>> fields;
  const auto add = [&](const Vector& coefficients) {
    const Vector values = run.space().node_values() * coefficients;
    fields.emplace_back(values.begin(), values.end());
  };
  for (const Run::FinishedStage& stage : run.finished())
    for (const Vector& u : stage.fields) add(u);
  for (const Vector& u : run.coefficients()) add(u);
  return fields;
}

bool reads_curvature(const Paint& paint) {
  const std::vector<Symbol> symbols = paint.symbols();
  return std::ranges::any_of(symbols, [](const Symbol& s) { return s.kind == Symbol::Kind::curvature; });
}

void take_geometry(const Run& run, const Paint& paint, CoatSamples& samples) {
  PlaceGeometry geometry = run.space().geometry(SampleRule::vertices, reads_curvature(paint));
  samples.position = std::move(geometry.position);
  samples.normal = std::move(geometry.normal);
  samples.curvature = std::move(geometry.curvature);
}

void take_attributes(const Run& run, const Paint& paint, CoatSamples& samples) {
  const Program& program = run.program();
  const std::vector<Symbol> symbols = paint.symbols();
  if (std::ranges::any_of(symbols, [](const Symbol& s) { return s.kind == Symbol::Kind::attribute; }))
    for (auto& [name, values] : scalar_attributes(*program.shape))
      samples.attributes[name] = run.world().at_nodes(std::move(values));
  for (const Texture& texture : textures_read(symbols, program.textures))
    samples.attributes.merge(run.world().at_nodes(texture));
}

TessellationRequest coarse(const Paint& paint) {
  TessellationRequest request = tessellation_request({}, paint);
  request.detail = 0;
  return request;
}

}  // namespace

NodeView view_nodes(const Run& run, const Paint& paint) {
  NodeView view;
  if (!has_surface(run)) {
    refresh(view, run, paint);
    return view;
  }
  const CoatFields fields = run.fields();
  view.triangles = run.world().topology().triangles;
  view.moves = run.world().surface() != nullptr;
  CoatSamples& s = view.samples;
  s.length_unit = fields.length_unit;
  s.wavelength = fields.wavelength;
  s.origin = fields.origin;
  s.period = fields.period;
  s.seed = fields.seed;
  take_geometry(run, paint, s);
  if (view.moves) s.drawn_at = run.world().initial_positions(SampleRule::vertices);
  take_attributes(run, paint, s);
  s.fields = fields_at_nodes(run);
  return view;
}

void refresh(NodeView& view, const Run& run, const Paint& paint) {
  if (!has_surface(run)) {
    Tessellation t = tessellate(run.fields(), coarse(paint));
    view.triangles = std::move(t.triangles);
    view.samples = std::move(t.samples);
    view.moves = true;
    return;
  }
  if (view.moves) take_geometry(run, paint, view.samples);
  view.samples.fields = fields_at_nodes(run);
}

std::vector<std::uint8_t> view_colors(const NodeView& view, const Paint& paint, const std::vector<char>& uniform) {
  return as_bytes(pelage::paint(view.samples, make_palette(paint, view.samples, uniform)));
}

std::vector<float> as_floats(const std::vector<Point>& points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Point& p : points)
    for (const double x : p) values.push_back(static_cast<float>(x));
  return values;
}

std::vector<std::uint32_t> as_indices(const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> values;
  values.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (const std::int32_t v : t) values.push_back(static_cast<std::uint32_t>(v));
  return values;
}

std::vector<std::uint8_t> as_bytes(const std::vector<double>& linear_colors) {
  static const SrgbBytes encode;
  const std::size_t count = linear_colors.size() / 3;
  std::vector<std::uint8_t> bytes(4 * count, 255);
  parallel_for(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) bytes[4 * i + k] = encode(static_cast<float>(linear_colors[3 * i + k]));
  });
  return bytes;
}

}  // namespace pelage
