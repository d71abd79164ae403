#include "io/svg_writer.h"

#include <algorithm>

#include "base/number.h"
#include "base/srgb.h"
#include "io/output_set.h"
#include "io/vtk_xml.h"
#include "io/xml_text.h"

namespace pelage {

namespace {

/// Thin enough for all machines that cut where lines are thin [mm].
constexpr double thickest_line = 0.1;
constexpr double texture_side = 1000;

/// From a drawing to the file, whose y points down.
struct Paper {
  explicit Paper(const LineDrawing& d) : scale(d.millimetres ? 1 : texture_side) {
    const double width = scale * (d.high[0] - d.low[0]), height = scale * (d.high[1] - d.low[1]);
    line = std::min(thickest_line, std::max(width, height) / 1000);
    const double margin = d.millimetres ? line : 0;  // lines at the edge are as thick as the others
    left = d.low[0] - margin / scale;
    top = d.high[1] + margin / scale;
    size = {width + 2 * margin, height + 2 * margin};
  }
  std::string text(const PlanePoint& p) const {
    return number(scale * (p[0] - left), 7) + " " + number(scale * (top - p[1]), 7);
  }

  double scale, line, left, top;
  std::array<double, 2> size;
};

std::string hex(const std::array<double, 3>& color) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const double c : color) {
    const int byte = srgb_byte(c);
    text += digits[byte / 16];
    text += digits[byte % 16];
  }
  return text;
}

std::string path_data(const std::vector<Line<PlanePoint>>& lines, const Paper& paper) {
  std::string text;
  for (const Line<PlanePoint>& line : lines) {
    for (std::size_t i = 0; i < line.points.size(); ++i)
      text += (i == 0 ? "M" : i == 1 ? "L" : " ") + paper.text(line.points[i]);
    text += line.closed ? "Z\n" : "\n";
  }
  return text;
}

void append_part(std::string& text, const DrawnLines& part, const std::string& id, const Paper& paper) {
  text += "<g id=\"" + id + "\">\n<title>" + escape_xml(part.name) + "</title>\n";
  if (!part.region.empty())
    text += "<path class=\"region\" fill=\"" + hex(part.color) + "\" fill-rule=\"evenodd\" stroke=\"none\" d=\"" +
            path_data(part.region, paper) + "\"/>\n";
  if (!part.lines.empty())
    text += "<path class=\"lines\" fill=\"none\" stroke=\"" + hex(part.color) + "\" stroke-width=\"" +
            number(paper.line) + "\" stroke-linejoin=\"round\" d=\"" + path_data(part.lines, paper) + "\"/>\n";
  text += "</g>\n";
}

}  // namespace

std::string encode_svg(const LineDrawing& drawing) {
  const Paper paper(drawing);
  const std::string width = number(paper.size[0], 7), height = number(paper.size[1], 7);
  const std::string unit = drawing.millimetres ? "mm" : "";
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                     width + unit + "\" height=\"" + height + unit + "\" viewBox=\"0 0 " + width + " " + height +
                     "\">\n";
  if (const std::string record = record_for_files(); !record.empty())
    text += "<metadata id=\"pelage\">" + escape_xml(record) + "</metadata>\n";
  for (std::size_t i = 0; i < drawing.parts.size(); ++i)
    append_part(text, drawing.parts[i], i == 0 ? "outline" : "lines" + std::to_string(i), paper);
  return text + "</svg>\n";
}

}  // namespace pelage
