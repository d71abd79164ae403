#pragma once
// Words in pictures: DejaVu Sans, which is compiled into the program.

#include <string>
#include <vector>

namespace pelage {

/// How much of each pixel a line of text covers, 0..1.
struct TextMask {
  int width = 0, height = 0;
  int left = 0, top = 0;        ///< place of pixel (0, 0) against the start of the baseline; y grows downwards
  std::vector<float> coverage;  ///< width * height, by rows
};

/// A line of UTF-8 text, `size` pixels from one baseline to the next; what the font does not have becomes a box.
TextMask rasterise_text(const std::string& text, double size);

/// The distance that the text advances [pixels].
double text_width(const std::string& text, double size);

/// The text, cut short with "..." so that it is at most `width` pixels wide.
std::string fitted_text(const std::string& text, double size, double width);

}  // namespace pelage
