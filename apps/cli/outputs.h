#pragma once
// Writing meshes, and saying what their formats cannot hold.

#include <cstdio>
#include <string>
#include <vector>

#include "io/output_set.h"
#include "io/write_mesh.h"
#include "pelage/io.h"
#include "text.h"

namespace pelage {

/// Tells people, and keeps for programs.
inline void warn(const std::string& text, std::vector<std::string>& warnings) {
  std::fprintf(stderr, "pelage: warning: %s\n", one_line(text).c_str());
  warnings.push_back(text);
}

/// Writes the mesh to every path; warns of what is lost, and returns these warnings.
template <class Mesh>
std::vector<std::string> save_all(const Mesh& mesh, const std::vector<std::string>& paths, const SaveOptions& form) {
  std::vector<std::string> warnings;
  for (const std::string& path : paths) {
    save(mesh, path, form);
    for (const std::string& loss : losses(mesh, extension_of(path))) warn(path + ": " + loss, warnings);
  }
  return warnings;
}

/// A line for each file that has appeared.
inline void print_written(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) std::printf("wrote     %s\n", path.c_str());
}

/// A line for each.
inline void print_findings(const std::vector<Finding>& findings) {
  for (const Finding& f : findings)
    std::printf("%-9s %s\n", f.repaired ? "repaired" : "noted", one_line(f.text).c_str());
}

}  // namespace pelage
