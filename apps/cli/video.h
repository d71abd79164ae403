#pragma once
// Videos, by the program ffmpeg where it is installed.

#include <memory>
#include <string>

#include "io/atomic_file.h"
#include "pelage/image.h"

namespace pelage {

/// .mp4 or .webm.
bool is_video(const std::string& path);

/// Error(Fault::output) where ffmpeg is not installed.
void require_ffmpeg(const std::string& path);

/// Takes pictures of one size, 25 for a second. The file appears when it is closed, whole.
class Video {
 public:
  explicit Video(std::string path);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Error(Fault::output) when ffmpeg gives up.
  void add(const Image& image);
  /// Likewise.
  void close();

 private:
  void start(int width, int height);

  std::string path_;
  AtomicFile file_;
  int pipe_ = -1;
  int process_ = 0;
};

}  // namespace pelage
