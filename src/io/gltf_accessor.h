#pragma once
// The arrays of a glTF file, with every bound checked.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_document.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// One accessor: `count` tuples of `components` numbers, stored in any of glTF's component types, whole or sparse.
class GltfAccessor {
 public:
  /// Throws Error(Fault::input), with the accessor's number, if the accessor does not exist or reaches beyond its
  /// buffer. The document must outlive the accessor.
  GltfAccessor(GltfDocument& document, std::size_t accessor);
  /// The same type, with values from elsewhere, tuple after tuple: whole numbers are those that the file would store.
  GltfAccessor(GltfDocument& document, std::size_t accessor, std::vector<double> values);

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  bool is_unsigned() const;
  /// As it is stored; float32 for normalised integers.
  NumberType number_type() const;
  /// Component k of tuple i; normalised integers become 0..1 or -1..1.
  double value(std::size_t i, int k) const;
  /// Tuple i as an unsigned integer, for indices: only where is_unsigned().
  std::uint32_t index(std::size_t i) const;

 private:
  void read_type(const GltfJson& json);
  void read_sparse(const GltfJson& sparse);
  void lay_out(std::string_view bytes, std::size_t stride, const std::string& what);
  const char* tuple(std::size_t i) const;

  GltfDocument& document_;
  std::string label_;
  std::string_view base_;  // empty: all zero
  std::size_t count_ = 0, stride_ = 0, size_ = 0;
  int components_ = 1, type_ = 0, rows_ = 1;
  std::size_t column_ = 0;  // from one column of a matrix to the next, bytes
  bool normalized_ = false;
  std::vector<std::uint32_t> sparse_indices_;  // rising
  std::string_view sparse_values_;
  std::vector<double> decoded_;
};

/// Whether the data of an accessor are in the file as they are, not in a compressed mesh only.
bool has_plain_data(const GltfDocument& document, std::size_t accessor);

}  // namespace pelage
