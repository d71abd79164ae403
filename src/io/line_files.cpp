#include "io/line_files.h"

#include "base/checked.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/dxf_writer.h"
#include "io/file_bytes.h"
#include "io/output_set.h"
#include "io/svg_writer.h"
#include "io/vtk_xml.h"

namespace pelage {

namespace {

/// Numbers of the points of a line, those of closed ones with the first at the end.
std::vector<std::int32_t> numbers_of(const Line<Point>& line, std::int32_t first) {
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < line.points.size(); ++i) numbers.push_back(first + static_cast<std::int32_t>(i));
  if (line.closed) numbers.push_back(first);
  return numbers;
}

std::string name_in_obj(std::string name) {
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
}

}  // namespace

std::vector<std::string> drawing_extensions() { return {".svg", ".dxf"}; }
std::vector<std::string> space_line_extensions() { return {".obj", ".vtp"}; }

std::string encode_line_obj(const std::vector<SpaceLines>& lines) {
  std::string text = "# written by pelage\n" + comment_lines("# pelage ", record_for_files());
  std::int32_t first = 1;
  for (const SpaceLines& kind : lines) {
    text += "o " + name_in_obj(kind.name) + "\n";
    for (const Line<Point>& line : kind.lines) {
      for (const Point& p : line.points) {
        text += 'v';
        for (const double x : p) {
          text += ' ';
          append_text(text, x);
        }
        text += '\n';
      }
      text += 'l';
      for (const std::int32_t v : numbers_of(line, first)) {
        text += ' ';
        append_text(text, v);
      }
      text += '\n';
      first += static_cast<std::int32_t>(line.points.size());
    }
  }
  return text;
}

std::string encode_line_vtp(const std::vector<SpaceLines>& lines) {
  std::vector<Point> points;
  std::string numbers, ends;
  Attribute kind{"isoline", 1, Domain::face, {}, NumberType::int32};
  std::int32_t end = 0;
  for (const SpaceLines& of : lines) {
    for (const Line<Point>& line : of.lines) {
      for (const std::int32_t v : numbers_of(line, static_cast<std::int32_t>(points.size()))) {
        append_bytes(numbers, v);
        ++end;
      }
      append_bytes(ends, end);
      points.insert(points.end(), line.points.begin(), line.points.end());
      kind.values.push_back(static_cast<double>(kind.labels.size()));
    }
    kind.labels.push_back(of.name);
  }
  const std::vector<Attribute> attributes{kind};
  std::string text =
      vtk_head("PolyData") + ">\n<FieldData>\n" + vtk_labels(attributes) + vtk_record() + "</FieldData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(points.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
          std::to_string(kind.values.size()) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<CellData>\n";
  append_vtk_attribute(text, kind, ColorBits::eight);
  text += "</CellData>\n";
  append_vtk_points(text, points);
  text += "<Lines>\n";
  append_vtk_array(text, "Int32", "connectivity", 1, numbers);
  append_vtk_array(text, "Int32", "offsets", 1, ends);
  return text + "</Lines>\n</Piece>\n" + vtk_tail("PolyData");
}

void write_lines(const LineDrawing& drawing, const std::string& path) {
  write_file(path, lower_extension(path) == ".dxf" ? encode_dxf(drawing) : encode_svg(drawing));
}

void write_lines(const std::vector<SpaceLines>& lines, const std::string& path) {
  write_file(path, lower_extension(path) == ".vtp" ? encode_line_vtp(lines) : encode_line_obj(lines));
}

}  // namespace pelage
