#pragma once
// What a coat is like beside its colour (pelage/channel.h), as a material of glTF: one number for all places, except
// for the opacity, which goes with the colours.

#include <optional>
#include <string>

#include "pelage/texture_maps.h"
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

/// Of emission with an image: what white texels give. At most 1 is glTF's own.
void set_emission_strength(tinygltf::Model& model, tinygltf::Material& material, double strength);

/// A texture whose red is the transmission and whose green is the thickness, where there is one, as a share of the
/// deepest.
void set_glass(tinygltf::Model& model, tinygltf::Material& material, int texture, std::optional<double> deepest);

/// Takes away what textures hold: colours, channels that are images, and heights that are normals.
void erase_imaged(std::vector<Attribute>& attributes, const TextureMaps& maps);

/// What viewers will not see of an attribute, or "": "how material_roughness differs from place to place".
std::string unseen_in_gltf(const Attribute& attribute);

}  // namespace pelage
