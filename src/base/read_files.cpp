#include "base/read_files.h"

#include <utility>

namespace pelage {

namespace {

ReadObserver current;

}  // namespace

void observe_reading(ReadObserver observer) { current = std::move(observer); }

void note_reading(const std::string& path) {
  if (current) current(path);
}

}  // namespace pelage
