#pragma once
// A computer whose numbers are written with a decimal comma and with points between the thousands.

#include <locale>
#include <string>

namespace pelage::testing {

/// While it lives, C++ streams that nobody told otherwise write 1.234,5 for 1234.5.
class DecimalComma {
 public:
  DecimalComma() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {}
  ~DecimalComma() { std::locale::global(before_); }
  DecimalComma(const DecimalComma&) = delete;
  DecimalComma& operator=(const DecimalComma&) = delete;

 private:
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

}  // namespace pelage::testing
