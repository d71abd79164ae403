#pragma once
// GLB files taken apart and put together: their JSON and their binary chunk.

#include <nlohmann/json.hpp>
#include <string>

namespace pelage {

using GltfText = nlohmann::ordered_json;

struct GlbChunks {
  GltfText json;
  std::string bytes;
};

/// Of a file that encode_glb() gives.
GlbChunks glb_chunks(const std::string& glb);

std::string glb_of(const GlbChunks& chunks);

/// To a length that is a multiple of four.
void fill_to_whole(std::string& bytes, char with);

}  // namespace pelage
