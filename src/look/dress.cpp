#include "look/dress.h"

#include <algorithm>
#include <set>
#include <utility>

#include "look/cut_tessellation.h"
#include "react/formula.h"
#include "shape/normals.h"
#include "shape/relief.h"

namespace pelage {

namespace {

std::vector<double> flattened(const std::vector<Point>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Point& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

/// "STAGE.SPECIES" as file formats like it.
std::string attribute_name(std::string field) {
  std::ranges::replace(field, '.', '_');
  return field;
}

/// How many of the fields from i on are one attribute: of u_1, u_2, u_3 the vector u.
std::size_t width_of_field(const std::vector<std::string>& species, std::size_t i) {
  const std::string& first = species[i];
  if (!first.ends_with("_1") || i + 2 >= species.size()) return 1;
  const std::string vector = first.substr(0, first.size() - 2);
  return species[i + 1] == component_name(vector, 2) && species[i + 2] == component_name(vector, 3) ? 3 : 1;
}

/// The fields as attributes, components of vectors together.
std::vector<Attribute> field_attributes(const std::vector<std::string>& species,
                                        const std::vector<std::vector<double>>& fields) {
  std::vector<Attribute> attributes;
  for (std::size_t i = 0; i < fields.size();) {
    const std::size_t width = width_of_field(species, i), count = fields[i].size();
    const std::string name = width > 1 ? species[i].substr(0, species[i].size() - 2) : species[i];
    Attribute& a = attributes.emplace_back(
        Attribute{attribute_name(name), static_cast<int>(width), Domain::vertex, std::vector<double>(width * count)});
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t v = 0; v < count; ++v) a.values[width * v + k] = fields[i + k][v];
    i += width;
  }
  return attributes;
}

/// By its heights, which it then has in its vertices.
TriangleMesh displaced(TriangleMesh mesh) {
  const std::string_view height = kind_of(Channel::height).attribute;
  const std::vector<double> values = mesh.find(height)->values;
  std::erase_if(mesh.attributes, [&](const Attribute& a) { return a.name == height; });
  return raised(std::move(mesh), values);
}

/// The attributes of a coat and those that it finds.
class CoatNames {
 public:
  CoatNames(const std::vector<Attribute>& attributes, const Paint& paint) : own_{"color"} {
    for (const Attribute& a : attributes) given_.insert(a.name);
    for (std::size_t i = 0; paint.fields && i < paint.species.size(); ++i) {
      own_.insert(attribute_name(paint.species[i]));
      if (width_of_field(paint.species, i) > 1)
        own_.insert(attribute_name(paint.species[i].substr(0, paint.species[i].size() - 2)));
    }
    for (const auto& [channel, formula] : paint.channels) own_.emplace(kind_of(channel).attribute);
  }
  /// What makes room takes the place of another, which makes room in turn.
  bool in_the_way(const std::string& name) const {
    const std::string prefix = input_name("");
    if (own_.contains(name)) return true;
    const std::string before = name.starts_with(prefix) ? name.substr(prefix.size()) : "";
    return given_.contains(before) && in_the_way(before);
  }

 private:
  std::set<std::string> own_, given_;
};

}  // namespace

void rename_input(std::vector<Attribute>& attributes, const Paint& paint) {
  const CoatNames names(attributes, paint);
  for (Attribute& a : attributes)
    if (names.in_the_way(a.name)) a.name = input_name(a.name);
}

TriangleMesh dress(Tessellation t, const Paint& paint, const std::vector<char>& uniform) {
  const Palette palette = make_palette(paint, t.samples, uniform);
  return dress(std::move(t), palette);
}

TriangleMesh dress(Tessellation t, const Palette& palette) {
  std::vector<double> color = pelage::paint(t.samples, palette);
  const Paint& paint = palette.paint;
  std::vector<Attribute> channels;
  for (const auto& [channel, formula] : paint.channels)
    channels.push_back(
        {std::string(kind_of(channel).attribute), 1, Domain::vertex, channel_values(t.samples, paint, channel)});
  rename_input(t.attributes, paint);
  TriangleMesh mesh{std::move(t.samples.position), std::move(t.triangles), {}, std::move(t.links), t.metres_per_unit};
  mesh.set(t.sharp                   ? corner_normals(mesh.triangles, mesh.points)
           : t.corner_normal.empty() ? Attribute{"normal", 3, Domain::vertex, flattened(t.samples.normal)}
                                     : Attribute{"normal", 3, Domain::corner, flattened(t.corner_normal)});
  mesh.set({"color", 3, Domain::vertex, std::move(color)});
  if (paint.fields)
    for (Attribute& a : field_attributes(paint.species, t.samples.fields)) mesh.set(std::move(a));
  for (auto* more : {&channels, &t.attributes})
    for (Attribute& a : *more) mesh.set(std::move(a));
  return paint.displace && paint.channels.contains(Channel::height) ? displaced(std::move(mesh)) : mesh;
}

Grid on_grid(Grid grid, const TriangleMesh& coat) {
  grid.attributes = coat.attributes;
  if (grid.even()) std::erase_if(grid.attributes, [](const Attribute& a) { return a.name == "normal"; });
  return grid;
}

TriangleMesh dress_nodes(const CoatFields& fields, const Look& look) {
  const Paint paint = resolve_paint(look, fields.species);
  return dress(tessellate_nodes(fields, tessellation_request(look, paint)), paint, fields.uniform);
}

TriangleMesh dress(const CoatFields& fields, const Look& look) {
  const Paint paint = resolve_paint(look, fields.species);
  return dress(tessellate_for(fields, look, paint), paint, fields.uniform);
}

}  // namespace pelage
