#include <pybind11/stl.h>

#include "bindings.h"
#include "calls.h"
#include "pelage/fair.h"
#include "pelage/field.h"
#include "pelage/io.h"
#include "pelage/unwrap.h"

namespace pelage::python {

namespace {

py::dict about(const FairReport& r) {
  py::dict all;
  all["noise"] = r.noise;
  all["mean_edge"] = r.mean_edge;
  all["steps"] = r.steps;
  all["moved"] = r.moved;
  all["volume_before"] = r.volume_before;
  all["volume_after"] = r.volume_after;
  all["tau"] = r.tau;
  all["sigma"] = r.sigma;
  all["angle"] = r.angle;
  all["kept"] = r.kept;
  all["folded"] = r.folded;
  return all;
}

py::tuple faired(const TriangleMesh& mesh, const std::string& method, std::optional<double> noise,
                 std::optional<int> steps, bool slide, py::object progress) {
  FairOptions options;
  options.method = method;
  options.noise = noise;
  options.steps = steps;
  options.slide = slide;
  Faired result = with_progress(std::move(progress), [&](const Progress& p) { return fair(mesh, options, p); });
  return py::make_tuple(std::move(result.mesh), about(result.report));
}

py::dict field_on(const TriangleMesh& mesh, int n, std::optional<Point> axis, bool curvature,
                  const std::vector<Numbers<double>>& strokes, bool across, std::optional<double> smooth) {
  FieldOptions options;
  options.n = n;
  options.axis = axis;
  options.curvature = curvature;
  for (const Numbers<double>& s : strokes) options.strokes.push_back(points_of(s, "a stroke"));
  options.across = across;
  options.smooth = smooth;
  SurfaceField field = [&] {
    py::gil_scoped_release release;
    return surface_field(mesh, options);
  }();
  std::vector<std::int32_t> faces, indices;
  for (const Singularity& s : field.singularities) {
    faces.push_back(s.face);
    indices.push_back(s.index);
  }
  const py::ssize_t count = std::ssize(faces);
  py::dict all;
  all["n"] = field.n;
  all["directions"] = owned_rows(std::move(field.direction));
  all["singular_faces"] = owned<std::int32_t>(std::move(faces), {count});
  all["singular_indices"] = owned<std::int32_t>(std::move(indices), {count});
  all["roughness"] = field.roughness;
  return all;
}

py::tuple unwrapped(const PolygonMesh& mesh, int resolution, double margin, py::object progress) {
  const UnwrapOptions options{resolution, margin};
  Unwrapped atlas = with_progress(std::move(progress), [&](const Progress& p) { return unwrap(mesh, options, p); });
  const py::ssize_t corners = std::ssize(atlas.uv.values) / 2, faces = std::ssize(atlas.chart);
  py::dict report;
  report["charts"] = atlas.report.charts;
  report["stretch"] = atlas.report.stretch;
  report["worst_stretch"] = atlas.report.worst_stretch;
  report["efficiency"] = atlas.report.efficiency;
  return py::make_tuple(owned<double>(std::move(atlas.uv.values), {corners, 2}),
                        owned<std::int32_t>(std::move(atlas.chart), {faces}), report);
}

}  // namespace

void bind_geometry(py::module_& m) {
  m.def("fair", &faired);
  m.def("direction_field", &field_on);
  m.def("unwrap", &unwrapped);
  m.def("atlas_options", [](int size) {
    const UnwrapOptions options = atlas_options(size);
    return py::make_tuple(options.resolution, options.margin);
  });
}

}  // namespace pelage::python
