#include "base/read_files.h"

#include <utility>

namespace pelage {

namespace {

ReadObserver current;

}  // namespace

ReadObserver observe_reading(ReadObserver observer) { return std::exchange(current, std::move(observer)); }

void note_reading(const std::string& path) {
  if (current.before) current.before(path);
}

void note_read(const std::string& path, std::string_view bytes) {
  if (current.after) current.after(path, bytes);
}

}  // namespace pelage
