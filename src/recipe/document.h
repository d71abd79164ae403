#pragma once
// Text files as trees of values that know where they stand and whether anyone has read them. The format is
// TOML; nothing beyond this file depends on that.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pelage/error.h"

namespace pelage {

/// One value of a document. The getters mark what they return as read; Error(usage), located, where the value is of
/// another kind than asked for.
class Value {
 public:
  enum class Kind { string, number, boolean, array, table };

  Kind kind() const { return kind_; }
  const Location& where() const { return where_; }
  /// Where the first character inside the quotes of a string stands.
  const Location& text_where() const { return text_where_; }
  /// "a table", "a number", ...
  std::string kind_name() const;

  const std::string& string() const;
  double number() const;
  bool boolean() const;
  const std::vector<Value>& items() const;  ///< of an array

  /// The value under a key of a table, or nullptr. Keys that were asked for are those that a misspelt one is compared
  /// to.
  const Value* find(const std::string& key) const;
  /// The same; Error(usage) when the key is missing.
  const Value& at(const std::string& key) const;
  /// Keys and values of a table in the order of the file; the table counts as read, its values do not.
  std::vector<std::pair<std::string, const Value*>> entries() const;
  std::string string_or(const std::string& key, std::string otherwise) const;
  double number_or(const std::string& key, double otherwise) const;
  std::optional<double> optional_number(const std::string& key) const;

  /// Error(usage) at the first key below this table, in the order of the file, that nobody has read.
  void require_all_read() const;

 private:
  friend class DocumentReader;
  struct Entry;
  void expect(Kind kind) const;

  Kind kind_ = Kind::table;
  Location where_, text_where_;
  std::string string_;
  double number_ = 0;
  bool boolean_ = false;
  std::vector<Value> items_;
  std::vector<Entry> entries_;
  mutable std::vector<std::string> asked_;  ///< keys that were looked for
  mutable bool read_ = false;
};

struct Value::Entry {
  std::string key;
  Location where;  ///< of the key
  Value value;
};

/// Parses a text; `file` is the name for messages. Error(usage) with line and column if it is not well-formed, or
/// goes beyond recipe/text_limits.h.
Value parse_document(std::string_view text, const std::string& file);

/// The text of a model or recipe. Error(input) if the file cannot be read, is a folder or is larger than 1 MB.
std::string read_text(const std::string& path);

/// Reads and parses a file.
Value read_document(const std::string& path);

}  // namespace pelage
