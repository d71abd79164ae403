#pragma once
// What errors say.

#include <gtest/gtest.h>

#include <string>

#include "pelage/error.h"

namespace pelage::test {

/// The call throws an Error of that kind whose text has these words.
template <class Call>
void expect_error(Fault fault, const std::string& words, Call&& call) {
  try {
    call();
    FAIL() << "no error, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), fault);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

}  // namespace pelage::test
