#include "run/checkpoint.h"

#include <gtest/gtest.h>

#include <functional>

#include "catalog/bind.h"
#include "shape/generators.h"

namespace pelage {
namespace {

/// Whatever the length: a byte that is changed, missing or added.
TEST(Checkpoint, ASealKnowsEveryByte) {
  for (std::size_t length = 0; length < 20; ++length) {
    std::string text;
    for (std::size_t k = 0; k < length; ++k) text += static_cast<char>(7 * k * k + k);
    const std::string sealed = seal(text), sum = sealed.substr(length);
    ASSERT_EQ(sum.size(), seal_length);
    EXPECT_TRUE(is_sealed(sealed));
    for (std::size_t k = 0; k < sealed.size(); ++k) {
      std::string changed = sealed;
      changed[k] = static_cast<char>(changed[k] ^ 4);
      EXPECT_FALSE(is_sealed(changed)) << k << " of " << length;
      EXPECT_FALSE(is_sealed(sealed.substr(0, k)));
    }
    EXPECT_FALSE(is_sealed(text + '\0' + sum));
    EXPECT_FALSE(is_sealed(sealed + '\0'));
  }
}

TEST(Checkpoint, TheFirstDifferenceIsTold) {
  const Traits one = {{"seed", "1"}, {"shape", "#17"}};
  EXPECT_EQ(difference(one, one), "");
  EXPECT_EQ(difference(one, {{"seed", "2"}, {"shape", "#18"}}), "seed 1 instead of 2");
  EXPECT_EQ(difference(one, {{"seed", "1"}, {"shape", "#18"}}), "another shape");
  EXPECT_EQ(difference(one, {{"size", "1"}, {"shape", "#17"}}), "seed instead of size");
  EXPECT_EQ(difference(one, {{"seed", "1"}}), "other stages");
  EXPECT_EQ(difference({{"seed", "1"}}, one), "other stages");
}

/// Each of them makes another coat.
TEST(Checkpoint, WhatDecidesHowARunGoesOnIsATrait) {
  const auto traits = [](const std::function<void(Stage&)>& change) {
    Recipe recipe;
    recipe.stages[0].model.value = "turing";
    change(recipe.stages[0]);
    return traits_of(make_program(recipe, builtin_shape("builtin:sphere?n=162")));
  };
  const Traits plain = traits([](Stage&) {});
  EXPECT_EQ(difference(plain, traits([](Stage&) {})), "");
  EXPECT_EQ(difference(traits([](Stage& s) { s.seed = 3; }), traits([](Stage& s) { s.seed = 4; })),
            "seed 3 instead of 4");
  EXPECT_NE(difference(plain, traits([](Stage& s) { s.step = 0.5; })), "");
  EXPECT_NE(difference(plain, traits([](Stage& s) { s.stepper.value = "sbdf2"; })), "");
  EXPECT_EQ(difference(traits([](Stage& s) { s.stepper.value = "semi-implicit"; }), traits([](Stage& s) {
                         s.refresh = Given<std::int64_t>{4, {}};
                       })),
            "refresh 1 instead of 4");
  EXPECT_NE(difference(plain, traits([](Stage& s) { s.method.value = "linear"; })), "");
  EXPECT_NE(difference(plain, traits([](Stage& s) { s.size = Given<Length>{{0.7, Length::Unit::world}, {}}; })), "");
  // It may go on for longer than it was meant to.
  EXPECT_EQ(difference(plain, traits([](Stage& s) { s.until = 7; })), "");
}

}  // namespace
}  // namespace pelage
