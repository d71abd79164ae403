#include "io/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

#include "pelage/error.h"

namespace pelage {

GltfAccessor::GltfAccessor(const tinygltf::Model& model, int accessor, const std::string& path) {
  auto fail = [&](const std::string& why) {
    throw Error(Fault::input, "glTF accessor " + std::to_string(accessor) + " " + why, {path});
  };
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) fail("does not exist");
  const tinygltf::Accessor& a = model.accessors[accessor];
  if (a.sparse.isSparse) fail("is sparse, which is not supported; export without sparse accessors");
  if (a.bufferView < 0) fail("has no data (compressed?); export without mesh compression");
  if (static_cast<std::size_t>(a.bufferView) >= model.bufferViews.size()) fail("refers to a missing buffer view");
  const tinygltf::BufferView& view = model.bufferViews[a.bufferView];
  if (view.extensions.contains("EXT_meshopt_compression")) fail("is compressed; export without mesh compression");
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    fail("refers to a missing buffer");
  const std::vector<unsigned char>& bytes = model.buffers[view.buffer].data;
  const int stride = a.ByteStride(view);
  components_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
  if (stride <= 0 || components_ <= 0 || size <= 0) fail("has an impossible type or stride");
  stride_ = stride;
  count_ = a.count;
  type_ = a.componentType;
  normalized_ = a.normalized;

  const std::size_t tuple = static_cast<std::size_t>(components_) * size;
  const std::size_t length = bytes.size();
  if (view.byteOffset > length || view.byteLength > length - view.byteOffset) fail("lies beyond its buffer");
  if (a.byteOffset > view.byteLength) fail("lies beyond its buffer view");
  const std::size_t room = view.byteLength - a.byteOffset;
  if (count_ > 0 && (tuple > room || count_ - 1 > (room - tuple) / stride_))
    fail("promises more values than the file holds");
  data_ = bytes.data() + view.byteOffset + a.byteOffset;
}

template <class T>
T GltfAccessor::raw(std::size_t i, int k) const {
  T value;
  std::memcpy(&value, data_ + i * stride_ + k * sizeof(T), sizeof(T));
  return value;
}

double GltfAccessor::value(std::size_t i, int k) const {
  const auto scaled = [&](double x, double most) { return normalized_ ? std::max(x / most, -1.0) : x; };
  switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return raw<float>(i, k);
    case TINYGLTF_COMPONENT_TYPE_DOUBLE:
      return raw<double>(i, k);
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(raw<std::int8_t>(i, k), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(raw<std::uint8_t>(i, k), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(raw<std::int16_t>(i, k), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(raw<std::uint16_t>(i, k), 65535);
    case TINYGLTF_COMPONENT_TYPE_INT:
      return raw<std::int32_t>(i, k);
    default:
      return raw<std::uint32_t>(i, k);
  }
}

std::uint32_t GltfAccessor::index(std::size_t i) const {
  switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return raw<std::uint8_t>(i, 0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return raw<std::uint16_t>(i, 0);
    default:
      return raw<std::uint32_t>(i, 0);
  }
}

}  // namespace pelage
