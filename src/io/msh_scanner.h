#pragma once
// Lines, words and numbers of a Gmsh file, whose sections are lines of text around numbers as text or as bytes.

#include <cstdint>
#include <string>
#include <string_view>

namespace pelage {

class MshScanner {
 public:
  MshScanner(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  /// From here on data are bytes, `swapped` where the most significant one comes first.
  void set_binary(bool swapped);
  bool binary() const { return binary_; }

  /// True behind the last word.
  bool at_end();
  /// The rest of this line without blanks around it; what follows begins on the next one.
  std::string_view line();
  /// The next word, on this line or a later one; empty at the end of the file.
  std::string_view word();
  /// A number that is text in all files. `what` names it in messages.
  std::int64_t text_integer(const char* what);
  double text_real(const char* what);

  // Data: of four bytes, of eight bytes (a count or a tag), of eight bytes.
  std::int32_t integer(const char* what);
  std::uint64_t size(const char* what);
  double real(const char* what);

  /// The count; fails where the rest of the file cannot hold so many of `bytes` bytes, or as text of so many numbers.
  std::size_t room(std::uint64_t count, std::size_t bytes, std::size_t numbers, const char* what) const;
  /// Goes behind the line `end`; false if there is none.
  bool skip_behind(const std::string& end);

  /// Error(Fault::input) at this line, or at this byte where data are bytes.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  template <class T>
  T raw(const char* what);
  template <class T>
  T whole(const char* what);
  void skip_blanks();

  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  bool binary_ = false, swapped_ = false;
};

}  // namespace pelage
