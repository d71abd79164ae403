// What this build leaves out, refused by name.

#include "io/sha256.h"
#include "io/vtk_grid_reader.h"
#include "io/vtp_reader.h"
#include "io/vtu_reader.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// pugixml, which reads them, is no library of headers alone.
[[noreturn]] void refuse_vtk(const std::string& path) {
  throw Error(Fault::input, "is a VTK file, which this build does not read; use pelage studio, or save as PLY", {path});
}

}  // namespace

RawShape read_vtp(std::string_view, const std::string& path) { refuse_vtk(path); }
SolidCells read_vtu(std::string_view, const std::string& path, std::vector<Finding>&) { refuse_vtk(path); }
GridFile read_vtk_grid(std::string_view, const std::string& path) { refuse_vtk(path); }

/// Only of records, which the command line makes (io/output_set.h).
std::string sha256(std::string_view) {
  throw Error(Fault::output, "this build keeps no records of files; grow the coat with the program pelage");
}

}  // namespace pelage
