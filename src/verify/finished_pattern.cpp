#include "verify/finished_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verify/sphere_spectrum.h"

namespace pelage {

namespace {

double mean(const Sampling& sampling, const Vector& samples) {
  return dot(sampling.weight, samples) / sampling.weight.sum();
}

double deviation(const Sampling& sampling, const Vector& samples) {
  const Vector difference = samples.array() - mean(sampling, samples);
  return std::sqrt(dot(sampling.weight, difference.cwiseProduct(difference)) / sampling.weight.sum());
}

Vector shown_samples(const Run& run) { return run.system().sampling->values * run.coefficients().back(); }

std::size_t fastest_species(const System& system) {
  const auto& species = system.species;
  const auto fastest =
      std::ranges::max_element(species, {}, [](const Species& s) { return s.algebraic ? -1 : s.diffusion; });
  return static_cast<std::size_t>(fastest - species.begin());
}

}  // namespace

double spectral_wavelength(const Sampling& sampling, const Vector& coefficients) {
  constexpr int max_degree = 40;
  const Vector samples = sampling.values * coefficients;
  const Vector difference = samples.array() - mean(sampling, samples);
  const std::vector<double> power = power_by_degree(sampling.position, sampling.weight, difference, max_degree);
  double total = 0, weighted = 0;
  for (std::size_t l = 1; l < power.size(); ++l) {
    total += power[l];
    weighted += power[l] * std::sqrt(static_cast<double>(l * (l + 1)));
  }
  return 2 * std::numbers::pi * total / weighted;
}

FinishedPattern finish_pattern(Program program) {
  constexpr std::int64_t many = 1'000'000'000;
  const double length_unit = program.stages.back().length_unit;
  Run run(std::move(program));
  const double largest_at_start = shown_samples(run).cwiseAbs().maxCoeff();
  FinishedPattern result;
  result.status = run.advance(many).status;
  result.message = run.summary().message;
  const System& system = run.system();
  const Vector shown = shown_samples(run);
  const double largest = std::max(largest_at_start, shown.cwiseAbs().maxCoeff());
  result.contrast = largest > 0 ? deviation(*system.sampling, shown) / largest : 0;
  const auto wavelength = [&](const Vector& u) { return spectral_wavelength(*system.sampling, u) / length_unit; };
  result.wavelength = wavelength(run.coefficients()[fastest_species(system)]);
  result.shown_wavelength = wavelength(run.coefficients().back());
  return result;
}

}  // namespace pelage
