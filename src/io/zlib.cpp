#include "io/zlib.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace pelage {

std::string zlib_packed(std::string_view bytes) {
  constexpr int level = 3;  // of 12
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

std::optional<std::string> zlib_unpacked(std::string_view stream, std::size_t size) {
  constexpr std::size_t most = 1032;
  if (size / most > stream.size()) return {};
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::string out(size, '\0');
  const libdeflate_result result =
      libdeflate_zlib_decompress(decompressor.get(), stream.data(), stream.size(), out.data(), size, nullptr);
  if (result != LIBDEFLATE_SUCCESS) return {};
  return out;
}

}  // namespace pelage
