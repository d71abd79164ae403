#include "recorded_words.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "base/ascii.h"
#include "pelage/error.h"

namespace pelage {

namespace {

/// Options that name what is written.
constexpr std::array<std::string_view, 8> outputs = {"--output", "--picture",    "--plot",         "--panels",
                                                     "--maps",   "--height-map", "--patch-images", "--lines"};

/// Options that change no byte of it.
constexpr std::array<std::string_view, 12> left_out = {
    "--checkpoint", "--every-minutes", "--resume", "--threads", "--force", "--no-record",
    "--from-frame", "--profile",       "--json",   "--quiet",   "--help",  "--max-memory"};

/// Commands that write files and nothing else: whose outputs are all among these options.
constexpr std::array<std::string_view, 11> repeatable = {"grow",  "fair",   "field",   "cells",   "grid", "unwrap",
                                                         "sheet", "render", "analyse", "measure", "map"};

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

/// "*.glb" of "coats/cow.glb".
std::string kind_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return "*" +
         (std::ranges::all_of(extension, [](char c) { return c == '.' || is_letter_or_digit(c); }) ? extension : "");
}

/// The words of one option; `values` are more than one where it was given several times.
void append_words(std::vector<std::string>& words, const std::string& name, const std::vector<std::string>& values,
                  bool flag) {
  for (const std::string& value : values) {
    if (flag && value == "true")
      words.push_back(name);
    else if (name.starts_with("--"))
      words.push_back(name + "=" + value);
    else
      words.insert(words.end(), {name, value});
  }
}

std::vector<std::string> values_of(const CLI::Option& option) {
  std::vector<std::string> values = option.results();
  if (contains(outputs, option.get_name()))
    for (std::string& value : values) value = kind_of(value);
  if (option.get_delimiter() == '\0' || values.empty()) return values;
  std::string all = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) all += option.get_delimiter() + values[i];
  return {all};
}

/// "*.glb,*.ply" becomes FOLDER/1/NAME.glb,FOLDER/2/NAME.ply.
std::string named(std::string_view kinds, const std::string& folder, const std::string& name, int& count) {
  std::string result;
  for (const char c : kinds) {
    if (c != '*') {
      result += c;
      continue;
    }
    const std::filesystem::path own = std::filesystem::path(folder) / std::to_string(++count);
    std::filesystem::create_directory(own);
    result += (own / name).string();
  }
  return result;
}

}  // namespace

bool can_be_repeated(const std::string& command) { return contains(repeatable, command); }

std::vector<std::string> recorded_words(const CLI::App& command) {
  std::vector<std::string> words = {command.get_name()}, options;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || contains(left_out, option->get_name())) continue;
    if (option->get_positional())
      words.insert(words.end(), option->results().begin(), option->results().end());
    else
      append_words(options, option->get_name(), values_of(*option), option->get_items_expected_max() == 0);
  }
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

std::vector<std::string> words_to_repeat(std::vector<std::string> words, const std::string& folder,
                                         const std::string& file) {
  const std::string name = std::filesystem::path(file).stem().string();
  int count = 0;
  for (std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals != word.npos && contains(outputs, std::string_view(word).substr(0, equals)))
      word = word.substr(0, equals + 1) + named(std::string_view(word).substr(equals + 1), folder, name, count);
  }
  if (count == 0) words.push_back("--output=" + named(kind_of(file), folder, name, count));
  return words;
}

}  // namespace pelage
