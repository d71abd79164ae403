#include "recipe/document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/read_files.h"
#include "base/suggest.h"
#include "recipe/text_limits.h"

namespace pelage {

namespace {

Location location(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

bool before(const Location& a, const Location& b) { return std::pair(a.line, a.column) < std::pair(b.line, b.column); }

}  // namespace

/// toml++ tree -> Value tree.
class DocumentReader {
 public:
  DocumentReader(std::string_view text, const std::string& file) : file_(file) {
    for (std::size_t start = 0; start <= text.size();) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      lines_.push_back(text.substr(start, end - start));
      start = end + 1;
    }
  }

  Value read(const toml::node& node) const {
    Value value;
    value.where_ = value.text_where_ = location(node.source(), file_);
    if (const auto* table = node.as_table()) {
      read_table(*table, value);
    } else if (const auto* array = node.as_array()) {
      value.kind_ = Value::Kind::array;
      for (const toml::node& item : *array) value.items_.push_back(read(item));
    } else if (const auto* text = node.as_string()) {
      value.kind_ = Value::Kind::string;
      value.string_ = text->get();
      value.text_where_ = inside_quotes(value.where_);
    } else if (node.is_boolean()) {
      value.kind_ = Value::Kind::boolean;
      value.boolean_ = node.as_boolean()->get();
    } else if (const auto number = node.value<double>(); number && node.is_number()) {
      value.kind_ = Value::Kind::number;
      value.number_ = *number;
    } else {
      throw Error(Fault::usage, "dates and times have no meaning here", value.where_);
    }
    return value;
  }

 private:
  void read_table(const toml::table& table, Value& value) const {
    value.kind_ = Value::Kind::table;
    for (const auto& [key, node] : table)
      value.entries_.push_back({std::string(key.str()), location(key.source(), file_), read(node)});
    // toml++ keeps tables by name; the order of the file matters to definitions and species.
    std::ranges::sort(value.entries_, [](const auto& a, const auto& b) { return before(a.where, b.where); });
  }

  Location inside_quotes(Location where) const {
    if (where.line < 1 || static_cast<std::size_t>(where.line) > lines_.size()) return where;
    std::string_view line = lines_[static_cast<std::size_t>(where.line) - 1];
    line.remove_prefix(std::min(byte_offset(line, where.column - 1), line.size()));
    const bool is_multiline = line.substr(0, 3) == "\"\"\"" || line.substr(0, 3) == "'''";
    const std::size_t quotes = is_multiline ? 3 : 1;
    where.column += static_cast<int>(quotes);
    line.remove_prefix(std::min(quotes, line.size()));
    if (is_multiline && (line.empty() || line == "\r"))
      return {where.file, where.line + 1, 1};  // TOML drops this break
    return where;
  }

  /// Columns count characters; this is the byte at which character number `column` (from 0) starts.
  static std::size_t byte_offset(std::string_view line, int column) {
    std::size_t offset = 0;
    for (; offset < line.size(); ++offset) {
      const bool starts = (static_cast<unsigned char>(line[offset]) & 0xC0) != 0x80;
      if (starts && column-- == 0) break;
    }
    return offset;
  }

  const std::string& file_;
  std::vector<std::string_view> lines_;
};

namespace {

std::string name_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::string:
      return "a string";
    case Value::Kind::number:
      return "a number";
    case Value::Kind::boolean:
      return "true or false";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::table:
      break;
  }
  return "a table";
}

}  // namespace

std::string Value::kind_name() const { return name_of(kind_); }

void Value::expect(Kind kind) const {
  if (kind_ != kind) throw Error(Fault::usage, "expected " + name_of(kind) + ", found " + kind_name(), where_);
  read_ = true;
}

const std::string& Value::string() const {
  expect(Kind::string);
  return string_;
}

double Value::number() const {
  expect(Kind::number);
  return number_;
}

bool Value::boolean() const {
  expect(Kind::boolean);
  return boolean_;
}

const std::vector<Value>& Value::items() const {
  expect(Kind::array);
  return items_;
}

const Value* Value::find(const std::string& key) const {
  expect(Kind::table);
  if (std::ranges::find(asked_, key) == asked_.end()) asked_.push_back(key);
  const auto found = std::ranges::find(entries_, key, &Entry::key);
  return found == entries_.end() ? nullptr : &found->value;
}

const Value& Value::at(const std::string& key) const {
  if (const Value* value = find(key)) return *value;
  for (const Entry& entry : entries_) {
    const std::string hint = did_you_mean(entry.key, {key});
    if (!hint.empty() && !entry.value.read_)
      throw Error(Fault::usage, "unknown key \"" + entry.key + "\"; " + hint, entry.where);
  }
  throw Error(Fault::usage, "\"" + key + "\" is missing; add it", where_);
}

std::vector<std::pair<std::string, const Value*>> Value::entries() const {
  expect(Kind::table);
  std::vector<std::pair<std::string, const Value*>> list;
  for (const Entry& entry : entries_) list.emplace_back(entry.key, &entry.value);
  return list;
}

std::string Value::string_or(const std::string& key, std::string otherwise) const {
  const Value* value = find(key);
  return value ? value->string() : otherwise;
}

double Value::number_or(const std::string& key, double otherwise) const {
  return optional_number(key).value_or(otherwise);
}

std::optional<double> Value::optional_number(const std::string& key) const {
  const Value* value = find(key);
  return value ? std::optional(value->number()) : std::nullopt;
}

void Value::require_all_read() const {
  for (const Value& item : items_) item.require_all_read();
  for (const Entry& entry : entries_) {
    if (entry.value.read_) {
      entry.value.require_all_read();
      continue;
    }
    std::vector<std::string> known;  // asked for, and not there
    for (const std::string& key : asked_)
      if (std::ranges::find(entries_, key, &Entry::key) == entries_.end()) known.push_back(key);
    const std::string hint = did_you_mean(entry.key, known);
    const std::string names = known.empty() ? "" : "; unused here are " + join_names(known);
    throw Error(Fault::usage, "unknown key \"" + entry.key + "\"" + (hint.empty() ? names : "; " + hint), entry.where);
  }
}

Value parse_document(std::string_view text, const std::string& file) {
  require_limits(text, file);
  try {
    const toml::table table = toml::parse(text);
    return DocumentReader(text, file).read(table);
  } catch (const toml::parse_error& fault) {
    throw Error(Fault::usage, std::string(fault.description()), location(fault.source(), file));
  }
}

std::string read_text(const std::string& path) {
  note_reading(path);
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    throw Error(Fault::input, "is a folder; give the path of a .toml file", {path});
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw Error(Fault::input, "cannot be read; check the path", {path});
  std::string text(largest_text + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (std::ferror(file.get())) throw Error(Fault::input, "cannot be read to its end", {path});
  if (text.size() > largest_text) throw Error(Fault::input, "is larger than 1 MB; this is no model or recipe", {path});
  note_read(path, text);
  return text;
}

Value read_document(const std::string& path) { return parse_document(read_text(path), path); }

}  // namespace pelage
