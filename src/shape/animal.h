#pragma once
// The demo's animal: a cub made of blobs.

#include "shape/isosurface.h"

namespace pelage {

/// A four-legged cub that looks along +x, stands on y = 0 and is about 2 long, as a function of space that is
/// negative inside: the sum of one smooth step per body part, minus one half. Twice continuously differentiable.
FieldValue animal_field(const Point& place);

/// The animal with about `vertices` vertices on the zero level of animal_field: closed, genus 0, oriented outward.
TriangleMesh animal(std::size_t vertices);

}  // namespace pelage
