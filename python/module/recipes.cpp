#include <pybind11/stl.h>

#include "bindings.h"
#include "calls.h"
#include "pelage/analyse.h"
#include "pelage/grow.h"
#include "pelage/recipe_changes.h"

namespace pelage::python {

void bind_recipes(py::module_& m) {
  py::class_<RecipeChanges>(m, "RecipeChanges")
      .def(py::init<>())
      .def_readwrite("model", &RecipeChanges::model)
      .def_readwrite("quality", &RecipeChanges::quality)
      .def_readwrite("method", &RecipeChanges::method)
      .def_readwrite("stepper", &RecipeChanges::stepper)
      .def_readwrite("solver", &RecipeChanges::solver)
      .def_readwrite("size", &RecipeChanges::size)
      .def_readwrite("unit", &RecipeChanges::unit)
      .def_readwrite("settings", &RecipeChanges::settings)
      .def_readwrite("maps", &RecipeChanges::maps)
      .def_readwrite("textures", &RecipeChanges::textures)
      .def_readwrite("cells", &RecipeChanges::cells)
      .def_readwrite("solid", &RecipeChanges::solid)
      .def_readwrite("step", &RecipeChanges::step)
      .def_readwrite("until", &RecipeChanges::until)
      .def_readwrite("stationary", &RecipeChanges::stationary)
      .def_readwrite("crease", &RecipeChanges::crease)
      .def_readwrite("steps", &RecipeChanges::steps)
      .def_readwrite("refresh", &RecipeChanges::refresh)
      .def_readwrite("seed", &RecipeChanges::seed)
      .def_readwrite("interpolate", &RecipeChanges::interpolate)
      .def_readwrite("fair", &RecipeChanges::fair)
      .def_readwrite("growth", &RecipeChanges::growth)
      .def_readwrite("motion", &RecipeChanges::motion)
      .def_readwrite("every", &RecipeChanges::every)
      .def_readwrite("species", &RecipeChanges::species)
      .def_readwrite("ramp", &RecipeChanges::ramp)
      .def_readwrite("channels", &RecipeChanges::channels)
      .def_readwrite("detail", &RecipeChanges::detail)
      .def_readwrite("invert", &RecipeChanges::invert)
      .def_readwrite("keep_shape", &RecipeChanges::keep_shape)
      .def_readwrite("flat", &RecipeChanges::flat)
      .def_readwrite("displace", &RecipeChanges::displace)
      .def_readwrite("no_fields", &RecipeChanges::no_fields);
  py::class_<Recipe>(m, "Recipe")
      .def(py::init<>())
      .def_readonly("name", &Recipe::name)
      .def_readonly("summary", &Recipe::summary)
      .def_readonly("shape", &Recipe::shape)
      .def_property_readonly("keeps_shape", [](const Recipe& self) { return self.look.keep_shape; })
      .def("with_changes", [](const Recipe& self, const RecipeChanges& changes) { return with_changes(self, changes); })
      .def("with_model",
           [](Recipe copy, const std::string& name, const std::string& text) {
             copy.models[name] = {text, name};
             return copy;
           })
      .def("with_strokes", [](Recipe copy, const std::vector<Numbers<double>>& strokes) {
        for (Stage& stage : copy.stages) {
          if (!stage.directions) stage.directions.emplace();
          for (const Numbers<double>& s : strokes) stage.directions->strokes.push_back(points_of(s, "a stroke"));
        }
        return copy;
      });
  m.def("load_recipe", &load_recipe);
  m.def("parse_recipe", &parse_recipe);
  m.def("recipe_names", &recipe_names);
  m.def("model_names", &model_names);
}

}  // namespace pelage::python
