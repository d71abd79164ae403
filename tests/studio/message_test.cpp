#include "studio/message.h"

#include <gtest/gtest.h>

#include "pelage/error.h"

namespace pelage {
namespace {

Message sample() {
  Message m;
  m.header = {{"do", "shape"}, {"name", "µ.obj"}};
  m.blocks = {{"bytes", std::vector<std::uint8_t>{1, 2, 3}},
              {"triangles", std::vector<std::uint32_t>{7, 8, 4000000000U}},
              {"positions", std::vector<float>{0.5F, -1e30F}},
              {"values", std::vector<double>{0.1}},
              {"nothing", std::vector<double>{}}};
  return m;
}

TEST(StudioMessage, ComesBackAsItWas) {
  const Message sent = sample(), read = decode(encode(sent));
  EXPECT_EQ(read.header, sent.header);
  ASSERT_EQ(read.blocks.size(), sent.blocks.size());
  for (std::size_t i = 0; i < sent.blocks.size(); ++i) {
    EXPECT_EQ(read.blocks[i].name, sent.blocks[i].name);
    EXPECT_EQ(read.blocks[i].values, sent.blocks[i].values);
  }
  EXPECT_EQ(*read.bytes("bytes"), (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(read.bytes("positions"), nullptr);
}

// The layout that the page relies on: blocks begin at multiples of eight.
TEST(StudioMessage, BlocksAreAligned) {
  Message m;
  m.blocks = {{"a", std::vector<std::uint8_t>{9}}, {"b", std::vector<std::uint8_t>{8}}};
  const std::string bytes = encode(m);
  const std::size_t header = 4 + static_cast<unsigned char>(bytes[0]) + 256U * static_cast<unsigned char>(bytes[1]);
  const std::size_t first = (header + 7) / 8 * 8;
  ASSERT_EQ(bytes.size(), first + 9);
  EXPECT_EQ(bytes[first], 9);
  EXPECT_EQ(bytes[first + 8], 8);
}

TEST(StudioMessage, EveryTruncationIsRefused) {
  Message m = sample();
  m.blocks.pop_back();  // whose end no byte marks
  const std::string whole = encode(m);
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(decode(std::string_view(whole).substr(0, length)), Error) << length;
}

TEST(StudioMessage, WhatIsNoMessageIsRefused) {
  const auto with_header = [](const std::string& text) {
    return std::string{static_cast<char>(text.size()), 0, 0, 0} + text;
  };
  for (const char* header :
       {"[]", "17", "{", "{\"blocks\": [3]}", "{\"blocks\": [{\"name\": \"a\", \"type\": \"u8\", \"count\": -1}]}",
        "{\"blocks\": [{\"name\": \"a\", \"type\": \"u8\", \"count\": 1e30}]}",
        "{\"blocks\": [{\"name\": \"a\", \"type\": \"u9\", \"count\": 0}]}",
        "{\"blocks\": [{\"type\": \"u8\", \"count\": 0}]}",
        "{\"blocks\": [{\"name\": \"a\", \"type\": \"f64\", \"count\": 2305843009213693952}]}"})
    EXPECT_THROW(decode(with_header(header)), Error) << header;
}

}  // namespace
}  // namespace pelage
