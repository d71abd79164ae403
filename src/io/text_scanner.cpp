#include "io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "pelage/error.h"

namespace pelage {

namespace {

constexpr char end_of_file = '\x1a';  // of DOS

bool is_newline(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string advice(std::string_view word) {
  if (word.find(',') != std::string_view::npos) return "; write decimals with a point and no commas";
  if (word.find_first_of("dD") != std::string_view::npos) return "; write exponents with e";
  return "";
}

/// from_chars does not take the plus sign that some programs write.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  std::string text = "\"";
  for (char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > 40 ? "...\"" : "\"");
}

TextScanner::TextScanner(std::string_view text, std::string file, int first_line)
    : text_(text), file_(std::move(file)), line_(first_line) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  while (text_.size() > at_ && (text_.back() == '\0' || text_.back() == end_of_file)) text_.remove_suffix(1);
}

/// A backslash continues the line if nothing but blanks follows it there.
bool TextScanner::at_continuation() const {
  if (text_[at_] != '\\') return false;
  std::size_t next = at_ + 1;
  while (next < text_.size() && is_blank(text_[next])) ++next;
  return next < text_.size() && is_newline(text_[next]);
}

void TextScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (at_continuation()) {
      skip_line();
    } else {
      return;
    }
  }
}

bool TextScanner::at_line_end() {
  skip_blanks();
  return at_ == text_.size() || is_newline(text_[at_]) || text_[at_] == '#';
}

void TextScanner::skip_line() {
  while (at_ < text_.size() && !is_newline(text_[at_])) ++at_;
  if (at_ == text_.size()) return;
  if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
  ++at_;
  if (line_ < std::numeric_limits<int>::max()) ++line_;
}

bool TextScanner::at_end() {
  while (at_line_end()) {
    if (at_ == text_.size()) return true;
    skip_line();
  }
  return false;
}

std::string_view TextScanner::word() {
  if (at_line_end()) return {};
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && !is_newline(text_[at_]) && text_[at_] != '#' &&
         !at_continuation())
    ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view TextScanner::rest_of_line() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_newline(text_[at_])) ++at_;
  std::size_t end = at_;
  while (end > begin && is_blank(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

double TextScanner::number(const char* what) { return number(word(), what); }
std::int64_t TextScanner::integer(const char* what) { return integer(word(), what); }

double TextScanner::number(std::string_view word, const char* what) const {
  if (word.empty()) fail(std::string(what) + " is missing");
  const std::string_view digits = without_plus(word);
  double value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail("expected " + std::string(what) + ", found " + in_quotes(word) + advice(word));
  if (code == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    if (!tiny) fail(in_quotes(word) + " is too large for a number; scale the shape down");
    value = 0;
  }
  return value;
}

std::int64_t TextScanner::integer(std::string_view word, const char* what) const {
  if (word.empty()) fail(std::string(what) + " is missing");
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range) fail(in_quotes(word) + " is too large for " + what);
  if (code != std::errc() || end != digits.data() + digits.size())
    fail("expected " + std::string(what) + ", found " + in_quotes(word));
  return value;
}

void refuse_wide_text(std::string_view bytes, const std::string& path) {
  const bool marked = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
  constexpr std::size_t looked_at = 16;
  std::size_t zeros[2] = {0, 0}, letters = 0;
  for (std::size_t i = 0; i < std::min(looked_at, bytes.size()); ++i) {
    if (bytes[i] == 0) ++zeros[i % 2];
    letters += (bytes[i] >= ' ' && bytes[i] <= '~') || is_newline(bytes[i]);
  }
  const bool alternating =
      bytes.size() >= looked_at && letters == looked_at / 2 && (zeros[0] == looked_at / 2 || zeros[1] == looked_at / 2);
  if (marked || alternating) throw Error(Fault::input, "is UTF-16 text; save it as UTF-8", {path});
}

void TextScanner::fail(const std::string& message) const { throw Error(Fault::input, message, {file_, line_}); }

}  // namespace pelage
