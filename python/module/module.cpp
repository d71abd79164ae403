#include "bindings.h"
#include "calls.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// As the program does: large arrays would otherwise go back to the system and be asked for again, page by page, which
/// takes a sixth of the time of a coat. Up to a gigabyte that is freed stays with the process.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "The library as the package pelage uses it; see there.";
  m.attr("version") = PELAGE_VERSION;
  keep_freed_memory();
  pelage::python::translate_errors();
  pelage::python::bind_shapes(m);
  pelage::python::bind_recipes(m);
  pelage::python::bind_growth(m);
  pelage::python::bind_analysis(m);
  pelage::python::bind_geometry(m);
}
