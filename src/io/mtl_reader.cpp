#include "io/mtl_reader.h"

#include <filesystem>
#include <utility>

#include "base/named_files.h"
#include "base/srgb.h"
#include "io/file_bytes.h"
#include "io/text_scanner.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// Options of an image stand before its name: "-s 1 1 1 skin.png".
std::string image_name(std::string_view rest) {
  if (!rest.starts_with('-')) return std::string(rest);
  const std::size_t blank = rest.find_last_of(" \t");
  return std::string(blank == std::string_view::npos ? rest : rest.substr(blank + 1));
}

void read_color(TextScanner& text, MtlMaterial& material) {
  TextScanner ahead = text;
  const std::string_view first = ahead.word();
  if (first == "spectral" || first == "xyz") return;
  material.color[0] = material.color[1] = material.color[2] = linear_from_srgb(text.number("a colour"));
  for (std::size_t k = 1; k < 3 && !text.at_line_end(); ++k)
    material.color[k] = linear_from_srgb(text.number("a colour"));
  material.colored = true;
}

void parse(std::string_view bytes, const std::string& path, std::map<std::string, MtlMaterial>& materials) {
  TextScanner text(bytes, path);
  MtlMaterial* material = nullptr;
  for (; !text.at_end(); text.skip_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "newmtl")
      material = &(materials[std::string(text.rest_of_line())] = {});
    else if (keyword == "Kd" && material)
      read_color(text, *material);
    else if (keyword == "map_Kd" && material)
      material->image = image_name(text.rest_of_line());
  }
}

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// One name, which may have blanks in it, or several names.
std::vector<std::string> libraries(const std::filesystem::path& folder, const std::string& names) {
  if (is_file(folder / names)) return {names};
  std::vector<std::string> list;
  TextScanner words(names, "");
  for (std::string_view word = words.word(); !word.empty(); word = words.word()) list.emplace_back(word);
  return list;
}

void note(std::vector<Finding>& findings, const std::string& kind, const std::string& text) {
  findings.push_back({kind, text, 1, 0, false});
}

void read_library(const std::string& shape_path, const std::string& library,
                  std::map<std::string, MtlMaterial>& materials, std::vector<Finding>& findings) {
  const std::string path = path_beside(shape_path, library);
  if (!may_read_beside(shape_path, library))
    return note(findings, "outside-file",
                "the material library " + in_quotes(library) +
                    " lies outside the folder of this file; its colours are left out: --allow-outside reads it");
  if (!is_file(path))
    return note(findings, "missing-file",
                "the material library " + in_quotes(library) + " is not there; its colours are left out");
  std::map<std::string, MtlMaterial> own;
  try {
    parse(read_file(path), path, own);
  } catch (const Error& error) {
    return note(findings, "unreadable-file", std::string(error.what()) + "; its colours are left out");
  }
  for (auto& [name, material] : own) {
    if (!material.image.empty())
      note(findings, "image-not-read",
           "the material " + in_quotes(name) + " has the image " + in_quotes(material.image) +
               "; name it with --texture to read it");
    materials.insert_or_assign(name, std::move(material));
  }
}

}  // namespace

void read_mtl(const std::string& shape_path, const std::string& names, std::map<std::string, MtlMaterial>& materials,
              std::vector<Finding>& findings) {
  const std::filesystem::path folder = std::filesystem::path(shape_path).parent_path();
  for (const std::string& library : libraries(folder, names)) read_library(shape_path, library, materials, findings);
}

}  // namespace pelage
