#pragma once
// Triangle meshes as plain arrays: what is read, what the control mesh is, and what is written.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelage/point.h"

namespace pelage {

using Triangle = std::array<std::int32_t, 3>;  ///< three vertex numbers, counter-clockwise from outside

/// Where the values of an attribute sit.
enum class Domain {
  vertex,  ///< one tuple per vertex
  corner,  ///< one tuple per corner: tuple 3*f+k belongs to corner k of triangle f (uv with seams)
  face     ///< one tuple per triangle
};

/// How files hold a number. Every value of these types is exactly a double.
enum class NumberType { float32, float64, int8, uint8, int16, uint16, int32, uint32 };

/// "float32", "int8", ...
const char* name_of(NumberType type);
inline bool is_integer(NumberType type) { return type > NumberType::float64; }

/// Named values over a mesh, tuple after tuple. Conventional names:
/// "normal" (3 components, unit length), "color" (3 or 4, linear light, 0..1), "uv" (2, v upwards);
/// per face "object", "group" and "material" (1, with labels).
struct Attribute {
  std::string name;
  int components = 1;
  Domain domain = Domain::vertex;
  std::vector<double> values;             ///< components * (number of vertices, corners or faces)
  NumberType type = NumberType::float32;  ///< of the file that it comes from, and of those that it goes to
  std::vector<std::string> labels = {};   ///< names of the values 0, 1, ..., or empty
};

/// Whether the values are colours, which files hold encoded: "color" itself, "face_color" and "corner_color"
/// beside it, "color1", ... of glTF, "material_color", and the "input_color", ... of a coat.
bool is_color(const Attribute& attribute);

/// After interpolation: integers between which there is something now are doubles.
void widen(Attribute& attribute);

/// A file that a mesh names, as it names it.
struct FileLink {
  std::string kind;  ///< "mtllib" of OBJ, "TextureFile" of PLY
  std::string file;
};

/// Vertices, triangles and named attributes; says nothing about unknowns.
/// World units are those of the file; axes as in the file (right-handed).
struct TriangleMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<Attribute> attributes;
  std::vector<FileLink> links = {};
  /// 0.001 where the coordinates count millimetres; nothing where neither the file nor you say.
  std::optional<double> metres_per_unit = {};

  /// The attribute of that name, or nullptr.
  const Attribute* find(std::string_view name) const;
  Attribute* find(std::string_view name);
  /// Replaces an attribute of the same name.
  void set(Attribute attribute);
};

}  // namespace pelage
