#include "react/lexer.h"

#include <charconv>
#include <cmath>

#include "base/ascii.h"

namespace pelage {

namespace {

// A formula is written by hand; anything longer is a mistake or an attack.
constexpr std::size_t longest_formula = 10000;

bool is_name_start(char c) { return is_letter(c) || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_continuation_byte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }  // of UTF-8

class Lexer {
 public:
  explicit Lexer(const Formula& formula) : text_(formula.text), where_(formula.where) {
    if (where_.line == 0) where_.line = 1;
    if (where_.column == 0) where_.column = 1;
    if (text_.size() > longest_formula)
      throw Error(Fault::usage,
                  "formula of " + std::to_string(text_.size()) + " characters; at most " +
                      std::to_string(longest_formula) + " are allowed: split it into definitions",
                  where_);
  }

  std::vector<Token> tokens() {
    std::vector<Token> list;
    do {
      while (!rest().empty() && is_space(rest().front())) advance(1);
      list.push_back(next());
    } while (list.back().kind != Token::Kind::end);
    return list;
  }

 private:
  std::string_view rest() const { return text_.substr(position_); }

  void advance(std::size_t count) {
    for (; count > 0; --count) {
      const char c = text_[position_++];
      if (c == '\n') {
        ++where_.line;
        where_.column = 1;
      } else if (!is_continuation_byte(c)) {
        ++where_.column;
      }
    }
  }

  Token next() {
    if (rest().empty()) return {Token::Kind::end, {}, 0, where_};
    const char c = rest().front();
    if (is_digit(c) || (c == '.' && rest().size() > 1 && is_digit(rest()[1]))) return number();
    if (is_name_start(c)) return name();
    return sign();
  }

  Token take(Token::Kind kind, std::size_t length, double value = 0) {
    const Token token{kind, rest().substr(0, length), value, where_};
    advance(length);
    return token;
  }

  Token number() {
    double value = 0;
    const auto [end, fault] = std::from_chars(rest().data(), rest().data() + rest().size(), value);
    const auto length = static_cast<std::size_t>(end - rest().data());
    if (fault != std::errc{} || !std::isfinite(value))
      throw Error(Fault::usage, "number " + std::string(rest().substr(0, length)) + " is too large or too small",
                  where_);
    return take(Token::Kind::number, length, value);
  }

  /// Names may have parts: STAGE.SPECIES.
  Token name() {
    std::size_t length = 1;
    const auto starts_part = [&] {
      return rest()[length] == '.' && length + 1 < rest().size() && is_name_start(rest()[length + 1]);
    };
    while (length < rest().size() && (is_name_start(rest()[length]) || is_digit(rest()[length]) || starts_part()))
      ++length;
    return take(Token::Kind::name, length);
  }

  Token sign() {
    for (const std::string_view two : {"<=", ">=", "==", "!="})
      if (rest().substr(0, 2) == two) return take(Token::Kind::sign, 2);
    if (rest().substr(0, 2) == "**")
      throw Error(Fault::usage, "'**' is not an operator; powers are written a^b", where_);
    const char c = rest().front();
    if (c == '=') throw Error(Fault::usage, "'=' is not an operator; equality is written a == b", where_);
    if (std::string_view("+-*/^()<>,").find(c) != std::string_view::npos) return take(Token::Kind::sign, 1);
    if (c == '|')
      throw Error(Fault::usage, "'|' has no meaning in a formula; |a| is written abs(a), and |grad u|^2 grad2(u)",
                  where_);
    std::size_t length = 1;
    while (length < rest().size() && is_continuation_byte(rest()[length])) ++length;
    if (rest().substr(0, length) == "\xE2\x88\x87")
      throw Error(
          Fault::usage,
          "'\xE2\x88\x87' has no meaning in a formula; the Laplacian of u is written lap(u), |grad u|^2 grad2(u)",
          where_);
    throw Error(Fault::usage, "character '" + printable(rest().substr(0, length)) + "' has no meaning in a formula",
                where_);
  }

  static std::string printable(std::string_view character) {
    const auto code = static_cast<unsigned char>(character.front());
    return code < 32 || code == 127 ? "code " + std::to_string(code) : std::string(character);
  }

  std::string_view text_;
  std::size_t position_ = 0;
  Location where_;
};

}  // namespace

std::vector<Token> tokenize(const Formula& formula) { return Lexer(formula).tokens(); }

}  // namespace pelage
