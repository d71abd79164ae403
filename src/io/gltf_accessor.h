#pragma once
// The arrays of a glTF file, with every bound checked.

#include <cstddef>
#include <cstdint>
#include <string>

namespace tinygltf {
class Model;
}

namespace pelage {

/// One accessor: `count` tuples of `components` numbers, stored in any of glTF's component types.
class GltfAccessor {
 public:
  /// Throws Error(Fault::input), with `path` and the accessor's number, if the accessor does not exist, is sparse
  /// or compressed, or reaches beyond its buffer.
  GltfAccessor(const tinygltf::Model& model, int accessor, const std::string& path);

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  /// Component k of tuple i; normalised integers become 0..1 or -1..1.
  double value(std::size_t i, int k) const;
  /// Tuple i as an unsigned integer, for indices.
  std::uint32_t index(std::size_t i) const;

 private:
  template <class T>
  T raw(std::size_t i, int k) const;

  const unsigned char* data_ = nullptr;
  std::size_t count_ = 0, stride_ = 0;
  int components_ = 1, type_ = 0;
  bool normalized_ = false;
};

}  // namespace pelage
