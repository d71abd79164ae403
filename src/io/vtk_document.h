#pragma once
// A file of VTK XML: its elements, and the arrays in all encodings that VTK writes.

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pelage/triangle_mesh.h"

namespace pelage {

class VtkDocument {
 public:
  /// Error(Fault::input) for what is no XML of VTK. The bytes must outlive the document.
  VtkDocument(std::string_view bytes, std::string path);

  /// The element VTKFile.
  pugi::xml_node root() const { return root_; }

  /// Error(Fault::input) at the line of an element.
  [[noreturn]] void fail(pugi::xml_node at, const std::string& message) const;

  /// Numbers in an attribute of an element; fails unless there are so many.
  std::vector<double> numbers(pugi::xml_node element, const char* attribute, std::size_t count) const;

  /// A whole number in an attribute, or `otherwise` where there is none; fails outside of [least, most].
  std::int64_t whole(pugi::xml_node element, const char* attribute, std::int64_t otherwise, std::int64_t least,
                     std::int64_t most) const;

  /// The type of an array's numbers as attributes have it: 64 bit integers are float64; nothing for others.
  static std::optional<NumberType> type_of(pugi::xml_node array);

  /// The numbers of an array, ascii, inline or appended, base64 or raw, packed by zlib or not, in either order of
  /// bytes. Fails unless they are `count` and are there: memory is taken for no more than the file holds.
  std::vector<double> values(pugi::xml_node array, std::size_t count) const;

  /// The pieces of the data of a kind; fails where the file holds another, with what is read, and without any.
  std::vector<pugi::xml_node> pieces(const char* kind, const std::string& read) const;

  /// Fails where a piece of so many cells has hidden ones.
  void refuse_hidden(pugi::xml_node piece, std::size_t cells) const;

  /// So many points of a piece; fails where there are none of them.
  std::vector<Point> points(pugi::xml_node piece, std::size_t count) const;

  /// The strings of an array, each of which a 0 ends.
  std::vector<std::string> strings(pugi::xml_node array) const;

 private:
  struct Source;  ///< the text that an array's bytes are in
  Source source_of(pugi::xml_node array) const;
  std::string take(const Source& source, std::size_t size) const;
  std::uint64_t word(const std::string& bytes, std::size_t i) const;
  std::string payload(pugi::xml_node array, std::optional<std::size_t> size) const;
  std::string packed_payload(const Source& source, std::optional<std::size_t> size) const;
  std::vector<double> ascii(pugi::xml_node array, const char* type) const;

  std::string path_;
  std::string head_;  ///< the XML; pugixml works in it
  std::string_view bytes_, appended_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  bool raw_ = false;  ///< the appended bytes are as they are
  bool swapped_ = false, zlib_ = false;
  std::size_t word_size_ = 4;
};

}  // namespace pelage
