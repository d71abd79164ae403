#pragma once
// What a coat is like beside its colour (pelage/channel.h), as a material of glTF: one number for all places, except
// for the opacity, which goes with the colours.

#include <string>

#include "pelage/triangle_mesh.h"

namespace tinygltf {
class Model;
struct Material;
}  // namespace tinygltf

namespace pelage {

/// The mean of what the mesh says of each channel, usual values where it says nothing. Transmission, thickness and
/// emission above 1 are Khronos' extensions, which the model is told of; emission has the mean of its colour. A mesh
/// with opacity below 1 makes the material blend.
void set_coat(const TriangleMesh& mesh, tinygltf::Model& model, tinygltf::Material& material);

/// The mesh with its opacity as the fourth component of its colours, and without the channels that `set_coat` has said
/// all of.
TriangleMesh without_told_channels(TriangleMesh mesh);

/// Takes away what textures hold: colours, and the channels that are images.
void erase_imaged(std::vector<Attribute>& attributes);

/// What viewers will not see of an attribute, or "": "how material_roughness differs from place to place".
std::string unseen_in_gltf(const Attribute& attribute);

}  // namespace pelage
