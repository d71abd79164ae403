#include "look/text.h"

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC  // other libraries bring the same functions
#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "look/font.h"

namespace pelage {

namespace {

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo info = [] {
    stbtt_fontinfo f;
    stbtt_InitFont(&f, reinterpret_cast<const unsigned char*>(font_file().data()), 0);
    return f;
  }();
  return info;
}

/// The characters of well-formed UTF-8; other bytes count as characters of their own.
std::vector<int> characters(const std::string& text) {
  std::vector<int> list;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i++]);
    const int more = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
    int code = more == 0 ? byte : byte & (0x3f >> more);
    for (int k = 0; k < more && i < text.size(); ++k) code = code << 6 | (text[i++] & 0x3f);
    list.push_back(code);
  }
  return list;
}

float scale_of(double size) {
  constexpr double line = 1.2;  // baselines are usually this many sizes of the type apart
  return stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size / line));
}

/// place(character, x) for every character, x being where its origin lies; returns the end of the line.
template <class Place>
float lay_out(const std::string& text, float scale, Place&& place) {
  float x = 0;
  int before = 0;
  for (const int character : characters(text)) {
    if (before) x += scale * static_cast<float>(stbtt_GetCodepointKernAdvance(&font(), before, character));
    place(character, x);
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&font(), character, &advance, &bearing);
    x += scale * static_cast<float>(advance);
    before = character;
  }
  return x;
}

/// The frame that holds all glyphs, one pixel more on each side for their shift by fractions.
TextMask empty_mask(const std::string& text, float scale) {
  int x0 = std::numeric_limits<int>::max(), y0 = x0, x1 = std::numeric_limits<int>::min(), y1 = x1;
  lay_out(text, scale, [&](int character, float x) {
    int left, top, right, bottom;
    stbtt_GetCodepointBitmapBox(&font(), character, scale, scale, &left, &top, &right, &bottom);
    const int at = static_cast<int>(std::floor(x));
    x0 = std::min(x0, at + left - 1), y0 = std::min(y0, top - 1);
    x1 = std::max(x1, at + right + 2), y1 = std::max(y1, bottom + 1);
  });
  if (x1 <= x0) return {};
  const auto pixels = static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0);
  return {x1 - x0, y1 - y0, x0, y0, std::vector<float>(pixels)};
}

void add_glyph(TextMask& mask, int character, float x, float scale) {
  const float whole = std::floor(x), shift = x - whole;
  int left, top, right, bottom;
  stbtt_GetCodepointBitmapBoxSubpixel(&font(), character, scale, scale, shift, 0, &left, &top, &right, &bottom);
  const int width = right - left, height = bottom - top;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> glyph(static_cast<std::size_t>(width * height));
  stbtt_MakeCodepointBitmapSubpixel(&font(), glyph.data(), width, height, width, scale, scale, shift, 0, character);
  const int column = static_cast<int>(whole) + left - mask.left, row = top - mask.top;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      float& target = mask.coverage[static_cast<std::size_t>((row + j) * mask.width + column + i)];
      target = std::max(target, static_cast<float>(glyph[static_cast<std::size_t>(j * width + i)]) / 255);
    }
}

}  // namespace

TextMask rasterise_text(const std::string& text, double size) {
  const float scale = scale_of(size);
  TextMask mask = empty_mask(text, scale);
  if (mask.width > 0) lay_out(text, scale, [&](int character, float x) { add_glyph(mask, character, x, scale); });
  return mask;
}

double text_width(const std::string& text, double size) {
  return lay_out(text, scale_of(size), [](int, float) {});
}

std::string fitted_text(const std::string& text, double size, double width) {
  if (text_width(text, size) <= width) return text;
  std::string cut = text;
  while (!cut.empty() && text_width(cut + "...", size) > width) {
    while (cut.size() > 1 && (cut.back() & 0xc0) == 0x80) cut.pop_back();  // the rest of a character
    cut.pop_back();
  }
  return cut + "...";
}

}  // namespace pelage
