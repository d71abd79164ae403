#include "html_page.h"

#include "io/xml_text.h"

namespace pelage {

namespace {

constexpr const char* style = R"(<style>
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
figcaption { font-size: 0.9rem; margin-top: 0.3rem; }
figure { margin: 0; flex: 1 1 18rem; max-width: 36rem; }
img { width: 100%; height: auto; display: block; border: 1px solid #ddd; }
code.command { display: block; margin: 0.3rem 0; white-space: pre-wrap; font-size: 0.8rem; }
.failure { border: 1px solid #d9a; background: #fdf3f4; padding: 0.5rem 1rem; }
</style>
)";

}  // namespace

std::string page_head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Pelage: " +
         escape_xml(title) + "</title>\n" + style + "</head>\n<body>\n<h1>" + escape_xml(title) + "</h1>\n";
}

std::string page_anchor(const std::string& name) {
  std::string result;
  for (const char c : name) result += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '-';
  return result;
}

std::string page_paragraph(const std::string& text, const std::string& style_name) {
  if (text.empty()) return "";
  return "<p" + (style_name.empty() ? "" : " class=\"" + style_name + "\"") + ">" + escape_xml(text) + "</p>\n";
}

std::string page_picture(const std::string& file, const std::string& caption, int width) {
  const std::string name = escape_xml(file);
  return "<a href=\"" + name + "\"><img src=\"" + name + "\" width=\"" + std::to_string(width) +
         "\" loading=\"lazy\" alt=\"" + escape_xml(caption) + "\"></a>";
}

}  // namespace pelage
