#include "io/output_set.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "io/publication.h"
#include "io/sha256.h"
#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

OutputSet* alive = nullptr;

/// Texts that people write, and that say what was grown.
constexpr const char* text_extension = ".toml";

auto find(std::vector<TemporaryFile>& files, const std::string& target) {
  return std::ranges::find(files, target, [](const TemporaryFile& f) { return f.target(); });
}

[[noreturn]] void refuse_replacing(const std::string& path) {
  throw Error(Fault::usage,
              "the output " + path + " is an input itself; give it another name, or --force to replace it");
}

bool is_within(const std::string& target, const std::string& folder) {
  if (folder.empty()) return true;
  const std::string root = true_path(folder);
  return target.starts_with(root.ends_with('/') ? root : root + "/");
}

/// How a record calls a file: folders above that of the command are nobody's business.
std::string name_of_input(const std::string& path, const std::string& folder) {
  const fs::path given(path);
  if (!given.is_absolute()) return given.lexically_normal().string();
  const std::string below = given.lexically_relative(folder).string();
  return below.empty() || below.starts_with("..") ? given.filename().string() : below;
}

/// In a word of the command, "SHAPE", "--option=FILE" or "--option=NAME=FILE".
void rename_input(std::string& word, const std::string& path, const std::string& name) {
  if (word == path || word.ends_with("=" + path)) word.replace(word.size() - path.size(), path.size(), name);
}

void set(std::vector<RecordedText>& list, const std::string& name, const std::string& text) {
  std::erase_if(list, [&](const RecordedText& one) { return one.name == name; });
  list.push_back({name, text});
}

}  // namespace

OutputSet* OutputSet::current() { return alive; }

OutputSet::OutputSet(OutputSetOptions options)
    : options_(std::move(options)),
      folder_(fs::current_path().string()),
      before_(std::exchange(alive, this)),
      observer_before_(
          observe_reading({[this](const std::string& path) { read(path); },
                           [this](const std::string& path, std::string_view bytes) { note_bytes(path, bytes); }})) {}

OutputSet::~OutputSet() {
  observe_reading(std::move(observer_before_));
  alive = before_;
}

void OutputSet::read(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const std::string target = true_path(path);
  if (!is_within(target, options_.confinement.read_in))
    throw Error(Fault::usage, path + " lies outside the folder " + options_.confinement.read_in +
                                  ", and nothing else may be read; --allow-outside lets it");
  const auto reserved = find(reserved_, target);
  if (reserved != reserved_.end() && !options_.may_replace_inputs) refuse_replacing(reserved->path());
  read_.push_back(target);
}

void OutputSet::note_bytes(const std::string& path, std::string_view bytes) {
  if (!options_.record) return;
  RecordedInput input{name_of_input(path, folder_), bytes.size(), sha256(bytes)};
  const std::lock_guard lock(mutex_);
  if (path.ends_with(text_extension)) set(options_.record->texts, input.name, std::string(bytes));
  inputs_[path] = std::move(input);
}

void OutputSet::add_value(const std::string& name, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (options_.record) set(options_.record->values, name, text);
}

void OutputSet::add_text(const std::string& name, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (options_.record) set(options_.record->texts, name, text);
}

std::optional<Record> OutputSet::record() {
  const std::lock_guard lock(mutex_);
  std::optional<Record> record = options_.record;
  if (!record) return record;
  for (const auto& [path, input] : inputs_) {
    for (std::string& word : record->words) rename_input(word, path, input.name);
    record->inputs.push_back(input);
  }
  std::ranges::sort(record->inputs, {}, &RecordedInput::name);
  const auto same = [](const RecordedInput& a, const RecordedInput& b) {
    return a.name == b.name && a.sha256 == b.sha256;
  };
  record->inputs.erase(std::unique(record->inputs.begin(), record->inputs.end(), same), record->inputs.end());
  return record;
}

TemporaryFile OutputSet::reserved(const std::string& path) {
  const std::string target = true_path(path), folder = folder_of(target);
  if (!is_within(target, options_.confinement.write_in))
    throw Error(Fault::usage, path + " lies outside the folder in which the command may write; nothing was written");
  if (find(reserved_, target) != reserved_.end() || find(kept_, target) != kept_.end())
    throw Error(Fault::usage, "two outputs are the same file, " + path + "; give one of them another name");
  if (!options_.may_replace_inputs && std::ranges::count(read_, target) > 0) refuse_replacing(path);
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

void record_value(const std::string& name, const std::string& text) {
  if (alive) alive->add_value(name, text);
}

void record_source(const std::string& name, const std::string& text) {
  if (alive) alive->add_text(name, text);
}

std::string record_for_files() {
  const std::optional<Record> record = alive ? alive->record() : std::nullopt;
  return record ? record_text(*record) : "";
}

}  // namespace pelage
