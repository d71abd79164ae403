#include "patch_outputs.h"

#include <algorithm>
#include <filesystem>

#include "base/ascii.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/mtl_writer.h"
#include "pelage/error.h"

namespace pelage {

PatchTexture patch_texture(const CoatFields& fields, const Look& look, int size) {
  PatchTexture texture;
  texture.atlas = std::shared_ptr<const Atlas>(fields.nodes, as<Atlas>(fields.nodes));
  texture.layout = lay_out(*texture.atlas, size);
  texture.patches = patch_images(fields, look, texture.layout);
  texture.image = std::make_shared<const Image>(joined(texture.patches, texture.layout));
  return texture;
}

TriangleMesh with_uv(TriangleMesh coat, const PatchTexture& texture) {
  coat.set(patch_uv(*texture.atlas, texture.layout));
  return coat;
}

namespace {

/// Names of patches are anything.
std::string file_name(const std::string& patch) {
  std::string name = patch;
  for (char& c : name)
    if (!is_letter_or_digit(c) && c != '-' && c != '_') c = '_';
  return name + ".png";
}

/// Beside the .obj a .mtl with its material and the .png that this names.
std::vector<std::string> save_textured_obj(TriangleMesh coat, const std::string& path, const SaveOptions& form) {
  const std::string material = "coat";
  const auto beside = [&](const char* extension) { return std::filesystem::path(path).replace_extension(extension); };
  std::erase_if(coat.attributes, [](const Attribute& a) { return a.name == "color"; });
  coat.set({"material", 1, Domain::face, std::vector<double>(coat.triangles.size()), NumberType::int32, {material}});
  coat.links = {{"mtllib", beside(".mtl").filename().string()}};
  write_png(*form.texture, beside(".png").string());
  write_file(beside(".mtl").string(), mtl_text(material, beside(".png").filename().string()));
  save(coat, path, form);
  return {path, beside(".mtl").string(), beside(".png").string()};
}

}  // namespace

std::vector<std::string> save_textured(const TriangleMesh& coat, const std::string& path, const SaveOptions& form,
                                       const PatchTexture& texture) {
  const std::string extension = lower_extension(path);
  if (form.texture && extension == ".obj") return save_textured_obj(coat, path, form);
  if (extension == ".png")
    write_png(*texture.image, path);
  else
    save(coat, path, form);
  return {path};
}

std::vector<std::string> save_patches(const PatchTexture& texture, const std::string& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (reason) throw Error(Fault::output, "the folder cannot be made: " + reason.message(), {folder});
  std::vector<std::string> paths;
  for (std::size_t p = 0; p < texture.patches.size(); ++p) {
    std::string path = (std::filesystem::path(folder) / file_name(texture.atlas->patches[p].name)).string();
    if (std::ranges::count(paths, path) > 0)
      throw Error(Fault::output, "two patches would be written there; give them other names", {path});
    write_png(texture.patches[p], path);
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace pelage
