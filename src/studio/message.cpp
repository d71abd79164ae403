#include "studio/message.h"

#include <array>
#include <bit>
#include <cstring>

#include "pelage/error.h"

namespace pelage {

namespace {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they lie in memory");

constexpr std::size_t alignment = 8;
/// In the order of MessageBlock::values.
constexpr std::array<const char*, 4> type_names = {"u8", "u32", "f32", "f64"};

std::size_t padded(std::size_t length) { return (length + alignment - 1) / alignment * alignment; }

[[noreturn]] void refuse(const std::string& why) { throw Error(Fault::input, "not a message of the studio: " + why); }

std::uint32_t header_length(std::string_view bytes) {
  std::uint32_t length = 0;
  if (bytes.size() < sizeof length) refuse("it is cut short");
  std::memcpy(&length, bytes.data(), sizeof length);
  if (length > bytes.size() - sizeof length) refuse("its header is cut short");
  return length;
}

Header parse_header(std::string_view text) {
  Header header = Header::parse(text, nullptr, false);
  if (!header.is_object()) refuse("its header is not JSON");
  return header;
}

template <std::size_t Type = 0>
MessageBlock read_block(const std::string& name, const std::string& type, std::size_t count, std::string_view rest) {
  if constexpr (Type < type_names.size()) {
    if (type != type_names[Type]) return read_block<Type + 1>(name, type, count, rest);
    MessageBlock block{name, {}};
    auto& values = block.values.emplace<Type>();
    using Number = typename std::decay_t<decltype(values)>::value_type;
    if (count > rest.size() / sizeof(Number)) refuse("the block \"" + name + "\" is cut short");
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), rest.data(), count * sizeof(Number));
    return block;
  } else {
    refuse("a block has the unknown type \"" + type + "\"");
  }
}

std::size_t byte_count(const MessageBlock& block) {
  return std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, block.values);
}

}  // namespace

const std::vector<std::uint8_t>* Message::bytes(std::string_view name) const {
  for (const MessageBlock& block : blocks)
    if (block.name == name) return std::get_if<std::vector<std::uint8_t>>(&block.values);
  return nullptr;
}

std::string encode(const Message& message) {
  Header header = message.header;
  if (!message.blocks.empty()) header["blocks"] = Header::array();
  for (const MessageBlock& block : message.blocks)
    header["blocks"].push_back({{"name", block.name},
                                {"type", type_names[block.values.index()]},
                                {"count", std::visit([](const auto& v) { return v.size(); }, block.values)}});
  const std::string text = header.dump(-1, ' ', false, Header::error_handler_t::replace);
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  bytes += text;
  for (const MessageBlock& block : message.blocks) {
    bytes.resize(padded(bytes.size()));
    std::visit(
        [&](const auto& values) {
          bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
        },
        block.values);
  }
  return bytes;
}

Message decode(std::string_view bytes) {
  const std::size_t length = header_length(bytes);
  Message message{parse_header(bytes.substr(sizeof(std::uint32_t), length)), {}};
  const auto listed = message.header.find("blocks");
  if (listed == message.header.end()) return message;
  std::size_t at = sizeof(std::uint32_t) + length;
  for (const auto& entry : *listed) {
    if (!entry.is_object() || !entry.value("count", Header()).is_number_unsigned()) refuse("a block has no count");
    if (!entry.value("name", Header()).is_string() || !entry.value("type", Header()).is_string())
      refuse("a block has no name or type");
    at = padded(at);
    if (at > bytes.size()) refuse("a block is cut short");
    message.blocks.push_back(read_block(entry["name"].get<std::string>(), entry["type"].get<std::string>(),
                                        entry["count"].get<std::size_t>(), bytes.substr(at)));
    at += byte_count(message.blocks.back());
  }
  message.header.erase("blocks");
  return message;
}

}  // namespace pelage
