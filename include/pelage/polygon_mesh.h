#pragma once
// Meshes as files have them: faces with any number of corners.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

struct PolygonMesh {
  std::vector<Point> points;
  std::vector<std::int32_t> corners;   ///< vertex numbers of face after face
  std::vector<std::size_t> face_ends;  ///< face f has the corners from face_ends[f-1] (0 for f = 0) to face_ends[f]
  std::vector<Attribute> attributes;   ///< Domain::corner: one tuple per entry of `corners`; face: one per face
  std::vector<FileLink> links;
  NumberType position_type = NumberType::float32;  ///< float64: the points are more than floats with rounding
  std::optional<double> metres_per_unit = {};      ///< as in TriangleMesh

  std::size_t face_count() const { return face_ends.size(); }
  std::size_t face_begin(std::size_t f) const { return f == 0 ? 0 : face_ends[f - 1]; }
  std::size_t face_size(std::size_t f) const { return face_ends[f] - face_begin(f); }
  /// Closes the face whose corners were appended to `corners`.
  void end_face() { face_ends.push_back(corners.size()); }

  /// The attribute of that name, or nullptr.
  const Attribute* find(std::string_view name) const;
  Attribute* find(std::string_view name);
  /// Replaces an attribute of the same name.
  void set(Attribute attribute);
};

/// A shape as its file has it, before it was cut into triangles and repaired.
struct SourceShape {
  PolygonMesh polygons;
  std::vector<std::int32_t> vertex;  ///< per corner of the polygons: the vertex of the repaired mesh, -1 for none
};

/// The file's own polygons with what has become of the repaired mesh: its points, and its attributes at the vertices,
/// which replace those of the same names. What a vertex of the file gets from several vertices that differ sits at its
/// corners; a vertex that is in no face stays where it is, with attributes 0. Normals of the file follow points that
/// moved, as sharp and as smooth as they were.
PolygonMesh as_in_file(const SourceShape& source, const TriangleMesh& mesh);

/// The same mesh; every face has three corners.
PolygonMesh polygons_of(const TriangleMesh& mesh);

}  // namespace pelage
