#include "io/gltf_record.h"

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "io/bytes.h"

namespace pelage {

namespace {

using Json = nlohmann::json;

/// Integers beyond those of tinygltf become numbers with a point, which mean the same.
tinygltf::Value value_of(const Json& json) {
  if (json.is_string()) return tinygltf::Value(json.get<std::string>());
  if (json.is_array()) {
    tinygltf::Value::Array list;
    for (const Json& one : json) list.push_back(value_of(one));
    return tinygltf::Value(std::move(list));
  }
  if (json.is_object()) {
    tinygltf::Value::Object object;
    for (const auto& [key, one] : json.items()) object[key] = value_of(one);
    return tinygltf::Value(std::move(object));
  }
  const auto number = json.get<double>();
  const auto whole = static_cast<int>(std::min(number, 2147483647.0));
  return whole == number ? tinygltf::Value(whole) : tinygltf::Value(number);
}

/// The JSON of a GLB file is its first chunk.
std::string_view json_of(std::string_view bytes) {
  constexpr std::size_t head = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < head) return bytes;
  return bytes.substr(head, bytes_at<std::uint32_t>(bytes, 12).value_or(0));
}

}  // namespace

void set_record(tinygltf::Model& model, const std::string& text) {
  if (text.empty()) return;
  tinygltf::Value::Object extras;
  extras["pelage"] = value_of(Json::parse(text));
  model.asset.extras = tinygltf::Value(std::move(extras));
}

std::string record_in_gltf(std::string_view bytes) {
  // What is nested more deeply is nothing of ours, and would take the stack of who walks through it.
  constexpr int deepest = 16;
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth < deepest; };
  const Json json = Json::parse(json_of(bytes), shallow, false);
  const Json* at = &json;
  for (const char* key : {"asset", "extras", "pelage"}) {
    if (!at->is_object() || !at->contains(key)) return "";
    at = &(*at)[key];
  }
  return at->dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace pelage
