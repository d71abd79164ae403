#pragma once
// The container of a glTF file: its JSON and its buffers, with every type, number and bound checked.

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

using GltfJson = nlohmann::json;

class GltfDocument {
 public:
  /// `bytes` are a .glb or the text of a .gltf, whose other files are looked for beside `path`; they must outlive the
  /// document. All errors are Error(Fault::input) with `path`.
  GltfDocument(std::string_view bytes, std::string path);
  GltfDocument(const GltfDocument&) = delete;

  [[noreturn]] void fail(const std::string& message) const;

  const GltfJson& root() const { return root_; }
  /// The number of "nodes", "meshes", ...
  std::size_t count(const char* kind) const;
  /// One of them, an object.
  const GltfJson& get(const char* kind, std::size_t i) const;
  /// Its name, or its number: `node "arm"`, `node 3`.
  std::string label(const char* kind, std::size_t i) const;

  /// A member of an object, or nullptr.
  const GltfJson* find(const GltfJson& object, const char* key) const;
  /// An extension of an object, or nullptr.
  const GltfJson* extension(const GltfJson& object, const char* name) const;
  std::optional<std::size_t> index(const GltfJson& object, const char* key) const;
  std::string text(const GltfJson& object, const char* key) const;  ///< "" if absent
  double number(const GltfJson& object, const char* key, double otherwise) const;
  bool flag(const GltfJson& object, const char* key) const;
  /// So many numbers (any number of them for 0); empty if absent.
  std::vector<double> numbers(const GltfJson& object, const char* key, std::size_t size) const;
  std::vector<std::size_t> indices(const GltfJson& object, const char* key) const;
  std::vector<std::string> texts(const GltfJson& object, const char* key) const;

  /// More values than this are no more than promises: zeros that no buffer holds, and copies of copies. Grows with
  /// every buffer that is read.
  std::size_t most_values() const { return few_values + values_per_byte * size_; }

  /// The bytes of a buffer view, decompressed.
  std::string_view view(std::size_t i);
  /// A range of a buffer; `whose` begins the message when it lies beyond.
  std::string_view range(std::size_t buffer, std::size_t offset, std::size_t length, const std::string& whose);
  /// The bytes of an image, wherever they are.
  std::string image(std::size_t i);

 private:
  void open_binary(std::string_view bytes);
  void parse(std::string_view text);
  void check_version() const;
  bool has_data(std::size_t buffer) const;
  std::string_view buffer(std::size_t i);
  std::string load(const std::string& uri, const std::string& label) const;

  static constexpr std::size_t few_values = std::size_t{1} << 18, values_per_byte = 64;

  std::string path_;
  GltfJson root_;
  std::size_t size_ = 0;                         // of all that was read, bytes
  std::optional<std::string_view> chunk_;        // the binary part of a .glb
  std::map<std::size_t, std::string> buffers_;   // those that were loaded
  std::map<std::size_t, std::string> unpacked_;  // buffer views that were compressed
};

/// The bytes of base64 text; nothing for other text.
std::optional<std::string> from_base64(std::string_view text);

/// The same text with U+FFFD for bytes that are not UTF-8, which no JSON may hold.
std::string as_utf8(const std::string& text);

/// Spaces and other characters as they are: "a%20b" is "a b".
std::string from_percent_encoding(std::string_view uri);

}  // namespace pelage
