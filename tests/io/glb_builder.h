#pragma once
// Small GLB files by hand: arrays as they are given, the JSON around them as text.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace pelage::test {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A GLB file of a JSON text and the bytes of its buffer.
inline std::string glb(std::string json, std::string data) {
  while (json.size() % 4) json += ' ';
  while (data.size() % 4) data += '\0';
  auto word = [](std::size_t n) {
    const auto small = static_cast<std::uint32_t>(n);
    return std::string(reinterpret_cast<const char*>(&small), 4);
  };
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" + json +
         word(data.size()) + std::string("BIN\0", 4) + data;
}

class GlbBuilder {
 public:
  /// Returns the number of the buffer view.
  int view(const std::string& bytes, const std::string& more = "") {
    while (data_.size() % 4) data_ += '\0';
    views_ += (views_.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") + std::to_string(data_.size()) +
              R"(,"byteLength":)" + std::to_string(bytes.size()) + more + "}";
    data_ += bytes;
    return view_count_++;
  }
  /// `more` are further members, each with a comma in front. Returns the number of the accessor.
  int accessor(const std::string& type, int component_type, std::size_t count, const std::string& more) {
    accessors_ += (accessors_.empty() ? "" : ",") + std::string(R"({"type":")") + type + R"(","componentType":)" +
                  std::to_string(component_type) + R"(,"count":)" + std::to_string(count) + more + "}";
    return accessor_count_++;
  }
  /// An accessor with a view of its own.
  template <class T>
  int array(const std::string& type, const std::vector<T>& values, const std::string& more = "") {
    static const std::vector<std::pair<std::string, std::size_t>> widths = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    std::size_t width = 1;
    for (const auto& [name, n] : widths)
      if (name == type) width = n;
    const int bytes = view(bytes_of(values));
    return accessor(type, component_type<T>(), values.size() / width,
                    ",\"bufferView\":" + std::to_string(bytes) + more);
  }

  /// The file; `members` are those of the JSON beside arrays and asset: "nodes":..., "meshes":...
  std::string file(const std::string& members) const {
    return glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(data_.size()) +
                   R"(}],"bufferViews":[)" + views_ + R"(],"accessors":[)" + accessors_ + "]," + members + "}",
               data_);
  }
  /// The file of one mesh in one node, with these members of its primitive.
  std::string file_of(const std::string& primitive, const std::string& more = "") const {
    return file(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + primitive + "}]}]" + more);
  }

 private:
  template <class T>
  static int component_type() {
    if constexpr (std::is_same_v<T, float>) return 5126;
    if constexpr (std::is_same_v<T, double>) return 5130;
    constexpr int unsigned_type = std::is_unsigned_v<T> ? 1 : 0;
    return sizeof(T) == 1 ? 5120 + unsigned_type : sizeof(T) == 2 ? 5122 + unsigned_type : 5124 + unsigned_type;
  }

  std::string data_, views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

}  // namespace pelage::test
