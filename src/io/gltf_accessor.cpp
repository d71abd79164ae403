#include "io/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace pelage {

namespace {

enum ComponentType { int8 = 5120, uint8, int16, uint16, int32, uint32, float32, float64 = 5130 };

std::size_t size_of(int type) {
  switch (type) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case int32:
    case uint32:
    case float32:
      return 4;
    default:
      return type == float64 ? 8 : 0;
  }
}

/// What 1 is stored as in normalised integers.
double largest(int type) {
  switch (type) {
    case int8:
      return 127;
    case uint8:
      return 255;
    case int16:
      return 32767;
    case uint16:
      return 65535;
    case int32:
      return 2147483647;
    default:
      return type == uint32 ? 4294967295 : 1;
  }
}

struct Form {
  const char* name;
  int rows, columns;
};
constexpr Form forms[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1}, {"VEC4", 4, 1},
                          {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

template <class T>
T read(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

double read_number(const char* at, int type) {
  switch (type) {
    case int8:
      return read<std::int8_t>(at);
    case uint8:
      return read<std::uint8_t>(at);
    case int16:
      return read<std::int16_t>(at);
    case uint16:
      return read<std::uint16_t>(at);
    case int32:
      return read<std::int32_t>(at);
    case uint32:
      return read<std::uint32_t>(at);
    case float32:
      return read<float>(at);
    default:
      return read<double>(at);
  }
}

std::uint32_t read_index(const char* at, int type) {
  if (type == uint8) return read<std::uint8_t>(at);
  return type == uint16 ? read<std::uint16_t>(at) : read<std::uint32_t>(at);
}

bool is_index_type(int type) { return type == uint8 || type == uint16 || type == uint32; }

constexpr std::array<char, 16 * 8> zeros{};  // the largest tuple

}  // namespace

bool has_plain_data(const GltfDocument& document, std::size_t accessor) {
  const GltfJson& json = document.get("accessors", accessor);
  return document.find(json, "bufferView") || document.find(json, "sparse");
}

GltfAccessor::GltfAccessor(GltfDocument& document, std::size_t accessor)
    : document_(document), label_("accessor " + std::to_string(accessor)) {
  const GltfJson& json = document.get("accessors", accessor);
  read_type(json);
  count_ = document.index(json, "count").value_or(0);
  const GltfJson* sparse = document.find(json, "sparse");
  if (const auto view = document.index(json, "bufferView")) {
    const std::string_view bytes = document.view(*view);
    const std::size_t offset = document.index(json, "byteOffset").value_or(0);
    if (offset > bytes.size()) document.fail(label_ + " lies beyond its buffer view");
    const GltfJson& view_json = document.get("bufferViews", *view);
    lay_out(bytes.substr(offset), document.index(view_json, "byteStride").value_or(size_), "");
  } else if (!sparse && count_ > 0) {
    document.fail(label_ + " has no data");
  } else if (count_ > document.most_values()) {  // zeros cost nothing in a file but memory here
    document.fail(label_ + " promises " + std::to_string(count_) + " values without data");
  }
  if (sparse) read_sparse(*sparse);
}

GltfAccessor::GltfAccessor(GltfDocument& document, std::size_t accessor, std::vector<double> values)
    : document_(document), label_("accessor " + std::to_string(accessor)), decoded_(std::move(values)) {
  read_type(document.get("accessors", accessor));
  count_ = decoded_.size() / static_cast<std::size_t>(components_);
}

void GltfAccessor::read_type(const GltfJson& json) {
  const std::string name = document_.text(json, "type");
  const auto* form = std::find_if(std::begin(forms), std::end(forms), [&](const Form& f) { return f.name == name; });
  type_ = static_cast<int>(std::min<std::size_t>(document_.index(json, "componentType").value_or(0), 9999));
  const std::size_t size = size_of(type_);
  if (form == std::end(forms) || size == 0) document_.fail(label_ + " has a type that glTF does not know");
  rows_ = form->rows;
  components_ = form->rows * form->columns;
  column_ = static_cast<std::size_t>(rows_) * size;
  if (form->columns > 1) column_ = (column_ + 3) / 4 * 4;  // columns of matrices begin at multiples of four bytes
  size_ = column_ * static_cast<std::size_t>(form->columns);
  normalized_ = document_.flag(json, "normalized");
}

void GltfAccessor::lay_out(std::string_view bytes, std::size_t stride, const std::string& what) {
  if (stride == 0) stride = size_;
  if (count_ > 0 && (size_ > bytes.size() || count_ - 1 > (bytes.size() - size_) / stride))
    document_.fail(label_ + " promises more values than the file holds" + what);
  base_ = bytes;
  stride_ = stride;
}

void GltfAccessor::read_sparse(const GltfJson& sparse) {
  const GltfJson *indices = document_.find(sparse, "indices"), *values = document_.find(sparse, "values");
  if (!indices || !values) document_.fail(label_ + " is sparse but has no indices or values");
  const std::size_t n = document_.index(sparse, "count").value_or(0);
  const auto part = [&](const GltfJson& json, std::size_t size) {
    const std::string_view bytes = document_.view(document_.index(json, "bufferView").value_or(0));
    const std::size_t offset = document_.index(json, "byteOffset").value_or(0);
    if (offset > bytes.size() || n > (bytes.size() - offset) / size)
      document_.fail(label_ + " promises more sparse values than the file holds");
    return bytes.substr(offset, n * size);
  };
  const int type =
      static_cast<int>(std::min<std::size_t>(document_.index(*indices, "componentType").value_or(0), 9999));
  if (!is_index_type(type)) document_.fail(label_ + " has sparse indices of a type that glTF does not allow");
  const std::string_view numbers = part(*indices, size_of(type));
  sparse_values_ = part(*values, size_);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t place = read_index(numbers.data() + i * size_of(type), type);
    if (place >= count_ || (i > 0 && place <= sparse_indices_.back()))
      document_.fail(label_ + " has sparse indices that do not rise or are too large");
    sparse_indices_.push_back(place);
  }
}

const char* GltfAccessor::tuple(std::size_t i) const {
  if (!sparse_indices_.empty()) {
    const auto place = std::lower_bound(sparse_indices_.begin(), sparse_indices_.end(), i);
    if (place != sparse_indices_.end() && *place == i)
      return sparse_values_.data() + static_cast<std::size_t>(place - sparse_indices_.begin()) * size_;
  }
  return base_.empty() ? zeros.data() : base_.data() + i * stride_;
}

bool GltfAccessor::is_unsigned() const { return components_ == 1 && is_index_type(type_) && !normalized_; }

NumberType GltfAccessor::number_type() const {
  if (type_ == float64) return NumberType::float64;
  if (normalized_) return NumberType::float32;
  switch (type_) {
    case int8:
      return NumberType::int8;
    case uint8:
      return NumberType::uint8;
    case int16:
      return NumberType::int16;
    case uint16:
      return NumberType::uint16;
    case int32:
      return NumberType::int32;
    default:
      return type_ == uint32 ? NumberType::uint32 : NumberType::float32;
  }
}

double GltfAccessor::value(std::size_t i, int k) const {
  const std::size_t offset =
      static_cast<std::size_t>(k / rows_) * column_ + static_cast<std::size_t>(k % rows_) * size_of(type_);
  const double x = decoded_.empty() ? read_number(tuple(i) + offset, type_)
                                    : decoded_[i * static_cast<std::size_t>(components_) + static_cast<std::size_t>(k)];
  return normalized_ ? std::max(x / largest(type_), -1.0) : x;
}

std::uint32_t GltfAccessor::index(std::size_t i) const { return read_index(tuple(i), type_); }

}  // namespace pelage
