#pragma once
// Helpers of the readers' tests.

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "pelage/error.h"

namespace pelage::test {

/// Expects Error(Fault::input) from a call, and that its one-line message holds a text.
template <class Call>
void expect_input_error(Call&& call, const std::string& text) {
  try {
    call();
    FAIL() << "no error, expected: " << text;
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.fault(), Fault::input);
    EXPECT_NE(what.find(text), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

}  // namespace pelage::test
