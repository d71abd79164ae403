#include "io/ply_header.h"

#include <algorithm>
#include <optional>

#include "io/text_scanner.h"
#include "pelage/error.h"

namespace pelage {

namespace {

std::optional<NumberType> type_named(std::string_view name) {
  struct Row {
    std::string_view name;
    NumberType type;
  };
  static constexpr Row rows[] = {
      {"char", NumberType::int8},       {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
      {"uint8", NumberType::uint8},     {"short", NumberType::int16},     {"int16", NumberType::int16},
      {"ushort", NumberType::uint16},   {"uint16", NumberType::uint16},   {"int", NumberType::int32},
      {"int32", NumberType::int32},     {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
      {"float", NumberType::float32},   {"float32", NumberType::float32}, {"double", NumberType::float64},
      {"float64", NumberType::float64},
  };
  for (const Row& row : rows)
    if (row.name == name) return row.type;
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path), text_(bytes, path) {}

  PlyHeader read() {
    if (text_.word() != "ply") text_.fail("a PLY file begins with \"ply\"; this one does not");
    text_.skip_line();
    bool format = false;
    for (std::string_view keyword = text_.word(); keyword != "end_header"; keyword = text_.word()) {
      if (text_.rest().empty()) text_.fail("the header has no end_header line; the file is damaged");
      if (keyword == "format")
        format = read_format();
      else if (keyword == "element")
        read_element();
      else if (keyword == "property")
        read_property();
      else if (keyword == "comment")
        header_.comments.emplace_back(text_.rest_of_line());
      else if (!keyword.empty() && keyword != "obj_info")
        text_.fail("unknown word " + in_quotes(keyword) + " in the header (is the end_header line missing?)");
      text_.skip_line();
    }
    end_last_line();
    if (!format) text_.fail("the header has no format line; the file is damaged");
    if (header_.size == 0) header_.size = place();
    header_.lines = text_.line() - 1;
    check_counts();
    return std::move(header_);
  }

 private:
  std::size_t place() const { return static_cast<std::size_t>(text_.rest().data() - bytes_.data()); }

  /// Where lines end in \r alone, a \n behind the last one is the first byte of the data.
  void end_last_line() {
    const std::size_t end = place();
    const bool bare = end < bytes_.size() && bytes_[end] == '\r' && bytes_.find('\n') >= end;
    text_.skip_line();
    if (bare) header_.size = end + 1;
  }

  bool read_format() {
    const std::string_view name = text_.word(), version = text_.word();
    if (name == "ascii")
      header_.format = PlyFormat::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyFormat::little_endian;
    else if (name == "binary_big_endian")
      header_.format = PlyFormat::big_endian;
    else
      text_.fail("unknown PLY format " + in_quotes(name) +
                 "; known are ascii, binary_little_endian and binary_big_endian");
    if (version != "1.0") text_.fail("unknown PLY version " + in_quotes(version) + "; known is 1.0");
    return true;
  }

  void read_element() {
    PlyElement element;
    element.name = text_.word();
    element.line = text_.line();
    const std::int64_t count = text_.integer("a number of elements");
    if (count < 0) text_.fail("element " + element.name + " has a negative count");
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
  }

  NumberType read_type() {
    const std::string_view name = text_.word();
    const std::optional<NumberType> type = type_named(name);
    if (!type) text_.fail("unknown type " + in_quotes(name) + " of a property");
    return *type;
  }

  void read_property() {
    if (header_.elements.empty()) text_.fail("a property before the first element");
    PlyProperty property;
    TextScanner ahead = text_;
    if (ahead.word() == "list") {
      text_.word();
      property.list = true;
      property.count_type = read_type();
      if (property.count_type == NumberType::float32 || property.count_type == NumberType::float64)
        text_.fail("the length of a list must be an integer");
    }
    property.type = read_type();
    property.name = text_.rest_of_line();
    if (property.name.empty()) text_.fail("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  /// The fewest bytes that one element takes in the file.
  std::uint64_t least_size(const PlyElement& element) const {
    if (header_.format == PlyFormat::ascii) return 2 * std::max<std::uint64_t>(1, element.properties.size()) - 1;
    std::uint64_t size = 0;
    for (const PlyProperty& p : element.properties) size += size_of(p.list ? p.count_type : p.type);
    return size;
  }

  void check_counts() const {
    const std::uint64_t left = bytes_.size() - header_.size;
    for (const PlyElement& element : header_.elements) {
      const std::uint64_t size = least_size(element);
      if (size > 0 && element.count > (left + 1) / size)  // the last line may lack its end
        throw Error(Fault::input,
                    "the header promises " + std::to_string(element.count) + " of \"" + element.name +
                        "\", but the file can hold at most " + std::to_string((left + 1) / size) +
                        "; it is cut short or damaged",
                    {path_, element.line});
    }
  }

  std::string_view bytes_;
  const std::string& path_;
  TextScanner text_;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(NumberType type) {
  static constexpr std::size_t sizes[] = {4, 8, 1, 1, 2, 2, 4, 4};
  return sizes[static_cast<int>(type)];
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& path) { return HeaderReader(bytes, path).read(); }

}  // namespace pelage
