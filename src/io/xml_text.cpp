#include "io/xml_text.h"

namespace pelage {

std::string escape_xml(const std::string& text) {
  std::string safe;
  for (char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"')
      safe += "&#" + std::to_string(static_cast<int>(c)) + ";";
    else
      safe += static_cast<unsigned char>(c) < ' ' ? '_' : c;
  }
  return safe;
}

}  // namespace pelage
