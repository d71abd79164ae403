#include "io/msh_scanner.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/text_scanner.h"
#include "pelage/error.h"

namespace pelage {

namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

void MshScanner::set_binary(bool swapped) {
  binary_ = true;
  swapped_ = swapped;
}

void MshScanner::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
}

bool MshScanner::at_end() {
  skip_blanks();
  return at_ == bytes_.size();
}

std::string_view MshScanner::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  return trimmed(text);
}

std::string_view MshScanner::word() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
  return bytes_.substr(begin, at_ - begin);
}

template <class T>
T MshScanner::whole(const char* what) {
  const std::string_view text = word();
  T value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty()) fail(std::string("the file ends before ") + what);
  if (fault != std::errc() || end != text.data() + text.size())
    fail("expected " + std::string(what) + ", found " + in_quotes(text));
  return value;
}

template <class T>
T MshScanner::raw(const char* what) {
  if (bytes_.size() - at_ < sizeof(T)) fail(std::string("the file ends before ") + what);
  std::array<char, sizeof(T)> data;
  std::memcpy(data.data(), bytes_.data() + at_, sizeof(T));
  if (swapped_) std::ranges::reverse(data);
  at_ += sizeof(T);
  return std::bit_cast<T>(data);
}

std::int64_t MshScanner::text_integer(const char* what) { return whole<std::int64_t>(what); }
double MshScanner::text_real(const char* what) { return whole<double>(what); }
std::int32_t MshScanner::integer(const char* what) {
  return binary_ ? raw<std::int32_t>(what) : whole<std::int32_t>(what);
}
std::uint64_t MshScanner::size(const char* what) {
  return binary_ ? raw<std::uint64_t>(what) : whole<std::uint64_t>(what);
}
double MshScanner::real(const char* what) { return binary_ ? raw<double>(what) : whole<double>(what); }

std::size_t MshScanner::room(std::uint64_t count, std::size_t bytes, std::size_t numbers, const char* what) const {
  const std::size_t each = std::max<std::size_t>(1, binary_ ? bytes : 2 * numbers), left = bytes_.size() - at_;
  if (count > (left + 1) / each)
    fail("there are said to be " + std::to_string(count) + " " + what + ", but the file can hold at most " +
         std::to_string((left + 1) / each));
  return static_cast<std::size_t>(count);
}

bool MshScanner::skip_behind(const std::string& end) {
  const std::size_t found = bytes_.find("\n" + end, at_ > 0 ? at_ - 1 : 0);
  if (found == std::string_view::npos) return false;
  at_ = found + 1;
  line();
  return true;
}

void MshScanner::fail(const std::string& message) const {
  if (binary_) throw Error(Fault::input, message + " (at byte " + std::to_string(at_) + ")", {path_});
  const std::string_view before = trimmed(bytes_.substr(0, at_));  // a word is read up to its end
  throw Error(Fault::input, message, {path_, static_cast<int>(1 + std::ranges::count(before, '\n'))});
}

}  // namespace pelage
