#include "io/ktx2_writer.h"

#include <cassert>
#include <string_view>

#include "io/bytes.h"
#include "io/output_set.h"

namespace pelage {

namespace {

constexpr int channels = 4;

void append_words(std::string& bytes, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words) append_bytes(bytes, word);
}

/// What the bytes of a texel are: the basic block of the Khronos Data Format Specification 1.3.
std::string format_description() {
  constexpr std::uint32_t block = 24 + 16 * channels;
  constexpr std::uint32_t version = 2, rgbsda = 1, bt709 = 1, srgb = 2;
  constexpr std::uint32_t red = 0, green = 1, blue = 2, alpha = 15, linear = 16, eight_bits = 7;
  std::string bytes;
  append_words(bytes, {4 + block, 0, version | block << 16, rgbsda | bt709 << 8 | srgb << 16, 0, channels, 0});
  std::uint32_t first_bit = 0;
  for (const std::uint32_t channel : {red, green, blue, alpha | linear}) {
    append_words(bytes, {first_bit | eight_bits << 16 | channel << 24, 0, 0, 255});
    first_bit += 8;
  }
  return bytes;
}

void append_entry(std::string& bytes, std::string_view key, std::string_view value) {
  append_bytes(bytes, static_cast<std::uint32_t>(key.size() + value.size() + 2));
  for (const std::string_view text : {key, value}) bytes.append(text).push_back('\0');
  bytes.resize((bytes.size() + 3) / 4 * 4);
}

std::string with_alpha(const Pixels& pixels) {
  std::string bytes;
  bytes.reserve(pixels.bytes.size() / 3 * channels);
  for (std::size_t i = 0; i < pixels.bytes.size(); i += 3) {
    bytes.append(reinterpret_cast<const char*>(&pixels.bytes[i]), 3);
    bytes.push_back('\xff');
  }
  return bytes;
}

}  // namespace

std::string ktx2_bytes(const std::vector<const Pixels*>& levels) {
  assert(!levels.empty() && levels[0]->channels == 3);
  constexpr std::uint32_t r8g8b8a8_srgb = 43, bytes_of_type = 1, one_face = 1;
  const auto count = static_cast<std::uint32_t>(levels.size());
  const std::uint32_t index_end = 80 + 24 * count;
  const std::string description = format_description();
  std::string facts;
  append_entry(facts, "KTXorientation", "rd");  // to the right and down from the first texel
  append_entry(facts, "KTXwriter", "pelage");
  if (const std::string record = record_for_files(); !record.empty()) append_entry(facts, "pelage", record);
  std::string bytes("\xABKTX 20\xBB\r\n\x1A\n", 12);
  append_words(bytes, {r8g8b8a8_srgb, bytes_of_type, static_cast<std::uint32_t>(levels[0]->width),
                       static_cast<std::uint32_t>(levels[0]->height), 0, 0, one_face, count, 0});
  const auto length = static_cast<std::uint32_t>(description.size());
  append_words(bytes, {index_end, length, index_end + length, static_cast<std::uint32_t>(facts.size()), 0, 0, 0, 0});
  // The smallest level comes first.
  std::vector<std::uint64_t> begin(levels.size()), size(levels.size());
  std::uint64_t next = index_end + length + facts.size();
  for (std::size_t k = levels.size(); k-- > 0; next += size[k]) {
    begin[k] = next;
    size[k] = levels[k]->bytes.size() / 3 * channels;
  }
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (const std::uint64_t number : {begin[k], size[k], size[k]}) append_bytes(bytes, number);
  bytes += description + facts;
  for (std::size_t k = levels.size(); k-- > 0;) bytes += with_alpha(*levels[k]);
  return bytes;
}

}  // namespace pelage
