#pragma once
// Tessellations whose triangles are cut.

#include "look/tessellation.h"
#include "shape/cut_surface.h"

namespace pelage {

/// What samples have, at other places; vectors of unit length stay such.
CoatSamples samples_at(const CoatSamples& samples, const CutSurface& at);

/// All that a tessellation has, on what it was cut into.
Tessellation cut_tessellation(const Tessellation& t, const CutSurface& into);

/// Cut where layers of the paint begin and end within a triangle. Colours are linear between vertices: without vertices
/// there, sharp borders of layers would have the teeth of the triangles.
Tessellation cut_along_layers(Tessellation t, const Paint& paint);

/// Whether the vertices of a coat may be others than those of tessellate().
bool may_be_cut(const CoatFields& fields, const Look& look);

/// tessellate() for a paint, cut along its layers where that may be.
Tessellation tessellate_for(const CoatFields& fields, const Look& look, const Paint& paint);

}  // namespace pelage
