#include "io/publication.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>

#include "io/file_bytes.h"
#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view heading = "pelage set 1\n", ending = "end";

/// Temporary names, which may hold any byte but zero.
std::string list_of(const std::vector<TemporaryFile>& files) {
  std::string text(heading);
  for (const TemporaryFile& file : files) text += file.name() + '\0';
  return text.append(ending);
}

/// None where the list was cut short or is something else.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  if (!text.starts_with(heading) || !text.ends_with(ending)) return names;
  text.remove_prefix(heading.size());
  for (std::size_t end = text.find('\0'); end != std::string_view::npos; end = text.find('\0')) {
    names.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return names;
}

/// A partial file of a run that is over: open, and locked, until this object goes.
class LeftFile {
 public:
  explicit LeftFile(const std::string& name)
      : file_(::open(name.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW)), mine_(file_ >= 0 && lock_file(file_)) {}
  ~LeftFile() {
    if (file_ >= 0) ::close(file_);
  }
  LeftFile(LeftFile&& other) noexcept : file_(std::exchange(other.file_, -1)), mine_(other.mine_) {}
  LeftFile& operator=(LeftFile&&) = delete;
  bool exists() const { return file_ >= 0; }
  bool mine() const { return mine_; }
  int file() const { return file_; }

 private:
  int file_;
  bool mine_;
};

std::string final_name(const std::string& partial) {
  return partial.substr(0, partial.size() - partial_extension.size());
}

std::string read_list(const std::string& list) {
  try {
    return read_file(list);
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

void put_all_in_place(std::vector<TemporaryFile> files) {
  for (TemporaryFile& file : files) file.sync();
  std::string list;
  if (files.size() > 1) {
    list = files.front().target() + publication_extension;
    TemporaryFile text(list);
    text.write(list_of(files));
    text.sync();
    text.put_in_place();
  }
  std::set<std::string> folders;
  for (TemporaryFile& file : files) {
    file.put_in_place();
    folders.insert(folder_of(file.target()));
  }
  for (const std::string& folder : folders) sync_folder(folder);
  if (!list.empty()) ::unlink(list.c_str());
}

void finish_publication(const std::string& list) {
  std::vector<std::string> names = names_in(read_list(list));
  std::erase_if(names, [](const std::string& name) { return !name.ends_with(partial_extension); });
  std::vector<LeftFile> files(names.begin(), names.end());
  if (std::ranges::any_of(files, [](const LeftFile& f) { return f.exists() && !f.mine(); })) return;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (files[k].exists()) std::rename(names[k].c_str(), final_name(names[k]).c_str());
  ::unlink(list.c_str());
}

void clear_leftovers(const std::string& folder) {
  std::vector<std::string> partials;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().string();
    if (name.ends_with(publication_extension)) finish_publication(name);
    if (name.ends_with(partial_extension)) partials.push_back(name);
  }
  for (const std::string& name : partials)
    if (const LeftFile left(name); left.mine() && is_at(left.file(), name)) ::unlink(name.c_str());
}

}  // namespace pelage
