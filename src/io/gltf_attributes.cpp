#include "io/gltf_attributes.h"

#include <algorithm>

#include "base/ascii.h"

namespace pelage {

namespace {

double absent_value(const std::string& name) {
  return name.starts_with("color") && std::all_of(name.begin() + 5, name.end(), is_digit) ? 1 : 0;
}

/// The same tuples with more components.
void make_wider(Attribute& a, int components) {
  std::vector<double> values;
  for (std::size_t i = 0; i < a.values.size(); i += a.components) {
    values.insert(values.end(), a.values.begin() + static_cast<std::ptrdiff_t>(i),
                  a.values.begin() + static_cast<std::ptrdiff_t>(i + a.components));
    values.resize(values.size() + components - a.components, absent_value(a.name));
  }
  a.values = std::move(values);
  a.components = components;
}

}  // namespace

void JoinedAttributes::append(const std::string& name, int components, NumberType type, std::size_t first,
                              const std::vector<double>& values) {
  auto a = std::find_if(attributes_.begin(), attributes_.end(), [&](const Attribute& b) { return b.name == name; });
  if (a == attributes_.end()) a = attributes_.insert(a, {name, components, Domain::vertex, {}, type});
  if (type != a->type) a->type = NumberType::float64;
  if (components > a->components) make_wider(*a, components);
  const auto width = static_cast<std::size_t>(a->components);
  a->values.resize(first * width, absent_value(name));
  for (std::size_t i = 0; i < values.size(); i += components) {
    a->values.insert(a->values.end(), values.begin() + static_cast<std::ptrdiff_t>(i),
                     values.begin() + static_cast<std::ptrdiff_t>(i + components));
    a->values.resize(a->values.size() + width - components, absent_value(name));
  }
}

void JoinedAttributes::complete(std::size_t vertices) {
  for (Attribute& a : attributes_) a.values.resize(vertices * a.components, absent_value(a.name));
}

}  // namespace pelage
