#include "catalog/missing_attribute.h"

#include <algorithm>

#include "base/ascii.h"
#include "base/suggest.h"

namespace pelage {

namespace {

std::string read_as(const std::string& name) { return "attribute(" + name + ")"; }

/// The name without "_1", "_linear_1" behind it.
std::string stem(std::string name) {
  if (name.size() < 3 || name[name.size() - 2] != '_' || !is_digit(name.back())) return name;
  name.resize(name.size() - 2);
  const std::string light = "_linear";
  if (name.ends_with(light)) name.resize(name.size() - light.size());
  return name;
}

/// One name for all that is read of a colour, "flow_1, ..." for a vector.
std::string short_list(const std::vector<std::string>& known) {
  const auto has = [&](const std::string& name) { return std::ranges::count(known, name) > 0; };
  std::vector<std::string> names;
  for (const std::string& name : known) {
    const std::string whole = stem(name), first = whole + "_1";
    if (whole == name || !(has(whole) || has(first)))
      names.push_back(name);
    else if (!has(whole) && name == first)
      names.push_back(first + ", ...");
  }
  return names.empty() ? "none" : join_names(names);
}

/// Of a name that stands for several components, these.
std::string components(const std::string& name, const TriangleMesh& shape) {
  std::vector<std::string> names;
  for (const Attribute& a : shape.attributes)
    if (a.components > 1 && !is_color(a)) names.push_back(a.name);
  const std::string* vector = matching_name(name, names);
  if (!vector) return "";
  const int n = shape.find(*vector)->components;
  return "\"" + *vector + "\" has " + std::to_string(n) + " components, " + read_as(*vector + "_1") + " to " +
         read_as(*vector + "_" + std::to_string(n));
}

std::string why(const std::vector<std::string>& known) {
  const bool painted = std::ranges::count(known, "color") > 0;
  return std::string(painted ? "; a painted colour arrives as \"color\"" : "") +
         "; exporters leave attributes out: GLB has them if its option for attributes is on (of Blender's those that "
         "begin "
         "with _), and PLY often no weights and no floating-point colours";
}

}  // namespace

Error missing_attribute(const Symbol& symbol, const TriangleMesh& shape, const std::vector<std::string>& known) {
  std::string hint = components(symbol.name, shape);
  if (hint.empty()) hint = did_you_mean(symbol.name, known);
  if (hint.empty()) hint = "it has " + short_list(known) + why(known);
  return {Fault::usage, "the mesh has no vertex attribute \"" + symbol.name + "\"; " + hint, symbol.where};
}

}  // namespace pelage
