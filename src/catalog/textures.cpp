#include "catalog/textures.h"

#include "catalog/names.h"
#include "io/texture_reader.h"
#include "run/random_points.h"

namespace pelage {

Places named_places(const TriangleMesh& shape, const std::vector<Texture>& textures) {
  Places places;
  for (const auto& [name, values] : scalar_attributes(shape.attributes)) places.attributes[name] = {};
  for (const Texture& texture : textures)
    for (const std::string& name : attribute_names(texture.name)) places.attributes[name] = {};
  return places;
}

namespace {

void require_uv(const TriangleMesh& shape, const Given<std::string>& texture) {
  const Attribute* uv = shape.find("uv");
  if (!uv || uv->components != 2)
    throw Error(Fault::usage,
                "the shape has no uv, by which the texture \"" + texture.value +
                    "\" would be laid on it; unwrap it and export it with uv",
                texture.where);
}

void require_free(const TextureFile& file, const std::string& name, const Places& known) {
  if (known.attributes.contains(name))
    throw Error(
        Fault::usage,
        "the texture \"" + file.name.value + "\" would hide another attribute \"" + name + "\"; give it another name",
        file.name.where);
}

}  // namespace

std::vector<Texture> resolve_textures(const std::vector<TextureFile>& files, const TriangleMesh& shape) {
  std::vector<Texture> textures;
  for (const TextureFile& file : files) {
    require_name(file.name);
    Places known = named_places(shape, textures);
    known.attributes[points_attribute] = {};
    for (const std::string& name : attribute_names(file.name.value)) require_free(file, name, known);
    if (!shape.triangles.empty()) require_uv(shape, file.name);
    Texture& texture = textures.emplace_back();
    if (shape.triangles.empty())
      check_texture(file.path);
    else
      texture = read_texture(file.path);
    texture.name = file.name.value;
  }
  return textures;
}

}  // namespace pelage
