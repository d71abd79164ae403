#include "video.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "base/srgb.h"
#include "io/file_bytes.h"
#include "pelage/error.h"

extern char** environ;  // NOLINT: POSIX asks for this declaration

namespace pelage {

bool is_video(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".mp4" || extension == ".webm";
}

void require_ffmpeg(const std::string& path) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (access((folder + "/ffmpeg").c_str(), X_OK) == 0) return;
  throw Error(Fault::output, path +
                                 ": a video needs the program ffmpeg, which is not installed; install it, or take a "
                                 ".png for pictures with numbers");
}

Video::Video(std::string path) : path_(std::move(path)), file_(path_) {}

void Video::start(int width, int height) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  std::vector<std::string> words = {"ffmpeg",
                                    "-v",
                                    "error",
                                    "-y",
                                    "-f",
                                    "rawvideo",
                                    "-pix_fmt",
                                    "rgb24",
                                    "-s",
                                    size,
                                    "-r",
                                    "25",
                                    "-i",
                                    "-",
                                    "-vf",
                                    "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                    "-pix_fmt",
                                    "yuv420p",
                                    "-f",
                                    lower_extension(path_).substr(1),
                                    file_.temporary_name()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // where ffmpeg ends early, writing to it fails
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw Error(Fault::output, path_ + ": no pipe to ffmpeg");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (failed != 0) throw Error(Fault::output, path_ + ": ffmpeg could not be started");
}

void Video::add(const Image& image) {
  if (process_ == 0) start(image.width, image.height);
  const SrgbBytes byte;
  std::vector<unsigned char> bytes;
  bytes.reserve(image.rgb.size());
  for (const float x : image.rgb) bytes.push_back(byte(x));
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::write(pipe_, bytes.data() + sent, bytes.size() - sent);
    if (n <= 0) throw Error(Fault::output, path_ + ": ffmpeg took no more pictures; its own message is above");
    sent += static_cast<std::size_t>(n);
  }
}

void Video::close() {
  if (process_ == 0) return;
  ::close(pipe_);
  pipe_ = -1;
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  if (status != 0) throw Error(Fault::output, path_ + ": ffmpeg failed; its own message is above");
  file_.commit();
}

Video::~Video() {
  if (process_ == 0) return;
  ::close(pipe_);
  waitpid(process_, nullptr, 0);
}

}  // namespace pelage
