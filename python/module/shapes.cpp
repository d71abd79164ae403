#include <pybind11/stl.h>

#include <algorithm>

#include "bindings.h"
#include "calls.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "pelage/render.h"

namespace pelage::python {

namespace {

Domain domain_called(const std::string& name) {
  if (name == "vertex") return Domain::vertex;
  if (name == "corner") return Domain::corner;
  if (name == "face") return Domain::face;
  throw py::value_error("a domain is vertex, corner or face, not " + name);
}

/// One number, or as many as there are columns, for each element.
Attribute attribute_of(const std::string& name, const Numbers<double>& values, const std::string& domain) {
  if (values.ndim() < 1 || values.ndim() > 2)
    throw py::value_error("the attribute " + name + " has to be an array of shape (n,) or (n, components)");
  Attribute a{name, values.ndim() == 2 ? static_cast<int>(values.shape(1)) : 1, domain_called(domain),
              values_of(values)};
  a.type = NumberType::float64;
  return a;
}

/// Of triangles, or of polygons with as many corners as there are columns.
PolygonMesh polygons_from(const Numbers<double>& points, const Numbers<std::int32_t>& faces) {
  PolygonMesh mesh;
  mesh.points = points_of(points, "points");
  mesh.position_type = NumberType::float64;
  if (faces.size() == 0) return mesh;
  if (faces.ndim() != 2 || faces.shape(1) < 3)
    throw py::value_error("faces have to be an array of shape (n, 3 or more)");
  mesh.corners.assign(faces.data(), faces.data() + faces.size());
  for (py::ssize_t f = 1; f <= faces.shape(0); ++f)
    mesh.face_ends.push_back(static_cast<std::size_t>(f * faces.shape(1)));
  return mesh;
}

/// Of faces one after the other: all corners, and how many each face has.
PolygonMesh mixed_polygons_from(const Numbers<double>& points, const Numbers<std::int32_t>& corners,
                                const Numbers<std::int64_t>& sizes) {
  PolygonMesh mesh;
  mesh.points = points_of(points, "points");
  mesh.position_type = NumberType::float64;
  mesh.corners.assign(corners.data(), corners.data() + corners.size());
  std::size_t end = 0;
  for (py::ssize_t f = 0; f < sizes.size(); ++f) {
    if (sizes.data()[f] < 0) throw py::value_error("a face has fewer than no corners");
    mesh.face_ends.push_back(end += static_cast<std::size_t>(sizes.data()[f]));
  }
  return mesh;
}

std::vector<std::string> attribute_names(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  for (const Attribute& a : mesh.attributes) names.push_back(a.name);
  return names;
}

/// As rows where it has several components.
py::array attribute_view(const py::object& self, const std::string& name) {
  const Attribute* a = self.cast<const TriangleMesh&>().find(name);
  if (!a) throw py::key_error(name);
  const py::ssize_t count = std::ssize(a->values) / a->components;
  return view(a->values.data(), a->components == 1 ? Extent{count} : Extent{count, a->components}, self);
}

py::dict about_finding(const Finding& f) {
  py::dict about;
  about["kind"] = f.kind;
  about["text"] = f.text;
  about["count"] = f.count;
  about["element"] = f.element;
  about["repaired"] = f.repaired;
  return about;
}

py::object grid_of(const ShapeFile& file) {
  const Grid* grid = as<Grid>(file.nodes);
  if (!grid) return py::none();
  py::dict about;
  about["count"] = grid->count;
  about["periodic"] = grid->periodic;
  about["dimension"] = grid->dimension();
  return about;
}

Image image_of(const Numbers<float>& rgb) {
  if (rgb.ndim() != 3 || rgb.shape(2) != 3) throw py::value_error("a picture is an array of shape (height, width, 3)");
  return {static_cast<int>(rgb.shape(1)), static_cast<int>(rgb.shape(0)), {rgb.data(), rgb.data() + rgb.size()}};
}

const char* kind_of(const ShapeFile& file) {
  if (as<Grid>(file.nodes)) return "grid";
  if (as<Atlas>(file.nodes)) return "patches";
  if (as<TetMesh>(file.nodes)) return "volume";
  if (as<Cells>(file.nodes)) return "cells";
  return file.mesh.triangles.empty() ? "points" : "surface";
}

template <class Mesh>
void save_mesh(const Mesh& mesh, const std::string& path, const std::string& name, const std::string& up,
               bool compress) {
  const SaveOptions options = save_options(name, up, compress);
  py::gil_scoped_release release;
  save(mesh, path, options);
}

template <class Class>
void bind_saving(Class& c) {
  using Mesh = typename Class::type;
  c.def("save", &save_mesh<Mesh>, py::arg("path"), py::arg("name"), py::arg("up"), py::arg("compress"));
  c.def("losses", [](const Mesh& mesh, const std::string& extension) { return losses(mesh, extension); });
}

void bind_meshes(py::module_& m) {
  py::class_<TriangleMesh, std::shared_ptr<TriangleMesh>> mesh(m, "Mesh");
  mesh.def_property_readonly(
          "points", [](const py::object& self) { return rows_of(self.cast<const TriangleMesh&>().points, self); })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               const auto& t = self.cast<const TriangleMesh&>().triangles;
                               return view(reinterpret_cast<const std::int32_t*>(t.data()), {std::ssize(t), 3}, self);
                             })
      .def_property_readonly("attribute_names", &attribute_names)
      .def("attribute", &attribute_view)
      .def("with_attribute",
           [](TriangleMesh copy, const std::string& name, const Numbers<double>& values, const std::string& domain) {
             copy.set(attribute_of(name, values, domain));
             return copy;
           })
      .def("render", [](const TriangleMesh& self, int width, int height, int samples, double azimuth, double elevation,
                        const std::string& up, py::object progress) {
        PictureOptions o;
        o.width = width;
        o.height = height;
        o.samples = samples;
        o.azimuth = azimuth;
        o.elevation = elevation;
        o.up = up_called(up);
        Image image = with_progress(std::move(progress), [&](const Progress& p) { return render(self, o, p); });
        return owned<float>(std::move(image.rgb), {image.height, image.width, 3});
      });
  bind_saving(mesh);
  py::class_<PolygonMesh> polygons(m, "Polygons");
  polygons.def(py::init(&polygons_from))
      .def(py::init(&mixed_polygons_from))
      .def("set", [](PolygonMesh& self, const std::string& name, const Numbers<double>& values,
                     const std::string& domain) { self.set(attribute_of(name, values, domain)); })
      .def("set_unit", [](PolygonMesh& self, double metres) { self.metres_per_unit = metres; });
  bind_saving(polygons);
}

}  // namespace

void bind_shapes(py::module_& m) {
  bind_meshes(m);
  py::class_<ShapeFile, std::shared_ptr<ShapeFile>>(m, "ShapeFile")
      .def_property_readonly(
          "mesh", [](ShapeFile& self) -> TriangleMesh& { return self.mesh; },
          py::return_value_policy::reference_internal)
      .def_property_readonly("findings",
                             [](const ShapeFile& self) {
                               py::list all;
                               for (const Finding& f : self.findings) all.append(about_finding(f));
                               return all;
                             })
      .def_property_readonly("kind", &kind_of)
      .def_property_readonly("grid", &grid_of)
      .def_property_readonly("metres_per_unit", [](const ShapeFile& self) { return self.mesh.metres_per_unit; })
      .def_property_readonly("up", [](const ShapeFile& self) { return self.up == UpAxis::z ? "z" : "y"; })
      .def_readonly("name", &ShapeFile::name)
      .def("with_mesh",
           [](ShapeFile copy, const TriangleMesh& mesh) {
             copy.mesh = mesh;
             return copy;
           })
      .def("polygons",
           [](const ShapeFile& self) { return self.source ? self.source->polygons : polygons_of(self.mesh); });
  m.def("find_shape", &find_shape, py::call_guard<py::gil_scoped_release>());
  m.def("check_shape", py::overload_cast<PolygonMesh, const std::string&>(&check_shape),
        py::call_guard<py::gil_scoped_release>());
  m.def("mesh_extensions", &mesh_extensions);
  m.def("write_png", [](const Numbers<float>& rgb, const std::string& path) { write_png(image_of(rgb), path); });
  m.def("png_bytes", [](const Numbers<float>& rgb) { return py::bytes(png_bytes(image_of(rgb))); });
}

}  // namespace pelage::python
