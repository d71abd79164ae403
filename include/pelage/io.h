#pragma once
// Shapes, coats and pictures as files, or as bytes in memory.
//
//   pelage::save(pelage::load_shape("cow.obj"), "cow.glb");
//
// The extension picks the format; capitals count as small letters. Coordinates are never turned, scaled or moved.

#include <string>
#include <string_view>
#include <vector>

#include "pelage/error.h"
#include "pelage/finding.h"
#include "pelage/image.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

struct ShapeFile {
  TriangleMesh mesh;              ///< checked, repaired, polygons cut into triangles
  std::vector<Finding> findings;  ///< what was found in the file and what was done about it
};

/// Reads OBJ, PLY, STL, OFF, glTF and GLB, or makes a "builtin:NAME?parameters", and repairs what is safe to repair.
/// Error(Fault::input): "FILE:LINE: face 1204: ..." with the line where the format has lines; vertices and faces are
/// counted from 0 in the order of the file.
TriangleMesh load_shape(const std::string& path_or_builtin);

/// The same with what was found.
ShapeFile read_shape(const std::string& path_or_builtin);

/// The same from the bytes of a file. The extension of `name` is that of the format, the whole of it is for messages;
/// files beside it, which only .gltf has, are looked for in its folder.
ShapeFile read_shape_bytes(std::string_view bytes, const std::string& name);

/// The same for a mesh of your own arrays.
ShapeFile check_shape(TriangleMesh mesh);

/// The extensions of shapes that can be read, with the dot: ".obj", ...
std::vector<std::string> readable_extensions();

/// Writes a mesh as .glb, .ply, .obj, .vtp, .stl or .off, with all its attributes that the format can hold. Every
/// format is a single file, which appears whole or not at all.
/// Errors: Fault::usage for an unknown extension; Fault::numerics for a value that is not finite or does not fit a
/// 32-bit float, naming attribute and vertex; Fault::output when the file cannot be written.
void save(const TriangleMesh& mesh, const std::string& path);

/// The bytes of that file; `extension` with the dot. Errors as above but for the last.
std::string mesh_bytes(const TriangleMesh& mesh, const std::string& extension);

/// The extensions of meshes that can be written, with the dot.
std::vector<std::string> mesh_extensions();

/// Writes a picture as PNG, sRGB with 8 bits per channel; values outside [0, 1] are clamped. The file appears whole or
/// not at all. Errors: Fault::usage for a picture of too many pixels; Fault::numerics for a pixel that is not finite;
/// Fault::output when the file cannot be written.
void write_png(const Image& image, const std::string& path);

/// The bytes of that file. Errors as above but for the last.
std::string png_bytes(const Image& image);

}  // namespace pelage
