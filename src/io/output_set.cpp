#include "io/output_set.h"

#include <algorithm>
#include <utility>

#include "base/read_files.h"
#include "io/publication.h"
#include "pelage/error.h"

namespace pelage {

namespace {

OutputSet* alive = nullptr;

auto find(std::vector<TemporaryFile>& files, const std::string& target) {
  return std::ranges::find(files, target, [](const TemporaryFile& f) { return f.target(); });
}

[[noreturn]] void refuse_replacing(const std::string& path) {
  throw Error(Fault::usage,
              "the output " + path + " is an input itself; give it another name, or --force to replace it");
}

}  // namespace

OutputSet* OutputSet::current() { return alive; }

OutputSet::OutputSet(bool may_replace_inputs) : may_replace_inputs_(may_replace_inputs) {
  alive = this;
  observe_reading([this](const std::string& path) { read(path); });
}

OutputSet::~OutputSet() {
  observe_reading({});
  alive = nullptr;
}

void OutputSet::read(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const std::string target = true_path(path);
  const auto reserved = find(reserved_, target);
  if (reserved != reserved_.end() && !may_replace_inputs_) refuse_replacing(reserved->path());
  read_.push_back(target);
}

TemporaryFile OutputSet::reserved(const std::string& path) {
  const std::string target = true_path(path), folder = folder_of(target);
  if (find(reserved_, target) != reserved_.end() || find(kept_, target) != kept_.end())
    throw Error(Fault::usage, "two outputs are the same file, " + path + "; give one of them another name");
  if (!may_replace_inputs_ && std::ranges::count(read_, target) > 0) refuse_replacing(path);
  if (std::ranges::count(cleared_, folder) == 0) {
    clear_leftovers(folder);
    cleared_.push_back(folder);
  }
  return TemporaryFile(path);
}

void OutputSet::reserve(const std::string& path) {
  const std::lock_guard lock(mutex_);
  reserved_.push_back(reserved(path));
}

TemporaryFile OutputSet::take(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto found = find(reserved_, true_path(path));
  if (found == reserved_.end()) return reserved(path);
  TemporaryFile file = std::move(*found);
  reserved_.erase(found);
  return file;
}

void OutputSet::keep(TemporaryFile file) {
  const std::lock_guard lock(mutex_);
  kept_.push_back(std::move(file));
}

void OutputSet::publish() {
  const std::lock_guard lock(mutex_);
  put_all_in_place(std::exchange(kept_, {}));
}

void publish_outputs() {
  if (alive) alive->publish();
}

}  // namespace pelage
