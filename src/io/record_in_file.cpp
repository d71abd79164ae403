#include "io/record_in_file.h"

#include <algorithm>
#include <pugixml.hpp>

#include "io/bytes.h"
#include "io/gltf_record.h"
#include "io/vtk_document.h"
#include "io/vtk_xml.h"
#include "io/zip.h"

namespace pelage {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view key = "pelage";

/// Of lines that begin with `prefix`, as comment_lines() makes them.
std::string in_comments(std::string_view bytes, std::string_view prefix) {
  std::size_t begin = 0;
  if (!bytes.starts_with(prefix)) {
    begin = bytes.find("\n" + std::string(prefix));
    if (begin == std::string_view::npos) return "";
    ++begin;
  }
  std::string text;
  for (bytes.remove_prefix(begin); bytes.starts_with(prefix);) {
    const std::size_t end = std::min(bytes.find('\n', prefix.size()), bytes.size() - 1);
    std::string_view line = bytes.substr(prefix.size(), end - prefix.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    text += line;
    bytes.remove_prefix(end + 1);
  }
  return text;
}

std::string in_comment_of_ply(std::string_view bytes) {
  return in_comments(bytes.substr(0, bytes.find("\nend_header")), "comment pelage ");
}
std::string in_hash_comment(std::string_view bytes) { return in_comments(bytes, "# pelage "); }
std::string in_comment_of_dxf(std::string_view bytes) { return in_comments(bytes, "999\npelage "); }

std::string in_png(std::string_view bytes) {
  constexpr std::size_t signature = 8, around = 12;  // length, name and checksum of a chunk
  for (std::size_t at = signature; at + around <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length = length << 8 | static_cast<unsigned char>(bytes[at + k]);
    const std::string_view data = bytes.substr(at + 8).substr(0, length);
    if (bytes.substr(at + 4, 4) == "tEXt" && data.starts_with("pelage\0"sv)) return std::string(data.substr(7));
    at += around + length;
  }
  return "";
}

std::string in_exr(std::string_view bytes) {
  const auto word = [&](std::size_t at) { return bytes.substr(at, std::min(bytes.find('\0', at), bytes.size()) - at); };
  for (std::size_t at = 8; at < bytes.size() && bytes[at] != '\0';) {
    const std::string_view name = word(at), type = word(std::min(at + name.size() + 1, bytes.size()));
    at += name.size() + type.size() + 2;
    const std::size_t length = bytes_at<std::uint32_t>(bytes, at).value_or(0xffffffffU);
    at += 4;
    if (length > bytes.size() || at > bytes.size() - length) return "";
    if (name == key && type == "string") return std::string(bytes.substr(at, length));
    at += length;
  }
  return "";
}

std::string in_ktx2(std::string_view bytes) {
  constexpr std::size_t place_of_facts = 56;
  std::size_t at = bytes_at<std::uint32_t>(bytes, place_of_facts).value_or(0);
  const std::size_t end = at + bytes_at<std::uint32_t>(bytes, place_of_facts + 4).value_or(0);
  while (at < end) {
    const auto length = bytes_at<std::uint32_t>(bytes, at);
    if (!length || *length > bytes.size() - at) return "";
    std::string_view entry = bytes.substr(at + 4, *length);
    if (entry.starts_with("pelage\0"sv)) {
      entry.remove_prefix(7);
      return std::string(entry.substr(0, entry.find('\0')));
    }
    at += 4 + (*length + 3) / 4 * 4;
  }
  return "";
}

/// Of the element that begins so.
std::string in_xml(std::string_view bytes, std::string_view tag) {
  constexpr std::string_view closing = "</metadata>";
  const std::size_t begin = bytes.find(tag), end = begin == bytes.npos ? begin : bytes.find(closing, begin);
  if (end == bytes.npos) return "";
  pugi::xml_document document;
  document.load_buffer(bytes.data() + begin, end + closing.size() - begin, pugi::parse_default, pugi::encoding_utf8);
  return document.child("metadata").text().as_string();
}

std::string in_svg(std::string_view bytes) { return in_xml(bytes, "<metadata id=\"pelage\""); }

std::string in_three_mf(std::string_view bytes) {
  return in_xml(zip_entry(bytes, "3D/3dmodel.model").value_or(""), "<metadata name=\"pelage:record\"");
}

std::string in_vtk(std::string_view bytes) {
  const VtkDocument document(bytes, "");
  for (const pugi::xml_node array : document.root().first_child().child("FieldData").children())
    if (array.attribute("Name").as_string() == std::string_view(vtk_record_name)) {
      const std::vector<std::string> strings = document.strings(array);
      return strings.empty() ? "" : strings[0];
    }
  return "";
}

struct Kind {
  const char* extension;
  std::string (*find)(std::string_view bytes);
};

constexpr Kind kinds[] = {{".glb", record_in_gltf},  {".gltf", record_in_gltf}, {".ply", in_comment_of_ply},
                          {".obj", in_hash_comment}, {".off", in_hash_comment}, {".vtp", in_vtk},
                          {".vtu", in_vtk},          {".vti", in_vtk},          {".vts", in_vtk},
                          {".3mf", in_three_mf},     {".svg", in_svg},          {".dxf", in_comment_of_dxf},
                          {".png", in_png},          {".exr", in_exr},          {".ktx2", in_ktx2}};

}  // namespace

std::vector<std::string> record_extensions() {
  std::vector<std::string> list;
  for (const Kind& kind : kinds) list.emplace_back(kind.extension);
  return list;
}

std::string record_in_file(std::string_view bytes, const std::string& extension) {
  const auto* kind = std::ranges::find(kinds, extension, &Kind::extension);
  return kind == std::end(kinds) ? "" : kind->find(bytes);
}

}  // namespace pelage
