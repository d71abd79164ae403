#pragma once
// The font file that is compiled in; defined in a source that the build writes (cmake/embed_font.cmake).

#include <string_view>

namespace pelage {

/// DejaVuSans.ttf.
std::string_view font_file();

}  // namespace pelage
