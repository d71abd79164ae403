#include "io/gltf_chunks.h"

#include <cstdint>
#include <cstring>

namespace pelage {

namespace {

constexpr std::size_t file_header = 12, chunk_header = 8;

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t n;
  std::memcpy(&n, bytes.data() + at, sizeof n);
  return n;
}

void append_number(std::string& bytes, std::size_t n) {
  const auto number = static_cast<std::uint32_t>(n);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void append_chunk(std::string& file, const char* type, const std::string& chunk) {
  append_number(file, chunk.size());
  file.append(type, 4);
  file += chunk;
}

}  // namespace

void fill_to_whole(std::string& bytes, char with) { bytes.resize((bytes.size() + 3) / 4 * 4, with); }

GlbChunks glb_chunks(const std::string& glb) {
  const std::size_t json = file_header + chunk_header, length = number_at(glb, file_header);
  return {GltfText::parse(glb.substr(json, length)), glb.substr(json + length + chunk_header)};
}

std::string glb_of(const GlbChunks& chunks) {
  std::string json = chunks.json.dump(), bytes = chunks.bytes;
  fill_to_whole(json, ' ');
  fill_to_whole(bytes, '\0');
  std::string file = "glTF";
  append_number(file, 2);
  append_number(file, file_header + 2 * chunk_header + json.size() + bytes.size());
  append_chunk(file, "JSON", json);
  append_chunk(file, "BIN", bytes);
  return file;
}

}  // namespace pelage
