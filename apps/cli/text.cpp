#include "text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "base/memory.h"
#include "shape/generators.h"

namespace pelage {

namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, values...);
  return buffer;
}

}  // namespace

std::string brief(double value) { return format("%.3g", value); }

std::string file_size(std::uintmax_t bytes) { return bytes_in_words(static_cast<double>(bytes)); }

std::string duration(double seconds) {
  if (seconds < 9.95) return format("%.1f s", seconds);
  const long s = std::lround(std::min(seconds, 1e9));
  if (s < 60) return format("%ld s", s);
  if (s < 3600) return format("%ld min %ld s", s / 60, s % 60);
  return format("%ld h %ld min", s / 3600, s % 3600 / 60);
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  return text;
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::istringstream words(text);
  std::string result, line, word;
  const std::string margin(indent, ' ');
  while (words >> word) {
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
      result += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return result + margin + line + "\n";
}

std::string object_name(const ShapeFile& file, const std::string& path) {
  if (!file.name.empty()) return file.name;
  if (!is_builtin_shape(path)) return std::filesystem::path(path).stem().string();
  const std::string name = path.substr(path.find(':') + 1);
  return name.substr(0, name.find('?'));
}

}  // namespace pelage
