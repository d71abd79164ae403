#include "io/jpeg_reader.h"

#include <turbojpeg.h>

#include <memory>
#include <type_traits>

#include "pelage/error.h"

namespace pelage {

namespace {

using namespace std::string_view_literals;

/// A progressive image is decoded once for each of its scans, which cost next to no bytes. Cameras and programs write
/// about ten; sixteen of the largest image, or hundreds of a small one.
constexpr double most_work = 16.0 * most_pixels;

/// As many as the file has, or more: the marker may also stand in a comment.
std::size_t count_scans(std::string_view bytes) {
  constexpr std::string_view marker = "\xff\xda";
  std::size_t count = 0;
  for (std::size_t at = bytes.find(marker); at != std::string_view::npos; at = bytes.find(marker, at + 2)) ++count;
  return count;
}

const unsigned char* data(std::string_view bytes) { return reinterpret_cast<const unsigned char*>(bytes.data()); }

class JpegFile {
 public:
  JpegFile(std::string_view bytes, const std::string& path)
      : bytes_(bytes), path_(path), decoder_(tjInitDecompress(), tjDestroy) {
    if (!decoder_) throw std::bad_alloc();
    int sampling = 0;
    const int outcome =
        tjDecompressHeader3(decoder_.get(), data(bytes), bytes.size(), &width_, &height_, &sampling, &space_);
    // Whether the colours are sampled in one of the usual ways is of no interest to the decoder.
    if (outcome != 0 && (sampling >= 0 || space_ < 0)) refuse_image(message(), path);
    constexpr double least_bits = 1.0 / 64;  // one for the brightness of every eight by eight pixels
    require_possible({width_, height_, least_bits}, bytes.size(), path);
    if (static_cast<double>(count_scans(bytes)) * width_ * height_ > most_work)
      throw Error(Fault::input,
                  "is a JPEG image in " + std::to_string(count_scans(bytes)) +
                      " scans, too many for its size; write it again, or as PNG",
                  {path});
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int space() const { return space_; }

  std::vector<unsigned char> pixels(int format) const {
    std::vector<unsigned char> pixels(static_cast<std::size_t>(tjPixelSize[format]) * width_ * height_);
    const int outcome = tjDecompress2(decoder_.get(), data(bytes_), bytes_.size(), pixels.data(), width_, 0, height_,
                                      format, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS);
    if (outcome != 0 && !is_whole()) refuse_image(message(), path_);
    return pixels;
  }

 private:
  std::string message() const { return tjGetErrorStr2(decoder_.get()); }

  /// Whether the fault is one of those that some cameras make: bytes between the picture and the mark of its end. The
  /// decoder tells the first fault only, so that there was none before.
  bool is_whole() const {
    return tjGetErrorCode(decoder_.get()) == TJERR_WARNING &&
           message().find("extraneous bytes before marker 0xd9") != std::string::npos;
  }

  std::string_view bytes_;
  const std::string& path_;
  std::unique_ptr<std::remove_pointer_t<tjhandle>, int (*)(tjhandle)> decoder_;
  int width_ = 0, height_ = 0, space_ = -1;
};

std::vector<std::uint16_t> samples_of(const std::vector<unsigned char>& bytes) {
  std::vector<std::uint16_t> samples;
  samples.reserve(bytes.size());
  for (const unsigned char byte : bytes) samples.push_back(static_cast<std::uint16_t>(257 * byte));  // 255: 65535
  return samples;
}

/// Of inks, which are stored as what they leave of the light.
std::vector<std::uint16_t> colours_of(const std::vector<unsigned char>& cmyk) {
  std::vector<std::uint16_t> rgb;
  rgb.reserve(cmyk.size() / 4 * 3);
  for (std::size_t at = 0; at < cmyk.size(); at += 4)
    for (std::size_t k = 0; k < 3; ++k)
      rgb.push_back(static_cast<std::uint16_t>(257 * ((cmyk[at + k] * cmyk[at + 3] + 127) / 255)));
  return rgb;
}

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"sv); }

void check_jpeg(std::string_view bytes, const std::string& path) { JpegFile(bytes, path); }

StoredImage read_jpeg(std::string_view bytes, const std::string& path) {
  const JpegFile file(bytes, path);
  const bool grey = file.space() == TJCS_GRAY, inks = file.space() == TJCS_CMYK || file.space() == TJCS_YCCK;
  StoredImage image{file.width(), file.height(), grey ? 1 : 3, false, {}};
  image.samples = inks ? colours_of(file.pixels(TJPF_CMYK)) : samples_of(file.pixels(grey ? TJPF_GRAY : TJPF_RGB));
  return image;
}

}  // namespace pelage
