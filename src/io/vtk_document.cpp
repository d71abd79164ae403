#include "io/vtk_document.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "base/checked.h"
#include "base/number.h"
#include "io/text_scanner.h"
#include "io/vtk_attributes.h"
#include "io/zlib.h"
#include "pelage/error.h"

namespace pelage {

namespace {

struct VtkType {
  const char* name;
  std::size_t size;  ///< bytes
  double (*read)(const char* bytes, bool swapped);
  std::optional<double> (*held)(double number);  ///< a number of a text in that type
  NumberType type;
};

template <class T>
double read_as(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swapped) std::ranges::reverse(raw);
  return static_cast<double>(std::bit_cast<T>(raw));
}

/// Nothing for a whole number that is none or has no room.
template <class T>
std::optional<double> held_as(double number) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<double>(static_cast<T>(number));
  } else {
    const auto whole = static_cast<double>(saturated<T>(number));
    return whole == number ? std::optional(whole) : std::nullopt;
  }
}

template <class T>
constexpr VtkType row(const char* name, NumberType type) {
  return {name, sizeof(T), read_as<T>, held_as<T>, type};
}

constexpr VtkType types[] = {
    row<float>("Float32", NumberType::float32),      row<double>("Float64", NumberType::float64),
    row<std::int8_t>("Int8", NumberType::int8),      row<std::uint8_t>("UInt8", NumberType::uint8),
    row<std::int16_t>("Int16", NumberType::int16),   row<std::uint16_t>("UInt16", NumberType::uint16),
    row<std::int32_t>("Int32", NumberType::int32),   row<std::uint32_t>("UInt32", NumberType::uint32),
    row<std::int64_t>("Int64", NumberType::float64), row<std::uint64_t>("UInt64", NumberType::float64),
};

const VtkType* find_type(std::string_view name) {
  const auto* found = std::ranges::find_if(types, [&](const VtkType& type) { return name == type.name; });
  return found == std::end(types) ? nullptr : found;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view without_blanks_before(std::string_view text) {
  const auto* begin = std::ranges::find_if_not(text, is_blank);
  return text.substr(static_cast<std::size_t>(begin - text.begin()));
}

/// The next number of a text, which is cut off; nothing where there is no number.
std::optional<double> next_number(std::string_view& text) {
  text = without_blanks_before(text);
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto size = static_cast<std::size_t>(end - text.data());
  if (fault != std::errc() || (size < text.size() && !is_blank(text[size]))) return {};
  text.remove_prefix(size);
  return value;
}

constexpr std::array<signed char, 256> base64_values() {
  std::array<signed char, 256> values;
  values.fill(-1);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<signed char>(i);
  return values;
}

/// The first `size` bytes of base64, or as many as there are. Padding may stand after every group of four, since VTK
/// encodes the head of an array for itself.
std::string decoded(std::string_view text, std::size_t size) {
  static constexpr std::array<signed char, 256> value_of = base64_values();
  std::string bytes;
  bytes.reserve(std::min(size, text.size()) + 3);
  std::uint32_t group = 0;
  int digits = 0, padding = 0;
  for (const char c : text) {
    if (bytes.size() >= size) break;
    if (is_blank(c)) continue;
    const int value = c == '=' ? 0 : value_of[static_cast<unsigned char>(c)];
    if (value < 0 || (padding > 0 && c != '=')) break;
    padding += c == '=' ? 1 : 0;
    group = group << 6 | static_cast<std::uint32_t>(value);
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 0xff);
    group = 0;
    digits = padding = 0;
  }
  bytes.resize(std::min(bytes.size(), size));
  return bytes;
}

bool is_ascii(pugi::xml_node array) {
  return array.attribute("format").as_string("ascii") == std::string_view("ascii");
}

/// Where the appended data begin, behind their underscore; or the end of the file.
std::size_t appended_begin(std::string_view bytes) {
  const std::size_t tag = bytes.find("<AppendedData"), mark = bytes.find('_', bytes.find('>', tag));
  return tag == std::string_view::npos || mark == std::string_view::npos ? bytes.size() : mark + 1;
}

/// What is XML: raw data are none.
std::string xml_of(std::string_view bytes) {
  const std::size_t begin = appended_begin(bytes);
  std::string text(bytes.substr(0, begin));
  if (begin < bytes.size()) text += "</AppendedData></VTKFile>";
  return text;
}

}  // namespace

struct VtkDocument::Source {
  pugi::xml_node array;
  std::string_view text;
  bool raw;
};

VtkDocument::VtkDocument(std::string_view bytes, std::string path)
    : path_(std::move(path)), head_(xml_of(bytes)), bytes_(bytes), appended_(bytes.substr(appended_begin(bytes))) {
  refuse_wide_text(head_, path_);
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(head_.data(), head_.size(), pugi::parse_default, pugi::encoding_utf8);
  const auto line = [&] {
    const auto until = bytes_.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, result.offset)));
    return 1 + static_cast<int>(std::ranges::count(until, '\n'));
  };
  if (!result)
    throw Error(Fault::input, std::string("is no XML that can be read: ") + result.description(), {path_, line()});
  root_ = document_.child("VTKFile");
  if (!root_) throw Error(Fault::input, "is no file of VTK: there is no element VTKFile", {path_, 1});
  raw_ = root_.child("AppendedData").attribute("encoding").as_string() == std::string_view("raw");
  swapped_ = root_.attribute("byte_order").as_string() == std::string_view("BigEndian");
  word_size_ = root_.attribute("header_type").as_string() == std::string_view("UInt64") ? 8 : 4;
  const std::string compressor = root_.attribute("compressor").as_string();
  zlib_ = compressor == "vtkZLibDataCompressor";
  if (!compressor.empty() && !zlib_)
    fail(root_, "is compressed by " + compressor + ", which is not known here; save it with zlib or none");
}

void VtkDocument::fail(pugi::xml_node at, const std::string& message) const {
  const std::ptrdiff_t offset = std::max<std::ptrdiff_t>(0, at.offset_debug());
  const auto line = std::ranges::count(bytes_.substr(0, static_cast<std::size_t>(offset)), '\n');
  throw Error(Fault::input, message, {path_, static_cast<int>(1 + line)});
}

std::vector<double> VtkDocument::numbers(pugi::xml_node element, const char* attribute, std::size_t count) const {
  std::string_view text = element.attribute(attribute).as_string();
  std::vector<double> result;
  while (!without_blanks_before(text).empty() && result.size() <= count) {
    const std::optional<double> number = next_number(text);
    if (!number) break;
    result.push_back(*number);
  }
  if (result.size() != count || !without_blanks_before(text).empty())
    fail(element, std::string(attribute) + " is " + in_quotes(element.attribute(attribute).as_string()) + " and not " +
                      std::to_string(count) + " numbers");
  return result;
}

std::int64_t VtkDocument::whole(pugi::xml_node element, const char* attribute, std::int64_t otherwise,
                                std::int64_t least, std::int64_t most) const {
  if (!element.attribute(attribute)) return otherwise;
  const double value = numbers(element, attribute, 1)[0];
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) ||
      value != static_cast<double>(static_cast<std::int64_t>(value)))
    fail(element, std::string(attribute) + " is " + number(value) + " and not a whole number from " +
                      std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::int64_t>(value);
}

std::optional<NumberType> VtkDocument::type_of(pugi::xml_node array) {
  const VtkType* type = find_type(array.attribute("type").as_string());
  return type ? std::optional(type->type) : std::nullopt;
}

VtkDocument::Source VtkDocument::source_of(pugi::xml_node array) const {
  const std::string_view format = array.attribute("format").as_string();
  if (format == "binary") return {array, array.text().get(), false};
  if (format != "appended")
    fail(array, "the format of the array is " + in_quotes(format) + "; ascii, binary or appended is known");
  if (appended_.empty()) fail(array, "the array is appended, but the file has no appended data");
  const auto offset = static_cast<std::size_t>(whole(array, "offset", 0, 0, std::int64_t{1} << 52));
  if (offset > appended_.size()) fail(array, "the array begins behind the end of the file");
  return {array, appended_.substr(offset), raw_};
}

std::string VtkDocument::take(const Source& source, std::size_t size) const {
  std::string bytes = source.raw ? std::string(source.text.substr(0, size)) : decoded(source.text, size);
  if (bytes.size() < size)
    fail(source.array, "the array is cut short or damaged: " + std::to_string(bytes.size()) + " of " +
                           std::to_string(size) + " bytes are there");
  return bytes;
}

std::uint64_t VtkDocument::word(const std::string& bytes, std::size_t i) const {
  std::array<char, 8> raw{};
  std::memcpy(raw.data(), bytes.data() + i * word_size_, word_size_);
  if (swapped_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(word_size_));
  return std::bit_cast<std::uint64_t>(raw);
}

std::string VtkDocument::payload(pugi::xml_node array, std::optional<std::size_t> size) const {
  const Source source = source_of(array);
  if (zlib_) return packed_payload(source, size);
  const std::uint64_t length = word(take(source, word_size_), 0);
  if (size && length != *size)
    fail(array, "the array has " + std::to_string(length) + " bytes where " + std::to_string(*size) + " belong");
  if (length > source.text.size())
    fail(array, "the array claims " + std::to_string(length) + " bytes, which the file does not have");
  return take(source, word_size_ + length).substr(word_size_);
}

/// The head of a packed array: the number of blocks, the size of each and of the last one (0: as the others), and the
/// packed size of each.
std::string VtkDocument::packed_payload(const Source& source, std::optional<std::size_t> size) const {
  const auto damaged = [&](const std::string& why) { fail(source.array, "the packed array is damaged: " + why); };
  constexpr std::size_t fixed = 3;
  const std::uint64_t blocks = word(take(source, word_size_), 0);
  if (blocks > source.text.size()) damaged("it claims " + std::to_string(blocks) + " blocks");
  const std::string head = take(source, blocks == 0 ? word_size_ : (fixed + blocks) * word_size_);
  std::vector<std::size_t> ends;
  std::size_t packed = 0, total = 0;
  const auto block_size = [&](std::size_t i) {
    const std::uint64_t last = word(head, 2);
    return i + 1 == blocks && last > 0 ? last : word(head, 1);
  };
  constexpr std::uint64_t most_packed = 1032;  // bytes that deflate makes of one
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::uint64_t bytes = word(head, fixed + i);
    if (bytes > source.text.size() - std::min(packed, source.text.size()) || block_size(i) / most_packed > bytes)
      damaged("block " + std::to_string(i) + " claims more than the file has");
    packed += bytes;
    total += block_size(i);
  }
  if (size && total != *size)
    damaged("it has " + std::to_string(total) + " bytes where " + std::to_string(*size) + " belong");
  // The head is encoded for itself, and so padded to groups of three bytes.
  const std::string all = take(source, head.size() + packed);
  std::string bytes;
  bytes.reserve(total);
  for (std::size_t i = 0, at = head.size(); i < blocks; at += word(head, fixed + i), ++i) {
    const auto block = zlib_unpacked(std::string_view(all).substr(at, word(head, fixed + i)), block_size(i));
    if (!block) damaged("block " + std::to_string(i) + " cannot be unpacked");
    bytes += *block;
  }
  return bytes;
}

std::vector<double> VtkDocument::ascii(pugi::xml_node array, const char* type) const {
  std::string_view text = array.text().get();
  std::vector<double> result;
  while (!(text = without_blanks_before(text)).empty()) {
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    std::optional<double> number = next_number(text);
    if (number) number = find_type(type)->held(*number);
    if (!number) fail(array, in_quotes(word) + " in the array is no number of the type " + type);
    result.push_back(*number);
  }
  return result;
}

std::vector<double> VtkDocument::values(pugi::xml_node array, std::size_t count) const {
  const VtkType* type = find_type(array.attribute("type").as_string());
  if (!type) fail(array, "the array has no type that is known");
  if (is_ascii(array)) {
    std::vector<double> result = ascii(array, type->name);
    if (result.size() == count) return result;
    fail(array,
         "the array has " + std::to_string(result.size()) + " numbers where " + std::to_string(count) + " belong");
  }
  const std::string bytes = payload(array, count * type->size);
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = type->read(bytes.data() + i * type->size, swapped_);
  return result;
}

std::vector<std::string> VtkDocument::strings(pugi::xml_node array) const {
  std::string bytes;
  if (is_ascii(array))
    for (const double code : ascii(array, "UInt8")) bytes += static_cast<char>(static_cast<unsigned char>(code));
  else
    bytes = payload(array, {});
  std::vector<std::string> result;
  for (std::size_t begin = 0, end = 0; (end = bytes.find('\0', begin)) != std::string::npos; begin = end + 1)
    result.push_back(bytes.substr(begin, end - begin));
  return result;
}

std::vector<pugi::xml_node> VtkDocument::pieces(const char* kind, const std::string& read) const {
  const std::string found = root_.attribute("type").as_string();
  const pugi::xml_node data = root_.child(kind);
  if (found != kind || !data)
    fail(root_, "holds " + (found.empty() ? "no kind of data that is named" : found) + "; " + read);
  std::vector<pugi::xml_node> pieces;
  for (const pugi::xml_node piece : data.children("Piece")) pieces.push_back(piece);
  if (pieces.empty()) fail(data, "has no Piece");
  return pieces;
}

void VtkDocument::refuse_hidden(pugi::xml_node piece, std::size_t cells) const {
  constexpr unsigned hidden = 32;
  const pugi::xml_node array = piece.child("CellData").find_child_by_attribute("Name", vtk_ghosts);
  if (!array) return;
  for (const double flags : values(array, cells))
    if ((saturated<unsigned>(flags) & hidden) != 0)
      fail(array, "cells are hidden (vtkGhostType); extract the part that is meant, or unhide all");
}

std::vector<Point> VtkDocument::points(pugi::xml_node piece, std::size_t count) const {
  const pugi::xml_node array = piece.child("Points").child("DataArray");
  if (!array && count > 0) fail(piece, "the piece has no points");
  const std::vector<double> x = count > 0 ? values(array, 3 * count) : std::vector<double>();
  std::vector<Point> points;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) points.push_back({x[i], x[i + 1], x[i + 2]});
  return points;
}

}  // namespace pelage
