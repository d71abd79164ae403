#include "react/language.h"

#include "react/functions.h"

namespace pelage {

namespace {

constexpr std::string_view place = "Place and time", shape = "Shape", space = "Derivatives", vectors = "Vectors",
                           random = "Random", number = "Numbers", function = "Functions";

std::vector<Word> all_words() {
  std::vector<Word> list = {
      {place, "t", "time [model units], from 0"},
      {place, "x", "place along x [world units]"},
      {place, "y", "place along y"},
      {place, "z", "place along z"},
      {place, "bx", "place along x in the bounding box of the surface, from -1 to 1"},
      {place, "by", "the same along y"},
      {place, "bz", "the same along z"},
      {place, "nx", "x of the unit normal, which points outward, from -1 to 1"},
      {place, "ny", "y of the unit normal"},
      {place, "nz", "z of the unit normal"},
      {place, "k1", "the larger principal curvature [1/world unit]"},
      {place, "k2", "the smaller one"},
      {place, "H", "mean curvature (k1 + k2)/2"},
      {shape, "attribute(NAME)", "a vertex attribute or image of the shape; `pelage check` lists them"},
      {space, "lap(u)",
       "the surface Laplacian of the species u, times numbers and parameters; in rate and equals only"},
      {space, "grad u", "the gradient of the species u along the surface; in dot and div only"},
      {space, "grad2(u)", "abs(grad u)^2 [1/model unit^2]; in rate and equals only"},
      {space, "dot(grad u, grad v)", "the scalar product of two gradients; likewise"},
      {space, "div(c grad u)",
       "the divergence of a flux, times numbers and parameters; c is any formula; in rate only"},
      {vectors, "norm(u)", "the length of u, a name of which u_1, u_2 and u_3 are known"},
      {vectors, "dot(u, v)", "the scalar product of two vectors"},
      {vectors, "cross(u, v)", "their vector product; in formulas of vectors only"},
      {random, "noise(length)", "smooth noise of mean 0 and deviation 1; length in model units"},
      {random, "noise(length, seed)", "the same in every formula that names this seed, a whole number"},
      {random, "uniform(lower, upper)", "another number at every place, all equally likely"},
      {random, "normal(mean, deviation)", "another number at every place, normally distributed"},
      {number, "pi", "3.14159..."},
      {number, "e", "2.71828..."},
  };
  for (const Function& f : pure_functions()) list.push_back({function, std::string(f.usage), std::string(f.meaning)});
  return list;
}

}  // namespace

const std::vector<Word>& words() {
  static const std::vector<Word> list = all_words();
  return list;
}

const std::vector<Word>& operators() {
  static const std::vector<Word> list = {
      {"Operators", "a + b, a - b, a*b, a/b, -a", "as usual; factors need their *"},
      {"Operators", "a^b", "power; binds tightest and to the right: -2^2 is -4, 2^3^2 is 2^9"},
      {"Operators", "a < b, <=, >, >=, ==, !=", "1 where it is true, else 0"},
      {"Operators", "a and b, a or b, not a", "of truth values; anything but 0 is true"},
  };
  return list;
}

}  // namespace pelage
