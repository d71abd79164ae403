#include "io/gltf_meshoptimizer.h"

#ifdef PELAGE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <limits>

namespace pelage {

const char* meshopt_extension(const GltfDocument& document, const GltfJson& view) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (document.extension(view, name)) return name;
  return nullptr;
}

namespace {

[[noreturn]] void refuse(const GltfDocument& document, const std::string& label, const char* extension,
                         const std::string& why) {
  document.fail(label + " is compressed with meshoptimizer (" + extension + ")" + why +
                "; export without mesh compression, for example with gltfpack without -c");
}

}  // namespace

#ifdef PELAGE_HAS_MESHOPTIMIZER

namespace {

struct Packed {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

bool is_index_mode(const std::string& mode) { return mode == "TRIANGLES" || mode == "INDICES"; }

/// What the decoders ask for; they assert it instead of checking.
bool is_valid(const Packed& p) {
  if (p.stride == 0 || p.count > std::numeric_limits<std::int32_t>::max() / p.stride) return false;
  if (is_index_mode(p.mode))
    return (p.stride == 2 || p.stride == 4) && p.filter == "NONE" && (p.mode == "INDICES" || p.count % 3 == 0);
  if (p.mode != "ATTRIBUTES" || p.stride % 4 != 0 || p.stride > 256) return false;
  if (p.filter == "OCTAHEDRAL") return p.stride == 4 || p.stride == 8;
  return p.filter == "NONE" || p.filter == "EXPONENTIAL" || (p.filter == "QUATERNION" && p.stride == 8);
}

/// The least bytes in which so many values can be packed: a group of 16 equal bytes takes 2 bits, a triangle one byte.
bool is_plausible(const Packed& p, std::size_t packed_size) {
  return p.mode == "ATTRIBUTES" ? p.count * p.stride / 64 <= packed_size : p.count / 3 <= packed_size;
}

bool decode(const Packed& p, std::string_view packed, char* out) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  if (p.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(out, p.count, p.stride, bytes, packed.size()) == 0;
  if (p.mode == "INDICES") return meshopt_decodeIndexSequence(out, p.count, p.stride, bytes, packed.size()) == 0;
  if (meshopt_decodeVertexBuffer(out, p.count, p.stride, bytes, packed.size()) != 0) return false;
  if (p.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out, p.count, p.stride);
  if (p.filter == "QUATERNION") meshopt_decodeFilterQuat(out, p.count, p.stride);
  if (p.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out, p.count, p.stride);
  return true;
}

}  // namespace

std::string unpack_meshopt(GltfDocument& document, const GltfJson& view, const char* extension,
                           const std::string& label) {
  const GltfJson& json = *document.extension(view, extension);
  Packed p{document.index(json, "count").value_or(0), document.index(json, "byteStride").value_or(0),
           document.text(json, "mode"), document.text(json, "filter")};
  if (p.filter.empty()) p.filter = "NONE";
  const std::string_view packed =
      document.range(document.index(json, "buffer").value_or(0), document.index(json, "byteOffset").value_or(0),
                     document.index(json, "byteLength").value_or(0), label);
  const std::size_t length = document.index(view, "byteLength").value_or(0);
  if (!is_valid(p) || !is_plausible(p, packed.size()) || p.count * p.stride < length)
    refuse(document, label, extension, " in a way that cannot be");
  std::string bytes(p.count * p.stride, '\0');
  if (!decode(p, packed, bytes.data())) refuse(document, label, extension, ", and its data cannot be decoded");
  bytes.resize(length);
  return bytes;
}

#else

std::string unpack_meshopt(GltfDocument& document, const GltfJson&, const char* extension, const std::string& label) {
  refuse(document, label, extension, ", which this build cannot decode");
}

#endif

}  // namespace pelage
