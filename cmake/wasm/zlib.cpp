// src/io/zlib.h by stb, which is headers alone. stb_image trusts streams more than libdeflate does; here the sandbox of
// WebAssembly is around it.

#include "io/zlib.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <new>

#include "pelage/error.h"

namespace pelage {

namespace {

const char* no_byte() { return ""; }

int length_of(std::string_view bytes) {
  constexpr std::size_t most = std::size_t{1} << 30;
  if (bytes.size() > most) throw Error(Fault::output, "a packed part of a file holds at most 1 GB; make it smaller");
  return static_cast<int>(bytes.size());
}

std::optional<std::string> unpacked(std::string_view stream, std::size_t size, bool header) {
  constexpr std::size_t most = 1032;  // bytes that deflate makes of one
  if (size / most > stream.size()) return {};
  std::string out(size, '\0');
  const int length = static_cast<int>(size), stored = length_of(stream);
  const int got = header ? stbi_zlib_decode_buffer(out.data(), length, stream.data(), stored)
                         : stbi_zlib_decode_noheader_buffer(out.data(), length, stream.data(), stored);
  if (got != length) return {};
  return out;
}

constexpr std::size_t header_bytes = 2, sum_bytes = 4;  // of zlib, around deflate

}  // namespace

std::string zlib_packed(std::string_view bytes) {
  constexpr int quality = 8;  // the least that stb has
  int length = 0;
  // It reads no byte of what is empty, but wants an address.
  auto* data = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.empty() ? no_byte() : bytes.data()));
  const std::unique_ptr<unsigned char, void (*)(void*)> packed(
      stbi_zlib_compress(data, length_of(bytes), &length, quality), std::free);
  if (!packed) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(packed.get()), static_cast<std::size_t>(length)};
}

std::string deflated(std::string_view bytes) {
  const std::string packed = zlib_packed(bytes);
  return packed.substr(header_bytes, packed.size() - header_bytes - sum_bytes);
}

std::optional<std::string> zlib_unpacked(std::string_view stream, std::size_t size) {
  return unpacked(stream, size, true);
}
std::optional<std::string> inflated(std::string_view stream, std::size_t size) { return unpacked(stream, size, false); }

std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < made.size(); ++i) {
      std::uint32_t rest = i;
      for (int bit = 0; bit < 8; ++bit) rest = rest >> 1 ^ (rest & 1 ? 0xedb88320u : 0u);
      made[i] = rest;
    }
    return made;
  }();
  std::uint32_t sum = ~0u;
  for (const char c : bytes) sum = sum >> 8 ^ table[(sum ^ static_cast<unsigned char>(c)) & 0xff];
  return ~sum;
}

}  // namespace pelage
