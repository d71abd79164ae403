#pragma once
// Who wants to know which files are read.

#include <functional>
#include <string>
#include <string_view>

namespace pelage {

struct ReadObserver {
  /// Told of the path of every file before it is read; may throw to prevent it.
  std::function<void(const std::string& path)> before = {};
  /// Told of its bytes afterwards.
  std::function<void(const std::string& path, std::string_view bytes)> after = {};
};

/// One for the process; returns the one before. Not to be changed while other threads read.
ReadObserver observe_reading(ReadObserver observer);

/// To be called by all who open a file for reading, and with what they have read.
void note_reading(const std::string& path);
void note_read(const std::string& path, std::string_view bytes);

}  // namespace pelage
