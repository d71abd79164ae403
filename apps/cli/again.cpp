// pelage again: does what a file says that made it, and holds the result against the file.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/read_files.h"
#include "command.h"
#include "io/atomic_file.h"
#include "io/file_bytes.h"
#include "io/sha256.h"
#include "pelage/error.h"
#include "read_record.h"
#include "run_command.h"
#include "text.h"

namespace pelage {

namespace fs = std::filesystem;

namespace {

struct AgainCommand {
  std::string file, output, inputs;
  bool allow_outside = false, json = false, quiet = false;
  bool same = false;  ///< the result
};

/// A folder that nobody else can see into, while this lives.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string pattern = (fs::temp_directory_path() / "pelage-again-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw Error(Fault::output, "no temporary folder can be made", {pattern});
    path_ = pattern;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A file with its record, and what is not as it was.
struct Claim {
  std::string bytes;
  Record record;
  std::vector<std::string> differences;
  bool other_inputs = false;
};

/// "" where it is the same.
std::string difference(const RecordedInput& input) {
  std::error_code ignored;
  if (!fs::is_regular_file(input.name, ignored))
    throw Error(Fault::input, "was read for the file and is not here; --inputs FOLDER says where it is", {input.name});
  const std::string bytes = read_raw_file(input.name);
  if (bytes.size() == input.bytes && sha256(bytes) == input.sha256) return "";
  return "the input " + input.name + " is another: " + std::to_string(bytes.size()) + " bytes, sha256 " +
         sha256(bytes).substr(0, 12) + "..., where it had " + std::to_string(input.bytes) + " bytes, sha256 " +
         input.sha256.substr(0, 12) + "...";
}

void refuse_outside(const RecordedInput& input) {
  if (!true_path(input.name).starts_with(true_path(".") + "/"))
    throw Error(Fault::usage, "lies outside the folder in which the command would run; --allow-outside lets it be read",
                {input.name});
}

/// What is known before anything is run: the inputs last, so that the first is the version.
void compare_circumstances(const AgainCommand& command, Claim& claim) {
  const Record& record = claim.record;
  if (record.version != PELAGE_VERSION)
    claim.differences.push_back("the version was " + record.version + " and is " PELAGE_VERSION);
  for (const RecordedInput& input : record.inputs) {
    if (!command.allow_outside) refuse_outside(input);
    std::string text = difference(input);
    if (text.empty()) continue;
    claim.differences.push_back(std::move(text));
    claim.other_inputs = true;
  }
  if (record.architecture != own_architecture())
    claim.differences.push_back("the machine was " + record.architecture + " and is " +
                                std::string(own_architecture()));
}

/// The files of the same kind that the command wrote, one that is equal first.
std::vector<std::string> candidates(const std::string& folder, const std::string& file, const std::string& bytes) {
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && lower_extension(entry.path().string()) == lower_extension(file))
      found.push_back(read_raw_file(entry.path().string()));
  std::ranges::sort(found);  // folders have no order
  std::stable_partition(found.begin(), found.end(), [&](const std::string& one) { return one == bytes; });
  return found;
}

/// Values whose texts differ.
void compare_values(const Record& was, const Record& is, std::vector<std::string>& differences) {
  for (const RecordedText& value : was.values) {
    const auto now = std::ranges::find(is.values, value.name, &RecordedText::name);
    if (now == is.values.end() || now->text != value.text)
      differences.push_back(value.name + " was " + value.text + " and is " +
                            (now == is.values.end() ? "not there" : now->text));
  }
}

std::string difference(const std::string& was, const std::string& is) {
  const auto [a, b] = std::ranges::mismatch(was, is);
  return "the bytes: " + std::to_string(was.size()) + " were written and now " + std::to_string(is.size()) +
         ", the first other one is number " + std::to_string(a - was.begin() + 1);
}

/// The bytes of the new file.
std::string compare_result(const std::string& folder, const AgainCommand& command, Claim& claim) {
  const std::vector<std::string> found = candidates(folder, command.file, claim.bytes);
  if (found.empty()) throw Error(Fault::input, "the command in its record writes no file of this kind", {command.file});
  if (found[0] == claim.bytes) return found[0];
  compare_values(claim.record, read_record(found[0], command.file), claim.differences);
  claim.differences.push_back(difference(claim.bytes, found[0]));
  return found[0];
}

Repetition repetition_of(const AgainCommand& command, const Record& record, const std::string& folder) {
  Repetition r{record.words, folder, command.file, {command.allow_outside ? "" : ".", folder}, "", ""};
  // Where only the question is asked, the new file says the same of its origin, so that all else can be compared.
  const bool asked = command.output.empty();
  r.version = asked ? record.version : PELAGE_VERSION;
  r.architecture = asked ? record.architecture : std::string(own_architecture());
  return r;
}

void report(const AgainCommand& command, const Claim& claim) {
  if (command.json)
    return print_json({{"file", command.file},
                       {"command_line", command_line(claim.record.words)},
                       {"same", command.same},
                       {"differences", claim.differences},
                       {"output", command.output.empty() ? Json(nullptr) : Json(command.output)}});
  if (command.quiet) return;
  for (const std::string& text : claim.differences) std::printf("differs   %s\n", one_line(text).c_str());
  if (command.same) std::printf("same      all %zu bytes\n", claim.bytes.size());
  if (!command.output.empty()) std::printf("wrote     %s\n", command.output.c_str());
}

void enter(const std::string& folder) {
  std::error_code reason;
  fs::current_path(folder, reason);
  if (reason) throw Error(Fault::input, "cannot be entered: " + reason.message(), {folder});
}

/// Where the new file is going to be; "" for nowhere.
std::string check_output(const AgainCommand& command) {
  if (command.output.empty()) return "";
  if (lower_extension(command.output) != lower_extension(command.file))
    throw Error(Fault::usage, "-o " + command.output + ": the file is written again, in the same format");
  note_reading(command.file);  // which the output must not be
  expect_output(command.output);
  return fs::absolute(command.output).string();
}

void run_again(AgainCommand& command) {
  const std::string output = check_output(command);
  Claim claim{read_raw_file(command.file), {}, {}};
  claim.record = read_record(claim.bytes, command.file);
  if (!command.quiet && !command.json) std::printf("command   %s\n", command_line(claim.record.words).c_str());
  std::fflush(stdout);
  if (!command.inputs.empty()) enter(command.inputs);
  compare_circumstances(command, claim);
  if (output.empty() && claim.other_inputs) return report(command, claim);
  const PrivateFolder folder;
  repeat_command(repetition_of(command, claim.record, folder.path()));
  const std::string bytes = compare_result(folder.path(), command, claim);
  command.same = bytes == claim.bytes;
  if (!output.empty()) {
    write_file(output, bytes);
    publish_outputs();
  }
  report(command, claim);
}

}  // namespace

Command add_again(CLI::App& parent) {
  auto command = std::make_shared<AgainCommand>();
  CLI::App* app = parent.add_subcommand(
      "again",
      "Make a file again, and say whether it is the same to the bit\n"
      "Runs the command that the file names, in this folder, and compares: the version, the files that were read, the "
      "machine, the bytes. Nothing is written but what -o names. A file from elsewhere can make this read only what "
      "lies in the folder, and compute for as long as it likes: the command is printed first. Exit code 1: it is "
      "another.");
  app->add_option("FILE", command->file, "A file that pelage wrote")->type_name("")->required();
  app->add_option("-o,--output", command->output, "Keep the new file; the record in it is that of this program")
      ->type_name("FILE");
  app->add_option("--inputs", command->inputs, "Folder in which the files lie that were read (default: this one)")
      ->type_name("FOLDER");
  app->add_flag("--allow-outside", command->allow_outside, "Let it read files outside that folder, too");
  app->add_flag("--json", command->json, "Print the result as JSON");
  app->add_flag("-q,--quiet", command->quiet, "Print nothing but errors; the exit code tells");
  app->footer("Examples:\n  pelage again coat.glb\n  pelage again coat.glb --inputs scans -o mine.glb");
  Command result{app, [command] { run_again(*command); }};
  result.exit_code = [command] { return command->same ? 0 : 1; };
  return result;
}

}  // namespace pelage
