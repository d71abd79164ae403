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
  return place.empty() ? message : place + ": " + message;
}
}  // namespace

Error::Error(Fault fault, const std::string& message, const Location& where)
    : std::runtime_error(join(message, where)), fault_(fault), where_(where) {}

}  // namespace pelage
