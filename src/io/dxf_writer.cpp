#include "io/dxf_writer.h"

#include "base/ascii.h"
#include "base/number.h"
#include "io/output_set.h"

namespace pelage {

namespace {

void append(std::string& text, int code, const std::string& value) {
  text += std::to_string(code) + "\n" + value + "\n";
}

void append_point(std::string& text, const PlanePoint& p) {
  append(text, 10, number(p[0], 9));
  append(text, 20, number(p[1], 9));
  append(text, 30, "0");
}

/// Release 12 knows letters, digits, "_", "-" and "$" in names, 31 at most.
std::string layer_name(const std::string& name) {
  std::string result;
  for (const char c : name)
    if (is_letter_or_digit(c)) {
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  constexpr std::size_t longest = 31;
  return result.empty() ? "lines" : result.substr(0, longest);
}

/// 7 is black on white paper and white on a black screen; the others run through the plain colours.
int color_number(std::size_t part) { return part == 0 ? 7 : static_cast<int>((part - 1) % 6) + 1; }

void append_header(std::string& text, const LineDrawing& drawing) {
  append(text, 0, "SECTION");
  append(text, 2, "HEADER");
  append(text, 9, "$ACADVER");
  append(text, 1, "AC1009");
  if (drawing.millimetres) {
    append(text, 9, "$INSUNITS");
    append(text, 70, "4");
    append(text, 9, "$MEASUREMENT");
    append(text, 70, "1");
  }
  append(text, 9, "$EXTMIN");
  append_point(text, drawing.low);
  append(text, 9, "$EXTMAX");
  append_point(text, drawing.high);
  append(text, 0, "ENDSEC");
}

void append_layers(std::string& text, const LineDrawing& drawing) {
  append(text, 0, "SECTION");
  append(text, 2, "TABLES");
  append(text, 0, "TABLE");
  append(text, 2, "LAYER");
  append(text, 70, std::to_string(drawing.parts.size()));
  for (std::size_t i = 0; i < drawing.parts.size(); ++i) {
    append(text, 0, "LAYER");
    append(text, 2, layer_name(drawing.parts[i].name));
    append(text, 70, "0");
    append(text, 62, std::to_string(color_number(i)));
    append(text, 6, "CONTINUOUS");
  }
  append(text, 0, "ENDTAB");
  append(text, 0, "ENDSEC");
}

void append_line(std::string& text, const Line<PlanePoint>& line, const std::string& layer) {
  append(text, 0, "POLYLINE");
  append(text, 8, layer);
  append(text, 66, "1");
  append_point(text, {0, 0});
  append(text, 70, line.closed ? "1" : "0");
  for (const PlanePoint& p : line.points) {
    append(text, 0, "VERTEX");
    append(text, 8, layer);
    append_point(text, p);
  }
  append(text, 0, "SEQEND");
  append(text, 8, layer);
}

}  // namespace

std::string encode_dxf(const LineDrawing& drawing) {
  std::string text = comment_lines("999\npelage ", record_for_files());
  append_header(text, drawing);
  append_layers(text, drawing);
  append(text, 0, "SECTION");
  append(text, 2, "ENTITIES");
  for (const DrawnLines& part : drawing.parts)
    for (const Line<PlanePoint>& line : part.lines) append_line(text, line, layer_name(part.name));
  append(text, 0, "ENDSEC");
  append(text, 0, "EOF");
  return text;
}

}  // namespace pelage
