#include "gallery_page.h"

#include "io/xml_text.h"

namespace pelage {

namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Pelage: a gallery</title>
<style>
body { margin: 2rem auto; max-width: 76rem; padding: 0 1rem; font: 1rem/1.5 system-ui, sans-serif; color: #222; }
nav { columns: 16rem; margin-bottom: 2rem; }
nav a { display: block; }
a { color: #0b5f8a; text-decoration: none; }
section { border-top: 1px solid #ccc; padding: 0.5rem 0 1.5rem; }
h2 { margin: 0.5rem 0 0; font-size: 1.25rem; }
code { background: #f1f0ec; padding: 0.1rem 0.3rem; border-radius: 0.2rem; }
p { margin: 0.3rem 0; max-width: 60rem; }
.cite { color: #666; font-size: 0.9rem; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; margin-top: 0.8rem; }
figure { margin: 0; flex: 1 1 18rem; max-width: 36rem; }
img { width: 100%; height: auto; display: block; border: 1px solid #ddd; }
.failure { border: 1px solid #d9a; background: #fdf3f4; padding: 0.5rem 1rem; }
</style>
</head>
<body>
)";

/// A name that the fragment of an address may hold.
std::string anchor(const std::string& name) {
  std::string result;
  for (const char c : name) result += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '-';
  return result;
}

std::string paragraph(const std::string& text, const std::string& style = "") {
  if (text.empty()) return "";
  return "<p" + (style.empty() ? "" : " class=\"" + style + "\"") + ">" + escape_xml(text) + "</p>\n";
}

std::string figure(const GalleryPicture& picture, int size) {
  if (!picture.failure.empty()) return paragraph(picture.caption + ": " + picture.failure, "failure");
  const std::string file = escape_xml(picture.file);
  return "<figure><a href=\"" + file + "\"><img src=\"" + file + "\" width=\"" + std::to_string(size) +
         "\" loading=\"lazy\" alt=\"" + escape_xml(picture.caption) + "\"></a>" +
         (picture.uniform.empty() ? "" : paragraph("uniform: " + picture.uniform, "failure")) + "</figure>\n";
}

std::string section(const GalleryEntry& entry, int size) {
  std::string text = "<section id=\"" + anchor(entry.name) + "\">\n<h2>" + escape_xml(entry.title) + " <code>" +
                     escape_xml(entry.name) + "</code></h2>\n" + paragraph(entry.summary) +
                     paragraph(entry.cite, "cite") + "<div class=\"pictures\">\n";
  for (const GalleryPicture& picture : entry.pictures) text += figure(picture, size);
  return text + "</div>\n</section>\n";
}

}  // namespace

std::string gallery_page(const std::string& title, const std::vector<GalleryEntry>& entries, int picture_size) {
  std::string text = std::string(head) + "<h1>" + escape_xml(title) + "</h1>\n<nav>\n";
  for (const GalleryEntry& entry : entries)
    text += "<a href=\"#" + anchor(entry.name) + "\">" + escape_xml(entry.name) + "</a>\n";
  text += "</nav>\n";
  for (const GalleryEntry& entry : entries) text += section(entry, picture_size);
  return text + "</body>\n</html>\n";
}

}  // namespace pelage
