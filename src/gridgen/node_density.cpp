#include "gridgen/node_density.h"

#include <cmath>

#include "base/number.h"
#include "gridgen/border.h"
#include "pelage/error.h"

namespace pelage {

std::vector<std::string> NodeDensity::variables(const PlaneField* field) {
  std::vector<std::string> names = {"x", "y", "z"};
  if (field) names.insert(names.end(), field->names().begin(), field->names().end());
  return names;
}

std::vector<std::vector<double>> NodeDensity::with_gradient(std::span<const Point> points) const {
  const std::size_t fields = field_ ? field_->names().size() : 0;
  std::vector<std::vector<double>> at(3 + fields, std::vector<double>(points.size()));
  std::vector<std::vector<PlaneField::Value>> field(fields);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) at[k][i] = points[i][k];
    for (std::size_t f = 0; f < fields; ++f) {
      field[f].push_back(field_->at(f, points[i][0], points[i][1]));
      at[3 + f][i] = field[f][i].value;
    }
  }
  std::vector<std::vector<double>> values = formula_.with_gradient(at);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(values[0][i] > 0 && std::isfinite(values[0][i])))
      throw Error(Fault::usage,
                  "the attraction must be a positive number everywhere; at " + place_text(points[i]) + " it is " +
                      number(values[0][i]),
                  formula_.where());
    for (std::size_t f = 0; f < fields; ++f) {
      values[1][i] += values[4 + f][i] * field[f][i].dx;
      values[2][i] += values[4 + f][i] * field[f][i].dy;
    }
  }
  values.resize(4);
  return values;
}

}  // namespace pelage
