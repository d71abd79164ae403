#include "recipe/text_limits.h"

#include <algorithm>
#include <vector>

#include "pelage/error.h"

namespace pelage {

namespace {

/// Passes over a text and knows how deep it is.
class LimitScanner {
 public:
  LimitScanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void scan() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_string(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        take(c);
    }
  }

 private:
  /// An open bracket.
  struct Open {
    char bracket;
    std::size_t depth;  ///< of what it stands in
  };

  void take(char c) {
    ++at_;
    switch (c) {
      case '\n':
        ++line_;
        if (open_.empty()) begin_line();
        break;
      case '[':
        if (in_key_ && open_.empty())
          begin_header();
        else
          begin(c);
        break;
      case '{':
        begin(c);
        break;
      case ']':
      case '}':
        end();
        break;
      case ',':
        if (!open_.empty()) begin_item();
        break;
      case '.':
        if (in_key_) {
          count_key();
          deepen();
        }
        break;
      case '=':
        if (in_key_) count_key();
        in_key_ = false;
        break;
      default:
        break;
    }
  }

  void begin_line() {
    if (in_header_) header_ = depth_ + 1;
    in_header_ = false;
    in_key_ = true;
    depth_ = header_;
  }

  void begin_header() {
    if (!in_header_) count_key();  // not twice for [[
    in_header_ = true;
    depth_ = 0;
  }

  void begin(char bracket) {
    open_.push_back({bracket, depth_});
    in_key_ = bracket == '{';
    deepen();
  }

  void end() {
    if (open_.empty()) return;
    depth_ = open_.back().depth;
    open_.pop_back();
    in_key_ = false;
  }

  void begin_item() {
    in_key_ = open_.back().bracket == '{';
    depth_ = open_.back().depth + 1;
  }

  void deepen() {
    if (++depth_ > deepest_text)
      fail("tables, arrays and dotted keys are more than " + std::to_string(deepest_text) + " deep here");
  }

  void count_key() {
    if (++keys_ > most_keys) fail("there are more than " + std::to_string(most_keys) + " keys; nothing needs so many");
  }

  void skip_string(char quote) {
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    if (text_.substr(at_).starts_with(three)) return skip_long_string(three);
    for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '\\' && quote == '"')
        ++at_;
      else if (text_[at_] == quote) {
        ++at_;
        return;
      }
    }
    at_ = std::min(at_, text_.size());
  }

  void skip_long_string(std::string_view quotes) {
    for (at_ += quotes.size(); at_ < text_.size(); ++at_) {
      if (text_.substr(at_).starts_with(quotes)) {
        at_ += quotes.size();
        return;
      }
      if (text_[at_] == '\\' && quotes[0] == '"') ++at_;
      line_ += at_ < text_.size() && text_[at_] == '\n';
    }
    at_ = std::min(at_, text_.size());
  }

  [[noreturn]] void fail(const std::string& message) const { throw Error(Fault::usage, message, {file_, line_}); }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Open> open_;
  bool in_key_ = true, in_header_ = false;
  std::size_t depth_ = 0, header_ = 0, keys_ = 0;
};

}  // namespace

void require_limits(std::string_view text, const std::string& file) {
  if (text.size() > largest_text) throw Error(Fault::input, "is larger than 1 MB; this is no model or recipe", {file});
  LimitScanner(text, file).scan();
}

}  // namespace pelage
