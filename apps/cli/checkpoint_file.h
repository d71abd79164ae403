#pragma once
// The state of a run in a file, again and again, and the command that goes on from it.

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "run/run.h"

namespace pelage {

/// Keeps two generations: FILE, and FILE.previous should FILE be damaged one day.
class CheckpointFile {
 public:
  /// `path`: empty where nothing is kept until keep_at().
  CheckpointFile(std::string path, double minutes) : path_(std::move(path)), pause_(60 * minutes) {}

  const std::string& path() const { return path_; }
  /// For a growth that turns out to take long: a file that goes away with finish().
  void keep_at(const std::string& path);
  /// Saves at the end of a stage, and when the last time is long enough ago.
  void look_at(const Run& run);
  void save(const Run& run);
  /// The outputs are there.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string path_;
  std::chrono::duration<double> pause_;
  bool automatic_ = false;
  Clock::time_point last_ = Clock::now();
  std::size_t stage_ = 0;
};

/// What Run::restore takes. Where FILE is damaged or gone and FILE.previous is not, `warn` is told and that is read.
/// Error(Fault::input), with the file.
std::string read_checkpoint(const std::string& path, const std::function<void(const std::string&)>& warn);

/// The words of the command whose state this is, so that it goes on from there, and whose folder is then that of the
/// process. Error(Fault::input) where the checkpoint is none, or was written by a program that uses the library.
std::vector<std::string> words_to_resume(const std::string& path);

}  // namespace pelage
