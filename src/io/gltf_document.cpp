#include "io/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/named_files.h"
#include "io/file_bytes.h"
#include "io/gltf_meshoptimizer.h"
#include "io/text_scanner.h"
#include "pelage/error.h"

namespace pelage {

namespace {

constexpr std::size_t header_size = 12, chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // "JSON", "BIN\0"

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// "mesh" for "meshes", as messages have it.
std::string singular(std::string_view kind) {
  if (kind == "meshes") return "mesh";
  if (kind == "bufferViews") return "buffer view";
  return std::string(kind.substr(0, kind.size() - 1));
}

/// Whole numbers that a double holds exactly are enough for all sizes.
std::optional<std::size_t> whole(const GltfJson& value) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_float()) return {};
  const double x = value.get<double>();
  constexpr double most = 9007199254740992;  // 2^53
  return x >= 0 && x <= most && x == std::floor(x) ? std::optional(static_cast<std::size_t>(x)) : std::nullopt;
}

std::string place_in(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ", column " +
         std::to_string(before.size() - line_start + 1);
}

}  // namespace

std::optional<std::string> from_base64(std::string_view text) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t group = 0;
  int bits = 0;
  for (char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) return {};
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255);
  }
  return bytes;
}

std::string as_utf8(const std::string& text) {
  return GltfJson::parse(GltfJson(text).dump(-1, ' ', false, GltfJson::error_handler_t::replace)).get<std::string>();
}

std::string from_percent_encoding(std::string_view uri) {
  const auto digit = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    text += coded ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return text;
}

GltfDocument::GltfDocument(std::string_view bytes, std::string path) : path_(std::move(path)), size_(bytes.size()) {
  if (bytes.starts_with("glTF"))
    open_binary(bytes);
  else
    parse(bytes);
  check_version();
}

void GltfDocument::fail(const std::string& message) const { throw Error(Fault::input, message, {path_}); }

void GltfDocument::open_binary(std::string_view bytes) {
  if (bytes.size() < header_size + chunk_header_size) fail("is no valid glTF file: it ends within its header");
  if (const std::uint32_t version = word_at(bytes, 4); version != 2)
    fail("is a GLB file of version " + std::to_string(version) + "; export it as glTF 2.0");
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size())
    fail("is no valid glTF file: it is cut short, with " + std::to_string(bytes.size()) + " of " +
         std::to_string(length) + " bytes");
  bytes = bytes.substr(0, length);
  std::string_view text;
  for (std::size_t at = header_size; at + chunk_header_size <= bytes.size();) {
    const std::size_t size = word_at(bytes, at), start = at + chunk_header_size;
    if (size > bytes.size() - start) fail("is no valid glTF file: a chunk reaches beyond its end");
    const std::uint32_t type = word_at(bytes, at + 4);
    if (at == header_size && type == json_chunk) text = bytes.substr(start, size);
    if (type == binary_chunk && !chunk_) chunk_ = bytes.substr(start, size);
    at = start + size;
  }
  parse(text);
}

void GltfDocument::parse(std::string_view text) {
  while (text.ends_with('\0')) text.remove_suffix(1);  // some exporters fill up with them instead of spaces
  try {
    root_ = GltfJson::parse(text);
  } catch (const GltfJson::parse_error& error) {
    fail("is no valid glTF file: its JSON is damaged at " + place_in(text, error.byte));
  } catch (const GltfJson::out_of_range&) {
    fail("is no valid glTF file: its JSON has a number that is too large");
  }
  if (!root_.is_object()) fail("is no valid glTF file: its JSON is no object");
}

void GltfDocument::check_version() const {
  const GltfJson* asset = find(root_, "asset");
  const std::string version = asset ? text(*asset, "version") : "";
  const std::string least = asset ? text(*asset, "minVersion") : "";
  if (version.empty()) fail("is no valid glTF file: it has no asset with a version");
  if (!version.starts_with("2.") || (!least.empty() && least != "2.0"))
    fail("is glTF " + (least.empty() ? version : least) + "; only glTF 2.0 can be read, export it as that");
}

// --- JSON -----------------------------------------------------------------------------------------------

const GltfJson* GltfDocument::find(const GltfJson& object, const char* key) const {
  if (!object.is_object()) return nullptr;
  const auto member = object.find(key);
  return member == object.end() || member->is_null() ? nullptr : &*member;
}

const GltfJson* GltfDocument::extension(const GltfJson& object, const char* name) const {
  const GltfJson* all = find(object, "extensions");
  return all ? find(*all, name) : nullptr;
}

std::size_t GltfDocument::count(const char* kind) const {
  const GltfJson* all = find(root_, kind);
  return all && all->is_array() ? all->size() : 0;
}

const GltfJson& GltfDocument::get(const char* kind, std::size_t i) const {
  if (i >= count(kind)) fail(singular(kind) + " " + std::to_string(i) + " does not exist");
  const GltfJson& element = root_[kind][i];
  if (!element.is_object()) fail(singular(kind) + " " + std::to_string(i) + " is no object");
  return element;
}

std::string GltfDocument::label(const char* kind, std::size_t i) const {
  const std::string name = text(get(kind, i), "name");
  return singular(kind) + " " + (name.empty() ? std::to_string(i) : "\"" + name + "\"");
}

std::optional<std::size_t> GltfDocument::index(const GltfJson& object, const char* key) const {
  const GltfJson* value = find(object, key);
  if (!value) return {};
  const std::optional<std::size_t> n = whole(*value);
  if (!n) fail(std::string("\"") + key + "\" is no whole number from 0");
  return n;
}

std::string GltfDocument::text(const GltfJson& object, const char* key) const {
  const GltfJson* value = find(object, key);
  return value && value->is_string() ? value->get<std::string>() : "";
}

double GltfDocument::number(const GltfJson& object, const char* key, double otherwise) const {
  const GltfJson* value = find(object, key);
  if (!value) return otherwise;
  if (!value->is_number()) fail(std::string("\"") + key + "\" is no number");
  return value->get<double>();
}

bool GltfDocument::flag(const GltfJson& object, const char* key) const {
  const GltfJson* value = find(object, key);
  return value && value->is_boolean() && value->get<bool>();
}

std::vector<double> GltfDocument::numbers(const GltfJson& object, const char* key, std::size_t size) const {
  const GltfJson* value = find(object, key);
  if (!value) return {};
  const auto is_number = [](const GltfJson& x) { return x.is_number(); };
  if (!value->is_array() || (size > 0 && value->size() != size) ||
      !std::all_of(value->begin(), value->end(), is_number))
    fail(std::string("\"") + key + "\" is no list of " + (size > 0 ? std::to_string(size) + " " : "") + "numbers");
  return value->get<std::vector<double>>();
}

std::vector<std::size_t> GltfDocument::indices(const GltfJson& object, const char* key) const {
  const GltfJson* value = find(object, key);
  std::vector<std::size_t> result;
  if (!value) return result;
  if (!value->is_array()) fail(std::string("\"") + key + "\" is no list");
  for (const GltfJson& element : *value) {
    const std::optional<std::size_t> n = whole(element);
    if (!n) fail(std::string("\"") + key + "\" is no list of whole numbers from 0");
    result.push_back(*n);
  }
  return result;
}

std::vector<std::string> GltfDocument::texts(const GltfJson& object, const char* key) const {
  const GltfJson* value = find(object, key);
  std::vector<std::string> result;
  if (value && value->is_array())
    for (const GltfJson& element : *value)
      if (element.is_string()) result.push_back(element.get<std::string>());
  return result;
}

// --- buffers --------------------------------------------------------------------------------------------

bool GltfDocument::has_data(std::size_t i) const {
  return !text(get("buffers", i), "uri").empty() || (i == 0 && chunk_);
}

std::string GltfDocument::load(const std::string& uri, const std::string& label) const {
  if (uri.starts_with("data:")) {
    const std::string_view base64 = ";base64,";
    const std::size_t comma = uri.find(base64);
    auto bytes =
        comma == std::string::npos ? std::nullopt : from_base64(std::string_view(uri).substr(comma + base64.size()));
    if (!bytes) fail(label + " has data that are no base64");
    return *std::move(bytes);
  }
  if (uri.find("://") != std::string::npos) fail(label + " is at " + uri + "; only files beside this one can be read");
  const std::string name = from_percent_encoding(uri);
  if (!may_read_beside(path_, name)) fail(label + " is at " + in_quotes(uri) + ", " + outside_hint);
  const std::string file = path_beside(path_, name);
  std::error_code code;  // a device or a pipe may never end
  if (std::filesystem::exists(file, code) && !std::filesystem::is_regular_file(file, code))
    fail(label + " is at " + in_quotes(uri) + ", which is no file");
  return read_file(file);
}

std::string_view GltfDocument::buffer(std::size_t i) {
  const GltfJson& json = get("buffers", i);
  const std::string label = "buffer " + std::to_string(i), uri = text(json, "uri");
  if (!has_data(i)) fail(label + " has no data");
  if (!uri.empty() && !buffers_.contains(i)) {
    buffers_[i] = load(uri, label);
    size_ += buffers_[i].size();
  }
  const std::string_view bytes = uri.empty() ? *chunk_ : std::string_view(buffers_[i]);
  const std::size_t length = index(json, "byteLength").value_or(bytes.size());
  if (length > bytes.size())
    fail(label + " has " + std::to_string(bytes.size()) + " of " + std::to_string(length) +
         " bytes; it is cut short or damaged");
  return bytes.substr(0, length);
}

std::string_view GltfDocument::range(std::size_t i, std::size_t offset, std::size_t length, const std::string& whose) {
  const std::string_view bytes = buffer(i);
  if (offset > bytes.size() || length > bytes.size() - offset) fail(whose + " lies beyond its buffer");
  return bytes.substr(offset, length);
}

std::string GltfDocument::image(std::size_t i) {
  const GltfJson& json = get("images", i);
  const std::string uri = text(json, "uri"), label = "image " + std::to_string(i);
  if (!uri.empty()) return load(uri, label);
  const auto bytes = index(json, "bufferView");
  if (!bytes) fail(label + " has no data");
  return std::string(view(*bytes));
}

std::string_view GltfDocument::view(std::size_t i) {
  if (const auto known = unpacked_.find(i); known != unpacked_.end()) return known->second;
  const GltfJson& json = get("bufferViews", i);
  const std::size_t source = index(json, "buffer").value_or(0), length = index(json, "byteLength").value_or(0);
  const std::string label = "buffer view " + std::to_string(i);
  if (const char* name = meshopt_extension(*this, json); name && !has_data(source))
    return unpacked_[i] = unpack_meshopt(*this, json, name, label);
  return range(source, index(json, "byteOffset").value_or(0), length, label);
}

}  // namespace pelage
