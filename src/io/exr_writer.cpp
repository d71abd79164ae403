#include "io/exr_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/output_set.h"
#include "io/zlib.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// Channels stand in the order of their names.
std::vector<std::size_t> order_of(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return names[k]; });
  return order;
}

void check_names(const std::vector<std::string>& names, const std::string& path) {
  constexpr std::size_t longest = 255;
  for (const std::string& name : names) {
    if (name.empty() || name.size() > longest || name.find('\0') != std::string::npos)
      throw Error(Fault::usage, "a channel of an EXR file needs a name of 1 to 255 letters", {path});
    if (std::ranges::count(names, name) > 1)
      throw Error(Fault::usage, "the EXR file would have two channels \"" + name + "\"", {path});
  }
}

void check_values(const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes,
                  const std::string& path) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto bad = std::ranges::find_if_not(planes[k], [](float x) { return std::isfinite(x); });
    if (bad != planes[k].end())
      throw Error(Fault::numerics,
                  "\"" + names[k] + "\" is not a finite number at pixel " + std::to_string(bad - planes[k].begin()) +
                      "; nothing was written",
                  {path});
  }
}

void append_name(std::string& bytes, const std::string& name) { bytes.append(name.c_str(), name.size() + 1); }

void append_attribute(std::string& bytes, const char* name, const char* type, const std::string& value) {
  append_name(bytes, name);
  append_name(bytes, type);
  append_bytes(bytes, static_cast<std::int32_t>(value.size()));
  bytes += value;
}

template <class... Values>
std::string joined(Values... values) {
  std::string bytes;
  (append_bytes(bytes, values), ...);
  return bytes;
}

std::string channel_list(const std::vector<std::string>& names, const std::vector<std::size_t>& order) {
  constexpr std::int32_t float_type = 2, every_pixel = 1;
  std::string list;
  for (const std::size_t k : order) {
    append_name(list, names[k]);
    list += joined(float_type, std::int32_t{0}, every_pixel, every_pixel);
  }
  return list + '\0';
}

std::string header_of(const std::vector<std::string>& names, const std::vector<std::size_t>& order, int width,
                      int height) {
  constexpr std::int32_t magic = 20000630, version = 2, long_names = 0x400;
  constexpr std::size_t short_name = 31;
  constexpr std::int8_t zip = 3, rows_downwards = 0;
  const bool any_long = std::ranges::any_of(names, [](const std::string& name) { return name.size() > short_name; });
  const std::string window = joined(std::int32_t{0}, std::int32_t{0}, width - 1, height - 1);
  std::string bytes = joined(magic, any_long ? version | long_names : version);
  append_attribute(bytes, "channels", "chlist", channel_list(names, order));
  append_attribute(bytes, "compression", "compression", joined(zip));
  append_attribute(bytes, "dataWindow", "box2i", window);
  append_attribute(bytes, "displayWindow", "box2i", window);
  append_attribute(bytes, "lineOrder", "lineOrder", joined(rows_downwards));
  if (const std::string record = record_for_files(); !record.empty())
    append_attribute(bytes, "pelage", "string", record);
  append_attribute(bytes, "pixelAspectRatio", "float", joined(1.0F));
  append_attribute(bytes, "screenWindowCenter", "v2f", joined(0.0F, 0.0F));
  append_attribute(bytes, "screenWindowWidth", "float", joined(1.0F));
  return bytes + '\0';
}

/// All first and third bytes and so on, then all others; of those each less the one before, plus 128.
std::string packed_block(const std::string& bytes) {
  std::string apart;
  apart.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 2) apart += bytes[i];
  for (std::size_t i = 1; i < bytes.size(); i += 2) apart += bytes[i];
  for (std::size_t i = apart.size() - 1; i > 0; --i) apart[i] = static_cast<char>(apart[i] - apart[i - 1] + 128);
  std::string packed = zlib_packed(apart);
  return packed.size() < bytes.size() ? packed : bytes;  // readers tell the two by the size
}

std::string block_of(const std::vector<std::vector<float>>& planes, const std::vector<std::size_t>& order,
                     std::size_t width, std::size_t first, std::size_t last) {
  std::string bytes;
  bytes.reserve((last - first) * order.size() * width * sizeof(float));
  for (std::size_t y = first; y < last; ++y)
    for (const std::size_t k : order)
      for (std::size_t x = 0; x < width; ++x) append_bytes(bytes, planes[k][y * width + x]);
  return packed_block(bytes);
}

}  // namespace

std::string exr_bytes(const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes, int width,
                      int height, const std::string& path) {
  assert(!names.empty() && names.size() == planes.size() && width > 0 && height > 0);
  check_names(names, path);
  check_values(names, planes, path);
  constexpr std::size_t rows_of_block = 16;  // of the compression ZIP
  const std::vector<std::size_t> order = order_of(names);
  const auto rows = static_cast<std::size_t>(height), blocks = (rows + rows_of_block - 1) / rows_of_block;
  std::string bytes = header_of(names, order, width, height), data;
  const std::size_t begin = bytes.size() + blocks * sizeof(std::uint64_t);
  for (std::size_t y = 0; y < rows; y += rows_of_block) {
    append_bytes(bytes, static_cast<std::uint64_t>(begin + data.size()));  // the table of places
    const std::string block =
        block_of(planes, order, static_cast<std::size_t>(width), y, std::min(rows, y + rows_of_block));
    append_bytes(data, static_cast<std::int32_t>(y));
    append_bytes(data, static_cast<std::int32_t>(block.size()));
    data += block;
  }
  return bytes + data;
}

void write_exr(const std::string& path, const std::vector<std::string>& names,
               const std::vector<std::vector<float>>& planes, int width, int height) {
  write_file(path, exr_bytes(names, planes, width, height, path));
}

}  // namespace pelage
