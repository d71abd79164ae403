#pragma once
// What made a file, as the file itself says it (docs/provenance.md).

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// A file that a command read.
struct RecordedInput {
  std::string name;  ///< relative to the folder in which the command was given; only the last part of one elsewhere
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// Something with a name: a figure, or a whole text.
struct RecordedText {
  std::string name, text;
};

/// All that decides the bytes of a command's outputs, and nothing else: no date, no folder, no number of threads, and
/// of the outputs only of which kind they are.
struct Record {
  std::string version;       ///< of the program
  std::string architecture;  ///< of the machine
  /// The words after the name of the program. Names of outputs are "*" and the extension.
  std::vector<std::string> words;
  std::vector<RecordedInput> inputs;  ///< in the order of their names
  std::vector<RecordedText> values;   ///< what the words mean: model, parameters, seed, ...
  std::vector<RecordedText> texts;    ///< recipes and models, complete
};

/// "x86_64", "aarch64", ...: what this program was compiled for.
std::string_view own_architecture();

/// One line of JSON in ASCII, always the same for the same record.
std::string record_text(const Record& record);

/// Error(Fault::input) for what is no such text.
Record parse_record(const std::string& text);

/// The record in lines that begin with `prefix`, for formats that have comments; empty for an empty text. No line
/// begins or ends in a blank or ends in "\", which some readers take for more than it is, and none is longer than 200
/// letters.
std::string comment_lines(const std::string& prefix, std::string_view text);

}  // namespace pelage
