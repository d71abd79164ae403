#pragma once
// Words and numbers of a text in memory, with the line for the messages.

#include <cstdint>
#include <string>
#include <string_view>

namespace pelage {

/// Steps through a text line by line (LF, CRLF or CR) and word by word (blanks and tabs between them).
/// `#` starts a comment to the end of the line; a backslash at the end of a line continues it; a UTF-8 byte
/// order mark in front and the zeros or the ^Z of old programs behind are skipped. Numbers are read the same in every
/// locale.
class TextScanner {
 public:
  /// `first_line` is the number of the first line of `text` in the file.
  TextScanner(std::string_view text, std::string file, int first_line = 1);

  int line() const { return line_; }
  /// True behind the last word of the line.
  bool at_line_end();
  /// Goes behind the end of this line.
  void skip_line();
  /// Skips empty lines and comments; true behind the last word of the text.
  bool at_end();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// All that is left of this line, without blanks around it: a name, in which # is a letter like any other.
  std::string_view rest_of_line();
  /// What has not been read yet, from the next character on.
  std::string_view rest() const { return text_.substr(at_); }

  /// The next word of this line as a number. `what` names it in the message, for example "a coordinate".
  double number(const char* what);
  std::int64_t integer(const char* what);
  /// The same for a word at hand. The word must be a number to its last character.
  double number(std::string_view word, const char* what) const;
  std::int64_t integer(std::string_view word, const char* what) const;

  /// Throws Error(Fault::input) at the present line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_blanks();
  bool at_continuation() const;

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_;
};

/// Error(Fault::input) for texts of two bytes a letter, told by their mark or by their zeros.
void refuse_wide_text(std::string_view bytes, const std::string& path);

/// At most 40 printable characters of a word, in quotes, for messages.
std::string in_quotes(std::string_view word);

}  // namespace pelage
