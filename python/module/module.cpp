#include "bindings.h"
#include "calls.h"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The library as the package pelage uses it; see there.";
  m.attr("version") = PELAGE_VERSION;
  pelage::python::translate_errors();
  pelage::python::bind_shapes(m);
  pelage::python::bind_recipes(m);
  pelage::python::bind_growth(m);
  pelage::python::bind_analysis(m);
  pelage::python::bind_geometry(m);
}
