#pragma once
// Files of pictures of shapes: PNG and EXR, one or all around.

#include <functional>
#include <string>
#include <vector>

#include "pelage/image.h"
#include "view_options.h"

namespace pelage {

/// "walk.png" -> "walk.0007.png".
std::string numbered(const std::string& path, int frame);

/// Refuses a name that ends in none of .png, .exr and, with --turntable, .mp4 and .webm, pictures of a size (longer
/// side) that its file cannot have (Fault::usage), and a folder that cannot be written to (Fault::output). Before the
/// work.
void check_picture_files(const std::string& path, const ViewOptions& view, int size);

/// What a picture's file can hold: EXR needs no dither.
PictureOptions suited_to(const std::string& path, PictureOptions picture);

/// As PNG or EXR, whatever the name says.
void save_picture(const Image& image, const std::string& path);

/// The first of the files that take_pictures writes.
std::string first_picture(const std::string& path, const ViewOptions& view);

/// What was written, as reports name it: a file, or the first of many.
struct PictureFile {
  std::string path, about;
};

/// Takes a picture, or with --turntable those of a whole turn, and writes them.
PictureFile take_pictures(const std::string& path, const ViewOptions& view, const PictureOptions& picture,
                          const std::function<Image(const PictureOptions&)>& take);

}  // namespace pelage
