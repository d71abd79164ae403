#pragma once
// The index of a gallery: one page without scripts, with relative links.

#include <string>
#include <vector>

namespace pelage {

struct GalleryPicture {
  std::string file;     ///< in the folder of the page
  std::string caption;  ///< what it shows
  std::string failure;  ///< instead of the picture, if not empty
  std::string uniform;  ///< why it shows no pattern, if it shows none
  bool made = false;    ///< the file is there
};

/// A model, a variant or a recipe.
struct GalleryEntry {
  std::string name;  ///< what the option --model or --recipe takes
  std::string title, summary, cite;
  std::vector<GalleryPicture> pictures;
};

/// The text of index.html; `title`: "Models" or "Recipes".
std::string gallery_page(const std::string& title, const std::vector<GalleryEntry>& entries, int picture_size);

}  // namespace pelage
