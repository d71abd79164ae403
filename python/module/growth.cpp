#include <pybind11/stl.h>

#include "bindings.h"
#include "calls.h"
#include "pelage/grow.h"

namespace pelage::python {

namespace {

py::dict about(const RunSummary& s) {
  py::dict all;
  all["status"] = name_of(s.status);
  all["message"] = s.message;
  all["time"] = s.time;
  all["steps"] = s.steps;
  all["step"] = s.step;
  all["change"] = s.change;
  all["iterations"] = s.iterations;
  all["rejected"] = s.rejected;
  all["solves"] = s.solves;
  all["minimum"] = s.minimum;
  all["maximum"] = s.maximum;
  return all;
}

py::array as_array(const std::shared_ptr<const Pixels>& pixels) {
  Extent extent = {pixels->height, pixels->width};
  if (pixels->channels > 1) extent.push_back(pixels->channels);
  return owned<std::uint8_t>(std::vector<std::uint8_t>(pixels->bytes), extent);
}

/// A growth with what its Python functions have thrown.
class PythonGrowth {
 public:
  PythonGrowth(const ShapeFile& shape, const Recipe& recipe, py::object progress, py::object rates, std::string stage)
      : thrown_(std::make_shared<Thrown>()) {
    const Progress told = progress_of(std::move(progress), thrown_);
    const OwnRates own = own_rates_of(std::move(rates), std::move(stage), thrown_);
    without_lock(*thrown_, [&] { growth_.emplace(shape, recipe, told, own); });
  }
  ~PythonGrowth() {
    py::gil_scoped_release release;
    growth_.reset();
  }

  template <class Work>
  auto unlocked(Work&& work) {
    return without_lock(*thrown_, [&] { return work(*growth_); });
  }
  Growth& growth() { return *growth_; }
  const Growth& growth() const { return *growth_; }

 private:
  std::shared_ptr<Thrown> thrown_;
  std::optional<Growth> growth_;
};

py::dict images_of(const TexturedMesh& baked) {
  py::dict images;
  const auto add = [&](const char* name, const std::shared_ptr<const Pixels>& pixels) {
    if (pixels) images[name] = as_array(pixels);
  };
  add("color", baked.maps.color);
  add("normal", baked.maps.normal);
  add("roughness", baked.maps.roughness);
  add("metalness", baked.maps.metalness);
  add("opacity", baked.maps.opacity);
  add("emission", baked.maps.emission);
  add("transmission", baked.maps.transmission);
  add("thickness", baked.maps.thickness);
  if (!baked.height.empty())
    images["height"] = owned<float>(std::vector<float>(baked.height), {baked.size, baked.size});
  return images;
}

void save_baked(const TexturedMesh& baked, const std::string& path, const std::string& name, const std::string& up,
                bool compress) {
  SaveOptions options = save_options(name, up, compress);
  options.textures = {baked.maps};
  options.repeat = baked.repeat;
  py::gil_scoped_release release;
  save(baked.mesh, path, options);
}

}  // namespace

void bind_growth(py::module_& m) {
  py::class_<TexturedMesh>(m, "TexturedMesh")
      .def("images", &images_of)
      .def("save", &save_baked, py::arg("path"), py::arg("name"), py::arg("up"), py::arg("compress"));
  py::class_<PythonGrowth>(m, "Growth")
      .def(py::init<const ShapeFile&, const Recipe&, py::object, py::object, std::string>(), py::arg("shape"),
           py::arg("recipe"), py::arg("progress"), py::arg("rates"), py::arg("stage"))
      .def_property_readonly("done", [](const PythonGrowth& g) { return g.growth().done(); })
      .def_property_readonly("fraction", [](const PythonGrowth& g) { return g.growth().fraction(); })
      .def("advance", [](PythonGrowth& g, std::int64_t steps) { g.unlocked([&](Growth& x) { x.advance(steps); }); })
      .def("finish",
           [](PythonGrowth& g) {
             g.unlocked([](Growth& x) {
               while (!x.done()) x.advance(1);
             });
           })
      .def_property_readonly("stage",
                             [](const PythonGrowth& g) {
                               const Growth::StagePlace place = g.growth().stage();
                               return py::make_tuple(place.number, place.count, place.name);
                             })
      .def_property_readonly("summary", [](const PythonGrowth& g) { return about(g.growth().summary()); })
      .def_property_readonly("uniform", [](const PythonGrowth& g) { return g.growth().uniform(); })
      .def_property_readonly("why_uniform", [](const PythonGrowth& g) { return g.growth().why_uniform(); })
      .def_property_readonly("warnings", [](const PythonGrowth& g) { return g.growth().warnings(); })
      .def("dress", [](PythonGrowth& g) { return g.unlocked([](Growth& x) { return x.dress(); }); })
      .def("dress_in_file", [](PythonGrowth& g) { return g.unlocked([](Growth& x) { return x.dress_in_file(); }); })
      .def("fields",
           [](PythonGrowth& g) {
             py::dict all;
             for (Growth::Field& f : g.unlocked([](Growth& x) { return x.fields(); }))
               all[py::str(f.name)] = owned_numbers(std::move(f.values));
             return all;
           })
      .def("bake", [](PythonGrowth& g, int size) { return g.unlocked([&](Growth& x) { return x.bake(size); }); })
      .def("nodes", [](PythonGrowth& g) { return g.unlocked([](Growth& x) { return x.nodes(); }); })
      .def_property_readonly("species", [](const PythonGrowth& g) { return g.growth().species(); })
      .def("values",
           [](const PythonGrowth& g, const std::string& species) { return owned_numbers(g.growth().values(species)); })
      .def("set_values",
           [](PythonGrowth& g, const std::string& species, const Numbers<double>& values) {
             const std::vector<double> all = values_of(values);
             g.unlocked([&](Growth& x) { x.set_values(species, all); });
           })
      .def("checkpoint", [](const PythonGrowth& g) { return py::bytes(g.growth().checkpoint()); })
      .def("restore", [](PythonGrowth& g, const std::string& bytes) { g.growth().restore(bytes); });
}

}  // namespace pelage::python
