#pragma once
// Curves over a pair of axes, as in a printed paper.

#include <array>
#include <string>
#include <vector>

#include "look/canvas.h"

namespace pelage {

struct Interval {
  double low = 0, high = 1;
};

struct PlotCurve {
  std::vector<std::array<double, 2>> points;  ///< drawn within the axes only
  Color color = {0, 0, 0};
  bool dashed = false;
  std::string label;  ///< for the legend
};

/// An interval of x, shaded over the whole height.
struct PlotBand {
  Interval x;
  Color color = {0, 0, 0};
  std::string label;  ///< for the legend
};

/// A point of a curve, with a line down to the x axis and words beside it.
struct PlotMark {
  double x = 0, y = 0;
  Color color = {0, 0, 0};
  std::vector<std::string> words;  ///< line by line
};

struct Plot {
  std::string title, subtitle;
  std::string x_label, y_label;
  Interval x, y;
  std::vector<PlotCurve> curves;
  std::vector<PlotBand> bands;
  std::vector<PlotMark> marks;
  int width = 1600, height = 1000;  ///< pixels
};

/// Where data lie in the picture.
class PlotFrame {
 public:
  explicit PlotFrame(const Plot& plot);
  const Rectangle& box() const { return box_; }  ///< of the axes
  Spot place(double x, double y) const;

 private:
  Rectangle box_;
  Interval x_, y_;
};

/// Where words of that size stand beside a mark at `at`, in pixels: at the foot of its line or at the top of the frame
/// `box`, right or left, the first that no curve crosses; where all are crossed, the first within the frame.
Rectangle place_of_words(const Spot& at, const Spot& size, const std::vector<std::vector<Spot>>& curves,
                         const Rectangle& box);

/// The parts of a curve that lie within the axes, cut off exactly at their edges; in pixels.
std::vector<std::vector<Spot>> visible_parts(const PlotCurve& curve, const PlotFrame& frame);

Image draw(const Plot& plot);

}  // namespace pelage
