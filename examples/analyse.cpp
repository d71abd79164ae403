// Asks linear theory about a model: what grows, how long it is, and where it begins.
#include <pelage/analyse.h>

#include <iostream>

int main() try {
  const pelage::ModelAnalyser turing("turing");
  for (const double diffusion : {0.12, 0.13, 0.15}) {
    const pelage::Analysis a = turing.at({{"Da", diffusion}});
    std::cout << "Da = " << diffusion << ": " << a.verdict << "\n";
    if (a.stability.band_min)
      std::cout << "  the fastest wave is " << *a.stability.wavelength << " long and grows at the rate "
                << a.stability.growth << "\n";
    for (const std::string& line : a.thresholds_in_words) std::cout << "  " << line << "\n";
  }
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
