#include "base/named_files.h"

#include <algorithm>
#include <filesystem>

namespace pelage {

namespace {

namespace fs = std::filesystem;

bool outside_allowed = false;

/// Without links and "..", as far as there is such a path; empty where that cannot be known.
fs::path true_path(const fs::path& path) {
  std::error_code code;
  const fs::path whole = fs::absolute(path, code);
  if (code) return {};
  const fs::path result = fs::weakly_canonical(whole, code);
  return code ? fs::path{} : result;
}

}  // namespace

void allow_outside_files(bool allowed) { outside_allowed = allowed; }

std::string path_beside(const std::string& by, const std::string& name) {
  return (fs::path(by).parent_path() / name).string();
}

bool may_read_beside(const std::string& by, const std::string& name) {
  if (outside_allowed) return true;
  const fs::path parent = fs::path(by).parent_path();
  const fs::path folder = true_path(parent.empty() ? fs::path(".") : parent), file = true_path(path_beside(by, name));
  if (folder.empty() || file.empty()) return false;
  // A folder that ends in a separator has an empty last part.
  const auto end = folder.filename().empty() ? std::prev(folder.end()) : folder.end();
  return std::mismatch(folder.begin(), end, file.begin(), file.end()).first == end;
}

std::string named_file(const std::string& name, const Location& where) {
  if (!may_read_beside(where.file, name))
    throw Error(Fault::usage, "\"" + name + "\" is a file " + outside_hint, where);
  return path_beside(where.file, name);
}

std::string named_text(const std::string& name, const Location& where) {
  return name.find(".toml") == std::string::npos ? name : named_file(name, where);
}

std::string named_shape(const std::string& name, const Location& where) {
  return name.empty() || name.starts_with("builtin:") ? name : named_file(name, where);
}

}  // namespace pelage
