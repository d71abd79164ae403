#include "look/dispersion_plot.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "look/ticks.h"

namespace pelage {

namespace {

const Color curve_color = parse_hex_color("#0b5f8a"), frequency_color = parse_hex_color("#c2571a"),
            band_color = parse_hex_color("#fbe7c6"), mark_color = parse_hex_color("#a3231f");

/// Wave numbers from 0 to well beyond what grows; without growth to where diffusion has taken over.
double largest_wave_number(const Stability& s) {
  double scale = 0, diffusion = 0;
  for (const auto& value : s.eigenvalues) scale = std::max(scale, std::abs(value));
  for (const auto* list : {&s.diffusion, &s.cross, &s.fluxes})
    for (const double d : *list) diffusion = std::max(diffusion, std::abs(d));
  double k = diffusion > 0 && scale > 0 ? 1.5 * std::sqrt(scale / diffusion) : 1;
  if (s.wavelength) k = 2 * 2 * std::numbers::pi / *s.wavelength;
  if (s.band_max && *s.band_max < 20 * k) k = std::max(k, 1.3 * *s.band_max);
  return k;
}

/// Heights of the curves, with room above; deep decay at large wave numbers is cut off so that the top stays readable.
Interval heights(const std::vector<std::array<double, 2>>& growth, double frequency) {
  double low = 0, high = frequency;
  for (const auto& [k, sigma] : growth) {
    low = std::min(low, sigma);
    high = std::max(high, sigma);
  }
  const double at_zero = std::abs(growth.front()[1]);
  low = std::max(low, -3 * std::max(at_zero, high));
  if (!(high - low > 0)) return {-1, 1};
  return {low - 0.06 * (high - low), high + 0.12 * (high - low)};
}

/// At the threshold only rounding is left.
double rounded_growth(const Stability& s) {
  return std::abs(s.growth) < 1e-9 * std::abs(s.eigenvalues.front()) ? 0 : s.growth;
}

PlotMark fastest_wave(const Stability& s) {
  const double k = 2 * std::numbers::pi / *s.wavelength;
  std::vector<std::string> words = {"fastest wave: k = " + label_of(k) + ", \u03bb = " + label_of(*s.wavelength),
                                    "growth rate " + label_of(rounded_growth(s))};
  if (s.oscillatory) words.back() += ", frequency " + label_of(std::abs(growth_rate(s, k).imag()));
  return {k, s.growth, mark_color, words};
}

/// The pieces of a curve where it is not zero: real branches have no frequency to show.
std::vector<PlotCurve> nonzero_pieces(const std::vector<std::array<double, 2>>& points, const PlotCurve& style) {
  std::vector<PlotCurve> pieces;
  bool zero = true;
  for (const auto& point : points) {
    if (point[1] != 0 && zero) pieces.push_back(style);
    zero = point[1] == 0;
    if (!zero) pieces.back().points.push_back(point);
    if (pieces.size() > 1) pieces.back().label = "";  // named once
  }
  return pieces;
}

}  // namespace

Plot dispersion_plot(const Stability& s, const std::string& title, const std::string& subtitle) {
  assert(!s.steady_states.empty());
  constexpr int samples = 1000;
  const double largest = largest_wave_number(s);
  PlotCurve growth{{}, curve_color, false, "Re \u03c3"};
  std::vector<std::array<double, 2>> frequencies;
  double highest_frequency = 0;
  for (int i = 0; i <= samples; ++i) {
    const double k = largest * i / samples;
    const std::complex<double> sigma = growth_rate(s, k);
    growth.points.push_back({k, sigma.real()});
    frequencies.push_back({k, std::abs(sigma.imag())});
    highest_frequency = std::max(highest_frequency, frequencies.back()[1]);
  }
  Plot plot;
  plot.title = title;
  plot.subtitle = subtitle;
  plot.x_label = "wave number k [1 / model length]";
  plot.y_label = "growth rate \u03c3 [1 / model time]";
  plot.x = {0, largest};
  plot.y = heights(growth.points, highest_frequency);
  plot.curves = nonzero_pieces(frequencies, {{}, frequency_color, true, "|Im \u03c3|"});
  plot.curves.insert(plot.curves.begin(), growth);
  if (s.band_min) plot.bands.push_back({{*s.band_min, *s.band_max}, band_color, "unstable band"});
  if (s.wavelength) plot.marks.push_back(fastest_wave(s));
  return plot;
}

}  // namespace pelage
