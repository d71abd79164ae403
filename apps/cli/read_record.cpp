#include "read_record.h"

#include <algorithm>

#include "base/ascii.h"
#include "base/suggest.h"
#include "io/file_bytes.h"
#include "io/record_in_file.h"
#include "pelage/error.h"
#include "text.h"

namespace pelage {

namespace {

std::string for_a_shell(const std::string& word) {
  constexpr std::string_view harmless = "-_=./,:+@%*?";
  const bool plain = !word.empty() && std::ranges::all_of(word, [&](char c) {
    return is_letter_or_digit(c) || harmless.find(c) != harmless.npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

Record read_record(const std::string& bytes, const std::string& path) {
  const std::string extension = lower_extension(path);
  if (const std::vector<std::string> known = record_extensions(); std::ranges::count(known, extension) == 0)
    throw Error(Fault::input, "files of this kind have no room for what made them; those that do: " + join_names(known),
                {path});
  try {
    const std::string text = record_in_file(bytes, extension);
    if (!text.empty()) return parse_record(text);
  } catch (const Error& error) {
    throw Error(error.fault(), error.what(), {path});
  }
  throw Error(Fault::input,
              "does not say what made it: it comes from elsewhere, another program has written it anew, or it was made "
              "with --no-record",
              {path});
}

std::string command_line(const std::vector<std::string>& words) {
  std::string line = "pelage";
  for (const std::string& word : words) line += " " + for_a_shell(one_line(word));
  return line;
}

}  // namespace pelage
