#pragma once
// Drawing: boxes, lines, text and pictures with smooth edges. Colours are blended as sRGB values, like those of other
// drawing programs, so that thin dark lines keep their weight.

#include <string>
#include <vector>

#include "look/ramp.h"
#include "pelage/image.h"

namespace pelage {

/// A place in pixels from the top left corner; pixel (i, j) covers [i, i + 1] x [j, j + 1].
struct Spot {
  double x = 0, y = 0;
};

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

enum class Align { left, centre, right };

struct TextStyle {
  double size = 24;                  ///< pixels from line to line
  Color color = {0.02, 0.02, 0.02};  ///< linear light
  Align align = Align::left;         ///< of the text against its spot, which lies on the baseline
  bool upwards = false;              ///< turned to run from the bottom to the top
};

class Canvas {
 public:
  Canvas(int width, int height, const Color& background);

  void fill(const Rectangle& box, const Color& color, double opacity = 1);
  /// A line through the spots; where it meets itself it is not darker.
  void line(const std::vector<Spot>& spots, double width, const Color& color);
  void dashed_line(const std::vector<Spot>& spots, double width, const Color& color, double dash, double gap);
  void frame(const Rectangle& box, double width, const Color& color);
  void disc(const Spot& centre, double radius, const Color& color);
  void text(const std::string& text, const Spot& spot, const TextStyle& style);
  /// The picture with its top left corner at pixel (x, y); what lies outside is cut off.
  void picture(const Image& picture, int x, int y);

  int width() const { return width_; }
  int height() const { return height_; }
  Image image() const;

 private:
  void blend(int x, int y, const Color& encoded, double coverage);

  int width_, height_;
  std::vector<float> encoded_;  ///< sRGB values 0..1
};

}  // namespace pelage
