#pragma once
// Who wants to know which files are read.

#include <functional>
#include <string>

namespace pelage {

/// Is told of the path of every file before it is read, and may throw to prevent it.
using ReadObserver = std::function<void(const std::string& path)>;

/// One for the process; an empty one ends the telling. Not to be changed while other threads read.
void observe_reading(ReadObserver observer);

/// To be called by all who open a file for reading.
void note_reading(const std::string& path);

}  // namespace pelage
