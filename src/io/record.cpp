#include "io/record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pelage/error.h"

namespace pelage {

namespace {

using Json = nlohmann::json;

constexpr const char* program_name = "pelage";

Json pairs_of(const std::vector<RecordedText>& list) {
  Json pairs = Json::array();
  for (const RecordedText& one : list) pairs.push_back(Json::array({one.name, one.text}));
  return pairs;
}

std::vector<RecordedText> texts_in(const Json& pairs) {
  std::vector<RecordedText> list;
  for (const Json& pair : pairs) list.push_back({pair.at(0).get<std::string>(), pair.at(1).get<std::string>()});
  return list;
}

Record record_in(const Json& json) {
  Record record;
  if (json.at("program") != program_name) throw Error(Fault::input, "another program has written the record");
  record.version = json.at("version").get<std::string>();
  record.architecture = json.at("architecture").get<std::string>();
  record.words = json.at("command").get<std::vector<std::string>>();
  for (const Json& input : json.at("inputs"))
    record.inputs.push_back({input.at("name").get<std::string>(), input.at("bytes").get<std::uint64_t>(),
                             input.at("sha256").get<std::string>()});
  if (std::ranges::any_of(record.inputs, &std::string::empty, &RecordedInput::name))
    throw Error(Fault::input, "its record is damaged: an input has no name");
  record.values = texts_in(json.at("values"));
  record.texts = texts_in(json.at("texts"));
  return record;
}

/// Where a line of comments may end: between two letters that no reader takes for the end or the going on of a line.
std::size_t end_of_line(std::string_view text, std::size_t longest) {
  const auto plain = [](char c) { return c != ' ' && c != '\\'; };
  if (text.size() <= longest) return text.size();
  std::size_t end = longest;
  while (end > 1 && !(plain(text[end - 1]) && plain(text[end]))) --end;
  return end > 1 ? end : longest;
}

}  // namespace

std::string_view own_architecture() {
#if defined(__x86_64__)
  return "x86_64";
#elif defined(__aarch64__)
  return "aarch64";
#elif defined(__riscv)
  return "riscv64";
#elif defined(__powerpc64__)
  return "ppc64le";
#else
  return "unknown";
#endif
}

std::string record_text(const Record& record) {
  Json inputs = Json::array();
  for (const RecordedInput& input : record.inputs)
    inputs.push_back({{"name", input.name}, {"bytes", input.bytes}, {"sha256", input.sha256}});
  const Json json = {
      {"program", program_name},        {"version", record.version}, {"architecture", record.architecture},
      {"command", record.words},        {"inputs", inputs},          {"values", pairs_of(record.values)},
      {"texts", pairs_of(record.texts)}};
  constexpr bool ascii = true;
  return json.dump(-1, ' ', ascii, Json::error_handler_t::replace);
}

Record parse_record(const std::string& text) {
  try {
    return record_in(Json::parse(text));
  } catch (const Json::exception& fault) {
    throw Error(Fault::input, std::string("its record is damaged: ") + fault.what());
  }
}

std::string comment_lines(const std::string& prefix, std::string_view text) {
  constexpr std::size_t longest = 200;
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = end_of_line(text, longest - prefix.size());
    lines.append(prefix).append(text.substr(0, end)) += '\n';
    text.remove_prefix(end);
  }
  return lines;
}

}  // namespace pelage
