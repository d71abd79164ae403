#pragma once
// A number that tells values apart: the same on every machine, and another one, but for a chance of 2^-64, when any of
// the values differs.

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/random.h"

namespace pelage {

class Fingerprint {
 public:
  Fingerprint& add(std::uint64_t value) {
    key_ = hash(key_, value);
    return *this;
  }
  Fingerprint& add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }
  Fingerprint& add(std::string_view text) {
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
    return add(std::uint64_t{text.size()});
  }
  template <class T>
  Fingerprint& add_all(const T& values) {
    for (const auto& value : values) add(value);
    return add(std::uint64_t{std::size(values)});
  }
  std::uint64_t value() const { return key_; }

 private:
  std::uint64_t key_ = 0;
};

}  // namespace pelage
