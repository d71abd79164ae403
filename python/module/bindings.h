#pragma once
// The parts of the module _core. What is public in Python is written in Python over it (python/pelage).

#include <pybind11/pybind11.h>

namespace pelage::python {

void bind_shapes(pybind11::module_& m);    ///< meshes, shapes, files, pictures
void bind_recipes(pybind11::module_& m);   ///< recipes and what is changed in them
void bind_growth(pybind11::module_& m);    ///< coats that grow
void bind_analysis(pybind11::module_& m);  ///< linear theory of models, patterns in numbers
void bind_geometry(pybind11::module_& m);  ///< fairing, direction fields, atlases

}  // namespace pelage::python
