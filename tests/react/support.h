#pragma once
// Helpers of the tests of the formula language.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "react/formula.h"

namespace pelage {

/// The value of a text in which x, y, z and t stand for the given numbers.
inline double value_of(const std::string& text, double x = 0, double y = 0, double z = 0, double t = 0) {
  Graph graph;
  const NodeId root = parse_formula(graph, {text, {"f", 1, 1}}, {}, "f");
  const double place[] = {x, y, z};
  const auto symbol = [&](const Symbol& s) {
    return s.kind == Symbol::Kind::time ? t : place[static_cast<std::size_t>(s.index)];
  };
  return evaluate(graph, std::vector{root}, symbol).front();
}

/// Runs an action that must throw Error(usage); returns its message.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::usage);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

}  // namespace pelage
