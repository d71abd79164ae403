// Schnakenberg's reaction computed here instead of by the formulas of a model file.
#include <pelage/grow.h>
#include <pelage/io.h>

#include <algorithm>
#include <iostream>

int main() try {
  const pelage::Recipe recipe = pelage::parse_recipe(R"([stage]
model = "schnakenberg"
size = 0.4
steps = 200
)",
                                                     "example");
  pelage::OwnRates own;
  own.rates = [](auto u, double, std::size_t begin, std::size_t end, auto rate) {
    for (std::size_t s = 0; s < end - begin; ++s) {
      const double reaction = u[1][s] * u[1][s] * u[0][s];
      rate[0][s] = 0.9 - reaction;
      rate[1][s] = 0.1 - u[1][s] + reaction;
    }
  };
  pelage::Growth growth(pelage::read_shape("builtin:sphere?n=642"), recipe, {}, own);
  growth.advance(200);
  const std::vector<double> u = growth.values("u");
  const auto [low, high] = std::ranges::minmax(u);
  std::cout << "u from " << low << " to " << high << " at " << u.size() << " nodes\n";
  return high > low ? 0 : 1;
} catch (const pelage::Error& error) {
  std::cerr << "error: " << error.what() << "\n";
  return static_cast<int>(error.fault());
}
