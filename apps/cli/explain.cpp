// pelage explain: what a file says of how it was made.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "base/suggest.h"
#include "command.h"
#include "io/file_bytes.h"
#include "pelage/error.h"
#include "read_record.h"
#include "table.h"
#include "text.h"

namespace pelage {

namespace {

struct ExplainCommand {
  std::string file, text;
  bool json = false;
};

Json json_of(const std::vector<RecordedText>& list) {
  Json json = Json::object();
  for (const RecordedText& one : list) json[one.name] = one.text;
  return json;
}

Json json_of(const Record& record) {
  Json inputs = Json::array();
  for (const RecordedInput& input : record.inputs)
    inputs.push_back({{"name", input.name}, {"bytes", input.bytes}, {"sha256", input.sha256}});
  return {{"version", record.version},
          {"architecture", record.architecture},
          {"command", record.words},
          {"command_line", command_line(record.words)},
          {"inputs", inputs},
          {"values", json_of(record.values)},
          {"texts", json_of(record.texts)}};
}

void print_record(const Record& record) {
  std::vector<std::vector<std::string>> rows = {{"made by", "pelage " + record.version + ", " + record.architecture},
                                                {"command", command_line(record.words)}};
  for (const RecordedInput& input : record.inputs)
    rows.push_back({"read", input.name + ", " + std::to_string(input.bytes) + " bytes, sha256 " + input.sha256});
  for (const RecordedText& value : record.values) rows.push_back({value.name, value.text});
  for (const RecordedText& text : record.texts)
    rows.push_back({"text", text.name + ", which --text " + text.name + " prints"});
  for (std::vector<std::string>& row : rows)
    for (std::string& cell : row) cell = one_line(cell);
  std::fputs(table(rows).c_str(), stdout);
}

/// As it is, but for what a terminal would take for a command.
void print_text(const Record& record, const std::string& name) {
  std::vector<std::string> known;
  for (const RecordedText& text : record.texts) known.push_back(text.name);
  const auto found = std::ranges::find(record.texts, name, &RecordedText::name);
  if (found == record.texts.end()) throw Error(Fault::usage, unknown_name("text", name, known));
  std::string text = found->text;
  std::erase_if(text, [](unsigned char c) { return (c < ' ' && c != '\n' && c != '\t') || c == 0x7f; });
  std::fputs(text.c_str(), stdout);
}

void run_explain(const ExplainCommand& command) {
  const Record record = read_record(read_raw_file(command.file), command.file);
  if (!command.text.empty()) return print_text(record, command.text);
  command.json ? print_json(json_of(record)) : print_record(record);
}

}  // namespace

Command add_explain(CLI::App& parent) {
  auto command = std::make_shared<ExplainCommand>();
  CLI::App* app = parent.add_subcommand(
      "explain",
      "Print what a file says of how it was made\n"
      "The version of the program, the command, the files that it read with their SHA-256, of a coat its model, "
      "parameters and seed, and the recipe as text. Nothing is checked: pelage again does that.");
  app->add_option("FILE", command->file, "A file that pelage wrote: a mesh, a picture, a drawing")
      ->type_name("")
      ->required();
  app->add_option("--text", command->text, "Print only that recipe or model, as it was: to grow it on another shape")
      ->type_name("NAME");
  app->add_flag("--json", command->json, "Print it as JSON");
  app->footer(
      "Examples:\n  pelage explain coat.glb\n  pelage explain coat.png --text leopard >leopard.toml\n"
      "  pelage explain coat.ply --json");
  return {app, [command] { run_explain(*command); }};
}

}  // namespace pelage
