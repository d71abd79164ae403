#include "io/gltf_draco.h"

#ifdef PELAGE_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <cstring>
#include <memory>
#include <utility>
#endif

namespace pelage {

namespace {

[[noreturn]] void refuse(const GltfDocument& document, const std::string& label, const std::string& why) {
  document.fail(label + " is compressed with Draco (KHR_draco_mesh_compression), " + why +
                "; export without compression");
}

}  // namespace

#ifdef PELAGE_HAS_DRACO

namespace {

std::vector<std::uint32_t> corners_of(const draco::Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * static_cast<std::size_t>(mesh.num_faces()));
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& p : mesh.face(f)) corners.push_back(p.value());
  return corners;
}

/// A number as it is stored: Draco's own conversion would scale what the accessor scales.
double number_at(const std::uint8_t* at, draco::DataType type) {
  const auto read = [at](auto value) {
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  };
  switch (type) {
    case draco::DT_INT8:
      return read(std::int8_t{});
    case draco::DT_INT16:
      return read(std::int16_t{});
    case draco::DT_UINT16:
      return read(std::uint16_t{});
    case draco::DT_INT32:
      return read(std::int32_t{});
    case draco::DT_UINT32:
      return read(std::uint32_t{});
    case draco::DT_INT64:
      return read(std::int64_t{});
    case draco::DT_UINT64:
      return read(std::uint64_t{});
    case draco::DT_FLOAT32:
      return read(float{});
    case draco::DT_FLOAT64:
      return read(double{});
    default:
      return read(std::uint8_t{});
  }
}

/// Empty for values that cannot be read: Draco believes damaged files.
std::vector<double> values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components) {
  const std::size_t points = mesh.num_points(),
                    size = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
  if (attribute.num_components() != components || attribute.data_type() == draco::DT_INVALID) return {};
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < points) return {};
  std::vector<double> values;
  values.reserve(points * static_cast<std::size_t>(components));
  for (std::uint32_t p = 0; p < points; ++p) {
    const std::int64_t start = attribute.GetBytePos(attribute.mapped_index(draco::PointIndex(p)));
    const std::size_t end = static_cast<std::size_t>(start) + size * static_cast<std::size_t>(components);
    if (start < 0 || end > attribute.buffer()->data_size()) return {};
    for (int k = 0; k < components; ++k)
      values.push_back(
          number_at(attribute.buffer()->data() + start + size * static_cast<std::size_t>(k), attribute.data_type()));
  }
  return values;
}

}  // namespace

DracoMesh unpack_draco(GltfDocument& document, const GltfJson& extension, const std::map<std::string, int>& components,
                       const std::string& label) {
  const std::string_view packed = document.view(document.index(extension, "bufferView").value_or(0));
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) refuse(document, label, "and its data cannot be decoded");
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  DracoMesh result;
  result.corners = corners_of(*mesh);
  const GltfJson* names = document.find(extension, "attributes");
  for (const auto& [name, width] : components) {
    const auto id = names ? document.index(*names, name.c_str()) : std::nullopt;
    if (!id) continue;
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(*id));
    std::vector<double> values = attribute ? values_of(*mesh, *attribute, width) : std::vector<double>();
    if (values.empty()) refuse(document, label, "and its " + name + " cannot be decoded");
    result.attributes[name] = std::move(values);
  }
  return result;
}

#else

DracoMesh unpack_draco(GltfDocument& document, const GltfJson&, const std::map<std::string, int>&,
                       const std::string& label) {
  refuse(document, label, "which this build cannot decode");
}

#endif

}  // namespace pelage
