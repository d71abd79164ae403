#pragma once
// One part of a glTF mesh: its arrays, compressed or not, with morph targets added.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_draco.h"
#include "pelage/point.h"

namespace pelage {

enum class GltfMode { triangles = 4, strip = 5, fan = 6 };

class GltfPrimitive {
 public:
  /// Error(Fault::input), beginning with `label`, for arrays that are missing or of the wrong type.
  GltfPrimitive(GltfDocument& document, const GltfJson& json, std::string label);

  std::size_t vertices() const { return positions_->count(); }
  /// The names of its attributes.
  const std::map<std::string, std::size_t>& attributes() const { return attributes_; }
  /// One of them: Error(Fault::input) unless it has a tuple for each vertex.
  GltfAccessor attribute(const std::string& name) const;
  /// Per morph target its change of an attribute; nullopt where it has none.
  std::vector<std::optional<GltfAccessor>> changes(const std::string& name) const;

  /// Vertex numbers of its triangles, which are less than vertices(). The degenerate triangles that join strips are
  /// left out. `left_over` counts the corners behind the last triangle.
  std::vector<std::uint32_t> triangles(std::size_t& left_over) const;

  const std::string& label() const { return label_; }
  std::optional<std::size_t> material() const { return document_.index(json_, "material"); }

 private:
  std::map<std::string, std::size_t> names_of(const GltfJson& object) const;
  void unpack();
  std::vector<std::uint32_t> corners() const;

  GltfDocument& document_;
  const GltfJson& json_;
  std::string label_;
  std::map<std::string, std::size_t> attributes_;
  std::optional<DracoMesh> draco_;
  std::optional<GltfAccessor> positions_;
};

/// Whether the primitive has triangles, not points or lines.
bool has_triangles(const GltfDocument& document, const GltfJson& primitive);

}  // namespace pelage
