#include "io/zlib.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace pelage {

namespace {

using Pack = std::size_t(libdeflate_compressor*, const void*, std::size_t, void*, std::size_t);
using Unpack = libdeflate_result(libdeflate_decompressor*, const void*, std::size_t, void*, std::size_t, std::size_t*);

std::string packed(std::string_view bytes, int level, Pack& pack) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(pack(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

std::optional<std::string> unpacked(std::string_view stream, std::size_t size, Unpack& unpack) {
  constexpr std::size_t most = 1032;  // bytes that deflate makes of one
  if (size / most > stream.size()) return {};
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::string out(size, '\0');
  if (unpack(decompressor.get(), stream.data(), stream.size(), out.data(), size, nullptr) != LIBDEFLATE_SUCCESS)
    return {};
  return out;
}

constexpr int quick = 3, tight = 6;  // of 12

}  // namespace

std::string zlib_packed(std::string_view bytes) { return packed(bytes, quick, libdeflate_zlib_compress); }
std::string deflated(std::string_view bytes) { return packed(bytes, tight, libdeflate_deflate_compress); }

std::optional<std::string> zlib_unpacked(std::string_view stream, std::size_t size) {
  return unpacked(stream, size, libdeflate_zlib_decompress);
}
std::optional<std::string> inflated(std::string_view stream, std::size_t size) {
  return unpacked(stream, size, libdeflate_deflate_decompress);
}

std::uint32_t crc32(std::string_view bytes) { return libdeflate_crc32(0, bytes.data(), bytes.size()); }

}  // namespace pelage
