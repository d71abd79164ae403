#include "look/caption.h"

#include "look/canvas.h"
#include "look/text.h"

namespace pelage {

namespace {

/// Size of the letters, legible at any width of the picture [pixels].
double letters(int width) { return 16 + width / 64.0; }

}  // namespace

int caption_height(int width) { return static_cast<int>(3.1 * letters(width)); }

Image with_caption(const Image& picture, const std::string& title, const std::string& subtitle) {
  const double size = letters(picture.width);
  const double margin = 0.8 * size;
  Canvas canvas(picture.width, picture.height + caption_height(picture.width), {1, 1, 1});
  canvas.picture(picture, 0, 0);
  const double room = picture.width - 2 * margin, small = 0.8 * size;
  canvas.text(fitted_text(title, size, room), {margin, picture.height + 1.25 * size}, {size});
  canvas.text(fitted_text(subtitle, small, room), {margin, picture.height + 2.45 * size}, {small, {0.12, 0.12, 0.13}});
  return canvas.image();
}

}  // namespace pelage
