#pragma once
// Shapes, coats and pictures as files, or as bytes in memory.
//
//   pelage::save(pelage::load_shape("cow.obj"), "cow.glb");
//
// The extension picks the format; capitals count as small letters. Coordinates are never scaled or moved, and turned
// only on the way into formats that prescribe which axis points up.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pelage/error.h"
#include "pelage/finding.h"
#include "pelage/image.h"
#include "pelage/node_shape.h"
#include "pelage/polygon_mesh.h"
#include "pelage/texture_maps.h"
#include "pelage/up_axis.h"

namespace pelage {

struct ShapeFile {
  /// Checked, repaired, polygons cut into triangles; without any where the file has points alone, at least 32 of them:
  /// a cloud, with its own "normal" if it has some.
  TriangleMesh mesh;
  std::vector<Finding> findings;  ///< what was found in the file and what was done about it
  UpAxis up = UpAxis::y;          ///< z where the file says that it comes from Blender
  /// Of the only object, where the file names it; else empty.
  std::string name = {};
  /// What the file itself has, for as_in_file(); nullptr for built-in shapes and meshes of your own.
  std::shared_ptr<const SourceShape> source = nullptr;
  /// Where the shape is a grid, patches that are sewn together or a volume; `mesh` then has its nodes for vertices.
  std::shared_ptr<const NodeShape> nodes = nullptr;
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
/// And for one of faces with any number of corners, or of points alone; it is what as_in_file() goes back to. What is
/// wrong about it is told in the name of `name`. Error(Fault::input) also for vertex numbers and attributes that do not
/// fit to it.
ShapeFile check_shape(PolygonMesh mesh, const std::string& name = "mesh");

/// The extensions of shapes that can be read, with the dot: ".obj", ...
std::vector<std::string> readable_extensions();

struct SaveOptions {
  std::string name = "mesh";  ///< of the object, in formats that name it
  UpAxis up = UpAxis::y;      ///< the mesh's axis that points up: GLB prescribes y, the others take the mesh as it is
  /// What the mesh shows instead of "color", laid on it by its "uv": inside GLB; the others hold none. One for each
  /// label of "material", or a single one for all of the mesh; those of "uv" beyond the image see it repeated.
  std::vector<TextureMaps> textures = {};
  bool repeat = false;  ///< else they see its border
  /// Of GLB: quantised and packed (KHR_mesh_quantization, EXT_meshopt_compression), which not all programs read.
  bool compress = false;
};

/// Writes a mesh as .glb, .ply, .obj, .vtp, .stl, .off or .3mf, with all its attributes that the format can hold. Every
/// format is a single file, which appears whole or not at all.
/// Errors: Fault::usage for an unknown extension; Fault::numerics for a value that is not finite or does not fit a
/// 32-bit float, naming attribute and vertex; Fault::output when the file cannot be written.
void save(const TriangleMesh& mesh, const std::string& path, const SaveOptions& options = {});

/// The same for a mesh in the form of its file: faces stay as they are and vertices are not split, where the format can
/// do that. With as_in_file() a mesh so goes back to the form that it came in.
void save(const PolygonMesh& mesh, const std::string& path, const SaveOptions& options = {});

/// What files of that extension cannot hold of a mesh, or hold with fewer digits: a line for people each, empty when
/// all is kept. Error(Fault::usage) for an unknown extension.
std::vector<std::string> losses(const TriangleMesh& mesh, const std::string& extension);
std::vector<std::string> losses(const PolygonMesh& mesh, const std::string& extension);

/// The bytes of that file; `extension` with the dot. Errors as above but for the last.
std::string mesh_bytes(const TriangleMesh& mesh, const std::string& extension, const SaveOptions& options = {});
std::string mesh_bytes(const PolygonMesh& mesh, const std::string& extension, const SaveOptions& options = {});

/// The extensions of meshes that can be written, with the dot.
std::vector<std::string> mesh_extensions();

/// Writes a picture as PNG, sRGB with 8 bits per channel; values outside [0, 1] are clamped. The file appears whole or
/// not at all. Errors: Fault::usage for a picture of too many pixels; Fault::numerics for a pixel that is not finite;
/// Fault::output when the file cannot be written.
void write_png(const Image& image, const std::string& path);

/// The bytes of that file. Errors as above but for the last.
std::string png_bytes(const Image& image);

/// The same for pixels that are bytes already: one channel is grey, four are colours with their alpha.
void write_png(const Pixels& pixels, const std::string& path);
std::string png_bytes(const Pixels& pixels);

}  // namespace pelage
