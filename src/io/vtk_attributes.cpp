#include "io/vtk_attributes.h"

#include <algorithm>
#include <cmath>

#include "io/vertex_colors.h"
#include "io/vtk_xml.h"

namespace pelage {

namespace {

/// How our attributes are called that VTK's programs know by another name.
std::string attribute_name(const std::string& array) {
  if (array == "RGB" || array == "RGBA") return "color";
  if (array == "Normals") return "normal";
  return array == "TextureCoordinates" ? "uv" : array;
}

std::size_t components_of(const VtkDocument& document, pugi::xml_node array) {
  constexpr std::int64_t most = 1024;
  return static_cast<std::size_t>(document.whole(array, "NumberOfComponents", 1, 1, most));
}

}  // namespace

std::vector<Attribute> VtkAttributes::read(const char* section, Domain domain, const Join& join) const {
  std::vector<Attribute> attributes;
  std::size_t number = 0;
  for (const pugi::xml_node array : pieces_[0].child(section).children()) {
    const std::string name = array.attribute("Name").as_string();
    if (name != vtk_ghosts) {
      if (!VtkDocument::type_of(array))
        note("left-out", "the values \"" + name + "\" are no numbers; left out");
      else
        add(read_one(array, name.empty() ? "array_" + std::to_string(number) : name, section, domain, join), array,
            attributes);
    }
    ++number;
  }
  return attributes;
}

Attribute VtkAttributes::read_one(pugi::xml_node first, const std::string& name, const char* section, Domain domain,
                                  const Join& join) const {
  const std::size_t components = components_of(document_, first);
  Attribute a{attribute_name(name), static_cast<int>(components), domain, {}, *VtkDocument::type_of(first)};
  a.values = join(components, [&](std::size_t piece) {
    if (piece == 0) return first;
    const pugi::xml_node array =
        pieces_[piece].child(section).find_child_by_attribute("Name", first.attribute("Name").as_string());
    if (!array || components_of(document_, array) != components ||
        VtkDocument::type_of(array) != VtkDocument::type_of(first))
      document_.fail(pieces_[piece], "the piece has no array \"" + name + "\" as the first one has");
    return array;
  });
  return a;
}

void VtkAttributes::add(Attribute a, pugi::xml_node array, std::vector<Attribute>& attributes) const {
  if (std::string_view(array.attribute("type").as_string()).ends_with("Int64")) narrow(a);
  if (is_color(a)) {
    const std::string name = a.name;
    a = linear_color(std::move(a.values), a.components, findings_, a.type, a.domain);
    a.name = name;
  }
  if (std::ranges::count(attributes, a.name, &Attribute::name) > 0)
    note("left-out", "a second array \"" + a.name + "\" is left out");
  else
    attributes.push_back(std::move(a));
}

/// The type of 64 bit integers: 32 bits where they have room.
void VtkAttributes::narrow(Attribute& a) const {
  if (a.values.empty()) return;
  const auto [low, high] = std::ranges::minmax(a.values);
  constexpr double exact = 9007199254740992.0;
  if (low >= -2147483648.0 && high <= 2147483647.0)
    a.type = NumberType::int32;
  else if (low >= 0 && high <= 4294967295.0)
    a.type = NumberType::uint32;
  else if (low < -exact || high > exact)
    note("rounded-integers", "the array \"" + a.name + "\" has integers of more than 53 bits: rounded");
}

void VtkAttributes::read_field_data(
    pugi::xml_node data, std::vector<Attribute>& attributes, std::optional<double>& metres_per_unit,
    const std::function<bool(pugi::xml_node array, const std::string& name)>& take) const {
  for (const pugi::xml_node parent : {data, document_.root()})
    for (const pugi::xml_node array : parent.child("FieldData").children()) {
      const std::string name = array.attribute("Name").as_string();
      if (!take(array, name) && !take_common(array, name, attributes, metres_per_unit) && name != "TimeValue" &&
          name != vtk_record_name)
        note("left-out", "the field data \"" + name + "\" are left out");
    }
}

bool VtkAttributes::take_common(pugi::xml_node array, const std::string& name, std::vector<Attribute>& attributes,
                                std::optional<double>& metres_per_unit) const {
  constexpr std::string_view labels = "_labels";
  if (name == "metres_per_unit") {
    metres_per_unit = document_.values(array, 1)[0];
    if (!(*metres_per_unit > 0 && std::isfinite(*metres_per_unit)))
      document_.fail(array, "metres_per_unit is not greater than 0");
    return true;
  }
  if (!name.ends_with(labels)) return false;
  const auto a = std::ranges::find(attributes, name.substr(0, name.size() - labels.size()), &Attribute::name);
  if (a == attributes.end()) return false;
  a->labels = document_.strings(array);
  return true;
}

}  // namespace pelage
