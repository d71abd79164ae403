#pragma once
// Messages between the studio's page and its engine as bytes: a JSON header and blocks of numbers, little-endian
// (docs/studio-protocol.md).

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pelage {

using Header = nlohmann::ordered_json;

struct MessageBlock {
  std::string name;
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint32_t>, std::vector<float>, std::vector<double>> values;
};

struct Message {
  Header header = Header::object();
  std::vector<MessageBlock> blocks;

  /// The bytes of that block of u8; nullptr where there is none.
  const std::vector<std::uint8_t>* bytes(std::string_view name) const;
};

std::string encode(const Message& message);

/// Error(Fault::input) for bytes that are no message.
Message decode(std::string_view bytes);

}  // namespace pelage
