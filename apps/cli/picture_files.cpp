#include "picture_files.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include "io/atomic_file.h"
#include "io/exr_writer.h"
#include "io/file_bytes.h"
#include "io/png_writer.h"
#include "pelage/io.h"
#include "video.h"

namespace pelage {

namespace {

bool is_exr(const std::string& path) { return lower_extension(path) == ".exr"; }

void write_exr_picture(const Image& image, const std::string& path) {
  const std::size_t pixels = image.rgb.size() / 3;
  std::vector<std::vector<float>> planes(3, std::vector<float>(pixels));
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t k = 0; k < 3; ++k) planes[k][i] = image.rgb[3 * i + k];
  write_exr(path, {"R", "G", "B"}, planes, image.width, image.height);
}

/// Picture k of a turntable of n.
PictureOptions turned(PictureOptions picture, int k, int n) {
  picture.azimuth = std::remainder(picture.azimuth + 360.0 * k / n, 360);
  picture.steady = true;
  return picture;
}

}  // namespace

std::string numbered(const std::string& path, int frame) {
  const std::filesystem::path p(path);
  std::string number = std::to_string(frame);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  return (p.parent_path() / (p.stem().string() + "." + number + p.extension().string())).string();
}

void check_picture_files(const std::string& path, const ViewOptions& view, int size) {
  if (is_video(path)) {
    if (!view.turntable) throw Error(Fault::usage, path + ": a video goes around the shape; give --turntable N");
    require_ffmpeg(path);
    return expect_output(path);
  }
  if (!is_exr(path) && lower_extension(path) != ".png")
    throw Error(Fault::usage, "pictures are written as PNG or EXR; end the name in .png or .exr", {path});
  expect_output(path);
  check_picture_size(size, size, path);
}

PictureOptions suited_to(const std::string& path, PictureOptions picture) {
  picture.dither = !is_exr(path);
  return picture;
}

void save_picture(const Image& image, const std::string& path) {
  if (is_exr(path))
    write_exr_picture(image, path);
  else
    write_png(image, path);
}

std::string first_picture(const std::string& path, const ViewOptions& view) {
  return view.turntable && !is_video(path) ? numbered(path, 1) : path;
}

PictureFile take_pictures(const std::string& path, const ViewOptions& view, const PictureOptions& picture,
                          const std::function<Image(const PictureOptions&)>& take) {
  const PictureOptions first = suited_to(path, picture);
  if (!view.turntable) {
    save_picture(take(first), path);
    return {path, ""};
  }
  const int n = *view.turntable;
  std::optional<Video> video;
  if (is_video(path)) video.emplace(path);
  for (int k = 0; k < n; ++k) {
    const Image image = take(turned(first, k, n));
    if (video)
      video->add(image);
    else
      save_picture(image, numbered(path, k + 1));
  }
  if (video) video->close();
  return {first_picture(path, view),
          std::to_string(n) + " pictures around" + (video ? "" : ", the last one " + numbered(path, n))};
}

}  // namespace pelage
