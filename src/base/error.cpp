#include "pelage/error.h"

namespace pelage {

std::string to_string(const Location& where) {
  std::string text = where.file;
  if (where.line > 0) text += (text.empty() ? "line " : ":") + std::to_string(where.line);
  if (where.column > 0) text += ":" + std::to_string(where.column);
  return text;
}

namespace {
std::string join(const std::string& message, const Location& where) {
  const std::string place = to_string(where);
  std::string line = place.empty() ? message : place + ": " + message;
  for (char& c : line)  // what stands in a file may be quoted
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return line;
}
}  // namespace

Error::Error(Fault fault, const std::string& message, const Location& where)
    : std::runtime_error(join(message, where)), fault_(fault), where_(where) {}

}  // namespace pelage
