// The studio's engine as WebAssembly: what studio/engine-worker.js calls. One request at a time: room for its bytes,
// the answer, then the reply's bytes.

#include <cstddef>
#include <memory>
#include <string>

#include "base/memory.h"
#include "studio/engine.h"

#define PELAGE_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace {

std::string request, reply;

/// Of the 4 GB that WebAssembly can address, what a coat may take: the rest is for replies and what is in use.
constexpr double most_memory = 3e9;

pelage::StudioEngine& engine() {
  static pelage::StudioEngine one = [] {
    pelage::limit_memory(most_memory);
    return pelage::StudioEngine("wasm");
  }();
  return one;
}

}  // namespace

/// Where the bytes of a request belong.
PELAGE_EXPORT char* pelage_request(std::size_t size) {
  reply = {};
  request.resize(size);
  return request.data();
}

/// Answers it; the size of the reply.
PELAGE_EXPORT std::size_t pelage_handle() {
  reply = engine().handle(request);
  request = {};
  return reply.size();
}

/// Its bytes, there until the next request.
PELAGE_EXPORT const char* pelage_reply() { return reply.data(); }
