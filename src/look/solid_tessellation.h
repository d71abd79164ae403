#pragma once
// Coats in a volume that fills a surface, as samples on that surface.

#include "look/tessellation.h"

namespace pelage {

/// Whether it is a volume that fills a surface.
bool shows_surface(const std::shared_ptr<const NodeShape>& nodes);

/// The flat triangles of the surface, which keep their vertices first and lie where the surface has moved; edges
/// are split as far as the colours need, or all as often as asked. Between nodes fields are linear; where a sharp edge
/// reaches out of the volume they are those of the nearest place of its skin. `fields` has nodes, a volume that fills a
/// surface. Error(Fault::usage) for a detail that makes more than 30 million triangles.
Tessellation tessellate_solid(const CoatFields& fields, const TessellationRequest& request);

}  // namespace pelage
