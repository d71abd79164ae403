#pragma once
// Text in XML and HTML.

#include <string>

namespace pelage {

/// Text within elements or quotes; control characters become _.
std::string escape_xml(const std::string& text);

}  // namespace pelage
