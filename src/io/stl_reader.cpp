#include "io/stl_reader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "base/ascii.h"
#include "io/text_scanner.h"

namespace pelage {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read in the machine's order");

constexpr std::size_t header_size = 84, facet_size = 50;

std::uint64_t binary_size(std::string_view bytes) {
  std::uint32_t facets = 0;
  std::memcpy(&facets, bytes.data() + 80, sizeof facets);
  return header_size + facet_size * static_cast<std::uint64_t>(facets);
}

bool same_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return to_lower(a) == b; });
}

bool looks_like_text(std::string_view bytes) {
  if (bytes.size() >= header_size && binary_size(bytes) == bytes.size()) return false;
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return first != std::string_view::npos && same_word(bytes.substr(first, 5), "solid");
}

RawShape read_binary(std::string_view bytes, const std::string& path) {
  if (bytes.size() < header_size)
    throw Error(Fault::input, "is no STL file: too short for a binary one, and a text one begins with \"solid\"",
                {path});
  const std::uint64_t promised = binary_size(bytes);
  if (promised != bytes.size())
    throw Error(Fault::input,
                "the header promises " + std::to_string((promised - header_size) / facet_size) + " facets (" +
                    std::to_string(promised) + " bytes), but the file has " + std::to_string(bytes.size()) +
                    " bytes; it is damaged or no STL file",
                {path});
  RawShape shape;
  const std::size_t facets = (bytes.size() - header_size) / facet_size;
  shape.mesh.points.reserve(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    float values[12];  // normal and three corners
    std::memcpy(values, bytes.data() + header_size + f * facet_size, sizeof values);
    for (int c = 3; c < 12; c += 3) {
      shape.mesh.corners.push_back(static_cast<std::int32_t>(shape.mesh.points.size()));
      shape.mesh.points.push_back({values[c], values[c + 1], values[c + 2]});
    }
    shape.mesh.end_face();
  }
  return shape;
}

class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& path) : text_(bytes, path) {}

  RawShape read() {
    bool open = false;  // inside of outer loop ... endloop
    for (; !text_.at_end(); text_.skip_line()) {
      const std::string_view word = text_.word();
      if (same_word(word, "vertex")) {
        if (!open) text_.fail("a vertex outside of a loop");
        vertex();
      } else if (same_word(word, "outer")) {
        if (open) text_.fail("a loop inside of a loop (is endloop missing?)");
        open = true;
        shape_.face_lines.push_back(text_.line());
      } else if (same_word(word, "endloop")) {
        if (!open) text_.fail("endloop without a loop");
        open = false;
        shape_.mesh.end_face();
      } else if (!is_frame(word)) {
        text_.fail("unexpected word " + in_quotes(word) + "; the file is damaged or no STL file");
      }
    }
    if (open) text_.fail("the file ends within a facet; it is cut short");
    return std::move(shape_);
  }

 private:
  static bool is_frame(std::string_view word) {
    for (const char* known : {"solid", "facet", "endfacet", "endsolid"})
      if (same_word(word, known)) return true;
    return false;
  }

  void vertex() {
    shape_.vertex_lines.push_back(text_.line());
    Point p;
    for (double& x : p) x = text_.number("a coordinate");
    shape_.mesh.corners.push_back(static_cast<std::int32_t>(shape_.mesh.points.size()));
    shape_.mesh.points.push_back(p);
  }

  TextScanner text_;
  RawShape shape_;
};

}  // namespace

RawShape read_stl(std::string_view bytes, const std::string& path) {
  return looks_like_text(bytes) ? TextReader(bytes, path).read() : read_binary(bytes, path);
}

}  // namespace pelage
