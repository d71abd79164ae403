#include "look/ramp.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "base/suggest.h"
#include "pelage/error.h"

namespace pelage {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Ottosson, "A perceptual color space for image processing" (2020): linear sRGB to cone responses, and the
// cube roots of these to lightness and the two opponent colours; then the inverses.
constexpr Matrix cones_from_rgb = {{{0.4122214708, 0.5363325363, 0.0514459929},
                                    {0.2119034982, 0.6806995451, 0.1073969566},
                                    {0.0883024619, 0.2817188376, 0.6299787005}}};
constexpr Matrix lab_from_roots = {{{0.2104542553, 0.7936177850, -0.0040720468},
                                    {1.9779984951, -2.4285922050, 0.4505937099},
                                    {0.0259040371, 0.7827717662, -0.8086757660}}};
constexpr Matrix roots_from_lab = {{{1, 0.3963377774, 0.2158037573},  //
                                    {1, -0.1055613458, -0.0638541728},
                                    {1, -0.0894841775, -1.2914855480}}};
constexpr Matrix rgb_from_cones = {{{4.0767416621, -3.3077115913, 0.2309699292},
                                    {-1.2684380046, 2.6097574011, -0.3413193965},
                                    {-0.0041960863, -0.7034186147, 1.7076147010}}};

std::array<double, 3> multiply(const Matrix& A, const std::array<double, 3>& x) {
  std::array<double, 3> y{};
  for (std::size_t i = 0; i < 3; ++i) y[i] = A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * x[2];
  return y;
}

struct NamedColor {
  double at;
  const char* hex;
};

struct NamedRamp {
  const char* name;
  std::vector<NamedColor> stops;
};

/// The steep middle of an animal ramp is the edge of a marking; the gentle ends keep some of the modelling of
/// the field inside markings and ground, as light and dark hair does.
const std::vector<NamedRamp>& painted_ramps() {
  static const std::vector<NamedRamp> ramps = {
      {"leopard", {{0, "#f1d9a9"}, {0.35, "#e0ae62"}, {0.50, "#a8652b"}, {0.65, "#41240f"}, {1, "#1d110a"}}},
      {"tawny", {{0, "#f6e6c6"}, {0.30, "#e3b679"}, {0.60, "#b0703a"}, {0.85, "#5f3419"}, {1, "#351b0e"}}},
      {"giraffe", {{0, "#f8ecd2"}, {0.38, "#ecd2a2"}, {0.50, "#bd7f3f"}, {0.62, "#96541f"}, {1, "#6a3512"}}},
      {"zebra", {{0, "#faf6ec"}, {0.42, "#eee6d6"}, {0.50, "#8b8178"}, {0.58, "#2b2623"}, {1, "#15120f"}}},
      {"mono", {{0, "#f9f5ea"}, {1, "#17140f"}}},
      {"reef", {{0, "#073b4c"}, {0.35, "#118a92"}, {0.50, "#f0e6c8"}, {0.65, "#f28c38"}, {1, "#c2410c"}}},
      {"heat", {{0, "#0d0508"}, {0.25, "#5b1130"}, {0.50, "#b8312f"}, {0.75, "#f0883a"}, {1, "#fdf3c7"}}},
      {"ferroin", {{0, "#8c1f12"}, {0.35, "#b23a1e"}, {0.55, "#9a6a78"}, {0.75, "#4f7fc0"}, {1, "#bfe0f5"}}},
      {"iodine", {{0, "#f4e3a1"}, {0.40, "#d9b650"}, {0.55, "#7a7a72"}, {0.75, "#274b86"}, {1, "#0e1f4d"}}},
      {"angelfish", {{0, "#f7d84a"}, {0.40, "#eab53a"}, {0.50, "#8f8a60"}, {0.60, "#2e5a94"}, {1, "#14264f"}}},
      {"thermal", {{0, "#23457f"}, {0.30, "#7fa6cf"}, {0.50, "#f1ece2"}, {0.70, "#d98a6a"}, {1, "#8c1c2b"}}},
      {"alloy", {{0, "#2b2f36"}, {0.35, "#6d7480"}, {0.50, "#b9a58c"}, {0.65, "#d9b06a"}, {1, "#f5dfa8"}}},
      {"steel", {{0, "#1b1f26"}, {0.40, "#4f5a66"}, {0.70, "#a9b4bd"}, {1, "#f3f6f7"}}},
      {"heart", {{0, "#3c0a12"}, {0.30, "#8e1b22"}, {0.55, "#d1543f"}, {0.80, "#f5b98a"}, {1, "#fff4e0"}}},
      {"discharge", {{0, "#0d0a1c"}, {0.35, "#3a1a5e"}, {0.60, "#9a2fa0"}, {0.80, "#ee7fb8"}, {1, "#fff0f5"}}},
      {"savanna", {{0, "#e6c58c"}, {0.30, "#c9a063"}, {0.50, "#8f8a45"}, {0.70, "#4d6b2c"}, {1, "#1f3d1b"}}},
      {"lagoon", {{0, "#06243b"}, {0.35, "#0f5d73"}, {0.60, "#3f9f86"}, {0.85, "#a8cf6a"}, {1, "#f0f2b0"}}},
      {"slime", {{0, "#20242a"}, {0.30, "#4a4a36"}, {0.60, "#a3923f"}, {0.85, "#e7c84f"}, {1, "#fff3b8"}}},
      {"terrain", {{0, "#2f4a3a"}, {0.30, "#7c8a55"}, {0.55, "#c9b583"}, {0.80, "#a58468"}, {1, "#f4f0ea"}}},
  };
  return ramps;
}

/// For measuring by eye: lightness grows evenly from dark violet over teal to yellow, so that equal steps of the
/// value look equal and survive a grey print and the common colour blindnesses.
Ramp science_ramp() {
  constexpr int count = 17;
  Ramp ramp;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    const double lightness = 0.25 + 0.67 * t;
    const double hue = (300 - 195 * t) * std::numbers::pi / 180;
    const double chroma = 0.088 + 0.082 * t * t * t;  // about as much as the screen has at these hues
    ramp.stops.push_back({t, linear_from_oklab({lightness, chroma * std::cos(hue), chroma * std::sin(hue)})});
  }
  return ramp;
}

Color clamp(Color color) {
  for (double& c : color) c = std::clamp(c, 0.0, 1.0);
  return color;
}

}  // namespace

std::array<double, 3> oklab_from_linear(const Color& color) {
  std::array<double, 3> cones = multiply(cones_from_rgb, color);
  for (double& c : cones) c = std::cbrt(c);
  return multiply(lab_from_roots, cones);
}

Color linear_from_oklab(const std::array<double, 3>& lab) {
  std::array<double, 3> cones = multiply(roots_from_lab, lab);
  for (double& c : cones) c = c * c * c;
  return multiply(rgb_from_cones, cones);
}

namespace {

/// Two hexadecimal digits.
int hex_byte(const char* digits) {
  int value = 0;
  std::from_chars(digits, digits + 2, value, 16);
  return value;
}

}  // namespace

Color parse_hex_color(const std::string& hex) {
  const bool digits = hex.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (hex.size() != 7 || hex[0] != '#' || !digits)
    throw Error(Fault::usage, "\"" + hex + "\" is not a colour; write it as \"#rrggbb\", for example \"#d8a05a\"");
  Color color{};
  for (std::size_t k = 0; k < 3; ++k) color[k] = linear_from_srgb(hex_byte(hex.data() + 1 + 2 * k) / 255.0);
  return color;
}

RampTable::RampTable(const Ramp& ramp) {
  assert(!ramp.stops.empty());
  for (const Stop& s : ramp.stops) entries_.push_back({s.at, clamp(s.color), oklab_from_linear(s.color)});
}

Color RampTable::operator()(double t) const {
  const auto above = std::ranges::upper_bound(entries_, t, {}, &Entry::at);
  if (above == entries_.begin()) return entries_.front().color;
  if (above == entries_.end()) return entries_.back().color;
  const auto below = above - 1;
  const double weight = (t - below->at) / (above->at - below->at);
  std::array<double, 3> lab{};
  for (std::size_t k = 0; k < 3; ++k) lab[k] = (1 - weight) * below->lab[k] + weight * above->lab[k];
  return clamp(linear_from_oklab(lab));
}

Color Ramp::operator()(double t) const { return RampTable(*this)(t); }

std::vector<std::string> ramp_names() {
  std::vector<std::string> names;
  for (const NamedRamp& ramp : painted_ramps()) names.push_back(ramp.name);
  names.push_back("science");
  return names;
}

Ramp named_ramp(const std::string& name) {
  if (name == "science") return science_ramp();
  for (const NamedRamp& named : painted_ramps()) {
    if (name != named.name) continue;
    Ramp ramp;
    for (const NamedColor& stop : named.stops) ramp.stops.push_back({stop.at, parse_hex_color(stop.hex)});
    return ramp;
  }
  const std::string hint = did_you_mean(name, ramp_names());
  throw Error(Fault::usage,
              "there is no ramp \"" + name + "\"; " + (hint.empty() ? "known: " + join_names(ramp_names()) : hint));
}

}  // namespace pelage
