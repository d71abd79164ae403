#pragma once
// A surface with its fields as a mesh of samples: as fine as the colours need. What takes time is done here once; the
// samples can then be painted again and again.

#include "discretise/coat_fields.h"
#include "look/palette.h"

namespace pelage {

struct Tessellation {
  std::vector<Triangle> triangles;
  CoatSamples samples;                           ///< at the vertices
  std::vector<Attribute> attributes;             ///< of the shape but for its normals
  std::vector<FileLink> links;                   ///< of the shape
  std::optional<double> metres_per_unit = {};    ///< of the shape
  bool sharp = false;                            ///< whether it is to have edges where triangles meet at large angles
  std::vector<Point> corner_normal = {};         ///< of surfaces with creases: at the corners of the triangles
  std::shared_ptr<const Topology> creased = {};  ///< and their connectivity
  std::vector<MeshPlace> on_mesh = {};  ///< of the samples on the mesh of the fields, if they have one of their own

  const Point& normal(std::size_t face, std::size_t corner) const {
    return corner_normal.empty() ? samples.normal[static_cast<std::size_t>(triangles[face][corner])]
                                 : corner_normal[3 * face + corner];
  }
};

/// Which tessellation a look asks for.
struct TessellationRequest {
  bool flat = false;               ///< the flat triangles of the shape with its vertices first and unmoved, every point
                                   ///< with the fields of the surface at the same barycentric coordinates
  std::optional<int> detail = {};  ///< how often every triangle is split into four; default: as the pattern needs
  bool curvature = false;          ///< whether the samples have any
  bool attributes = false;         ///< whether they have those of the shape and its textures
  bool operator==(const TessellationRequest&) const = default;
};

/// What a look says of the geometry alone, and with what its paint reads.
TessellationRequest tessellation_request(const Look& look);
TessellationRequest tessellation_request(const Look& look, const Paint& paint);

/// Error(Fault::usage) for a request that shapes whose nodes are what they are cannot fulfil.
void require_own_nodes(const TessellationRequest& request);

// What all tessellations have in common.

/// Without those that are made anew.
std::vector<Attribute> kept_attributes(std::vector<Attribute> attributes);
/// How often triangles of this edge are split for smooth colours, or as often as asked. Error(Fault::usage) for a
/// detail that makes more than 30 million triangles.
int levels_to_split(double edge, std::size_t triangles, double wavelength, const std::optional<int>& detail);
/// At most, where the run has `finest` triangles on a surface of `shape` triangles.
double most_tessellated(const TessellationRequest& request, double finest, double shape);
/// What formulas of layers read beside positions and fields; `shape` has the attributes of `t`.
void take_rest(const CoatFields& fields, const TriangleMesh& shape, const TessellationRequest& request,
               Tessellation& t);

/// Of a volume that fills a surface, this surface. Error(Fault::usage) for a detail that needs more than 30 million
/// triangles.
Tessellation tessellate(const CoatFields& fields, const TessellationRequest& request);

/// The nodes of a shape whose nodes are what they are, with its triangles, of a volume those of the skin. The same
/// errors.
Tessellation tessellate_nodes(const CoatFields& fields, const TessellationRequest& request);
/// Their samples alone.
CoatSamples samples_at_nodes(const CoatFields& fields, const TessellationRequest& request);

}  // namespace pelage
