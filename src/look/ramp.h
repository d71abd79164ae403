#pragma once
// Colour ramps: from a number to a colour.

#include <array>
#include <string>
#include <vector>

namespace pelage {

/// Red, green, blue in linear light, 0..1.
using Color = std::array<double, 3>;

/// Lightness, green-red and blue-yellow of Ottosson's OKLab (2020), in which equal distances look about equal.
std::array<double, 3> oklab_from_linear(const Color& color);

/// The inverse; colours that no screen can show are not clipped.
Color linear_from_oklab(const std::array<double, 3>& lab);

/// The colour "#rrggbb" (sRGB) in linear light.
Color parse_hex_color(const std::string& hex);

/// A colour at a place of a ramp.
struct Stop {
  double at;  ///< in [0, 1], growing from stop to stop
  Color color;
};

/// A piecewise linear curve through OKLab.
struct Ramp {
  std::vector<Stop> stops;  ///< at least one

  /// The colour at t in linear light within [0, 1]; below the first and above the last stop their colours.
  Color operator()(double t) const;
};

/// A ramp made ready for many samples.
class RampTable {
 public:
  RampTable() = default;
  explicit RampTable(const Ramp& ramp);
  /// The same colour as the ramp's, bit for bit.
  Color operator()(double t) const;

 private:
  struct Entry {
    double at;
    Color color;
    std::array<double, 3> lab;
  };
  std::vector<Entry> entries_;
};

/// One of the ramps that come with the program. Low values of the animal ramps are the ground of the coat, high
/// values its markings. Error(Fault::usage) with a suggestion if there is none of that name.
Ramp named_ramp(const std::string& name);

std::vector<std::string> ramp_names();

}  // namespace pelage
