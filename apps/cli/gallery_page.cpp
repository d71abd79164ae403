#include "gallery_page.h"

#include "html_page.h"
#include "io/xml_text.h"

namespace pelage {

namespace {

std::string figure(const GalleryPicture& picture, int size) {
  if (!picture.failure.empty()) return page_paragraph(picture.caption + ": " + picture.failure, "failure");
  return "<figure>" + page_picture(picture.file, picture.caption, size) +
         (picture.uniform.empty() ? "" : page_paragraph("uniform: " + picture.uniform, "failure")) + "</figure>\n";
}

std::string section(const GalleryEntry& entry, int size) {
  std::string text = "<section id=\"" + page_anchor(entry.name) + "\">\n<h2>" + escape_xml(entry.title) + " <code>" +
                     escape_xml(entry.name) + "</code></h2>\n" + page_paragraph(entry.summary) +
                     page_paragraph(entry.cite, "cite") + "<div class=\"pictures\">\n";
  for (const GalleryPicture& picture : entry.pictures) text += figure(picture, size);
  return text + "</div>\n</section>\n";
}

}  // namespace

std::string gallery_page(const std::string& title, const std::vector<GalleryEntry>& entries, int picture_size) {
  std::string text = page_head(title) + "<nav>\n";
  for (const GalleryEntry& entry : entries)
    text += "<a href=\"#" + page_anchor(entry.name) + "\">" + escape_xml(entry.name) + "</a>\n";
  text += "</nav>\n";
  for (const GalleryEntry& entry : entries) text += section(entry, picture_size);
  return text + page_end;
}

}  // namespace pelage
