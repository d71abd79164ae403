#include "checkpoint_file.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "command.h"
#include "invocation.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "pelage/error.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

std::string previous(const std::string& path) { return path + ".previous"; }

std::string note_of_command() {
  const Json note = {{"words", invocation().words}, {"folder", invocation().folder}};
  return note.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Whose checksum is right.
std::string sound_checkpoint(const std::string& path) {
  std::string bytes = read_own_file(path);
  try {
    note_of_checkpoint(bytes);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  return bytes;
}

/// "--option", or "--option=VALUE".
std::vector<std::string>::iterator find_option(std::vector<std::string>& words, const std::string& option) {
  return std::ranges::find_if(
      words, [&](const std::string& word) { return word == option || word.starts_with(option + "="); });
}

/// Removes an option with so many values after it.
void drop(std::vector<std::string>& words, const std::string& option, std::ptrdiff_t values) {
  const auto found = find_option(words, option);
  if (found == words.end()) return;
  const std::ptrdiff_t rest = words.end() - found;
  words.erase(found, found + (*found == option ? std::min(1 + values, rest) : 1));
}

}  // namespace

void CheckpointFile::keep_at(const std::string& path) {
  if (path.empty()) return;
  expect_output(path);
  path_ = path;
  automatic_ = true;
}

void CheckpointFile::look_at(const Run& run) {
  if (path_.empty()) return;
  if (run.stage() != stage_ || Clock::now() - last_ >= pause_) save(run);
}

void CheckpointFile::save(const Run& run) {
  if (path_.empty()) return;
  const std::string bytes = run.checkpoint(note_of_command());
  std::error_code ignored;  // the first time there is none, and some file systems know no second name for a file
  fs::remove(previous(path_), ignored);
  fs::create_hard_link(path_, previous(path_), ignored);
  write_file(path_, bytes, Appearance::at_once);
  last_ = Clock::now();
  stage_ = run.stage();
}

void CheckpointFile::finish() {
  if (!automatic_) return;
  std::error_code ignored;
  fs::remove(path_, ignored);
  fs::remove(previous(path_), ignored);
}

std::string read_checkpoint(const std::string& path, const std::function<void(const std::string&)>& warn) {
  try {
    return sound_checkpoint(path);
  } catch (const Error& error) {
    std::error_code ignored;
    if (!fs::exists(previous(path), ignored)) throw;
    std::string bytes = sound_checkpoint(previous(path));
    warn(std::string(error.what()) + "; the one before it is taken, " + previous(path));
    return bytes;
  }
}

std::vector<std::string> words_to_resume(const std::string& path) {
  const Json note = Json::parse(note_of_checkpoint(read_checkpoint(path, [](const std::string&) {})), nullptr, false);
  if (!note.is_object() || !note.contains("words") || !note.contains("folder"))
    throw Error(Fault::input,
                "holds no command, since a program of its own has written it; pelage grow takes it by "
                "--resume, with the same shape and options",
                {path});
  auto words = note["words"].get<std::vector<std::string>>();
  const std::string file = fs::absolute(path).string(), folder = note["folder"].get<std::string>();
  std::error_code reason;
  fs::current_path(folder, reason);
  if (reason)
    throw Error(Fault::input, "the folder of its run, " + folder + ", cannot be entered: " + reason.message(), {path});
  drop(words, "--resume", 1);
  if (find_option(words, "--frames") != words.end()) return words;  // which show the growth from its beginning
  words.insert(words.end(), {"--resume", file});
  return words;
}

}  // namespace pelage
