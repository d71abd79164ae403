#pragma once
// What the pages of pictures have in common: one file without scripts, with relative links.

#include <string>

namespace pelage {

/// All up to the first heading, which is `title`.
std::string page_head(const std::string& title);

/// A name as the fragment of an address may hold it.
std::string page_anchor(const std::string& name);

/// Nothing for no text.
std::string page_paragraph(const std::string& text, const std::string& style = "");

/// A picture that leads to itself in full.
std::string page_picture(const std::string& file, const std::string& caption, int width);

constexpr const char* page_end = "</body>\n</html>\n";

}  // namespace pelage
