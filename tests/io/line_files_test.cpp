#include "io/line_files.h"

#include <gtest/gtest.h>

#include "io/dxf_writer.h"
#include "io/svg_writer.h"

namespace pelage {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

LineDrawing drawing() {
  LineDrawing d{{0, 0}, {120, 60}, true, {}};
  d.parts.push_back({"outline", {}, {{{{0, 0}, {120, 0}, {120, 60}}, true}}, {}});
  d.parts.push_back({"b < 4", {1, 0, 0}, {{{{10, 10}, {20, 30}}, false}}, {{{{1, 1}, {2, 1}, {2, 2}}, true}}});
  return d;
}

TEST(LineFiles, SvgIsOfTrueSizeWithYDownwards) {
  const std::string svg = encode_svg(drawing());
  EXPECT_TRUE(has(svg, "width=\"120.2mm\" height=\"60.2mm\" viewBox=\"0 0 120.2 60.2\""));
  EXPECT_TRUE(has(svg, "M10.1 50.1L20.1 30.1\n"));
  EXPECT_TRUE(has(svg, "fill=\"#ff0000\" fill-rule=\"evenodd\" stroke=\"none\" d=\"M1.1 59.1L2.1 59.1 2.1 58.1Z"));
  EXPECT_TRUE(has(svg, "<title>b &#60; 4</title>"));
}

TEST(LineFiles, SvgOfTexturesHasNoUnit) {
  LineDrawing d = drawing();
  d.high = {1, 1};
  d.millimetres = false;
  d.parts[0].lines = {{{{0, 0}, {0.5, 1}}, false}};
  EXPECT_TRUE(has(encode_svg(d), "width=\"1000\" height=\"1000\" viewBox=\"0 0 1000 1000\""));
  EXPECT_TRUE(has(encode_svg(d), "M0 1000L500 0\n"));
}

TEST(LineFiles, DxfHasPolylinesOnLayers) {
  const std::string dxf = encode_dxf(drawing());
  EXPECT_TRUE(dxf.starts_with("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n"));
  EXPECT_TRUE(dxf.ends_with("0\nENDSEC\n0\nEOF\n"));
  EXPECT_TRUE(has(dxf, "0\nPOLYLINE\n8\noutline\n66\n1\n10\n0\n20\n0\n30\n0\n70\n1\n0\nVERTEX\n8\noutline\n10\n0\n"));
  EXPECT_TRUE(has(dxf, "0\nPOLYLINE\n8\nb_4\n66\n1\n10\n0\n20\n0\n30\n0\n70\n0\n0\nVERTEX\n8\nb_4\n10\n10\n20\n10\n"));
}

TEST(LineFiles, LinesInSpaceAsObj) {
  const std::vector<SpaceLines> lines{
      {"a b", {{{{0, 0, 1}, {1, 0, 1}, {1, 2, 1}}, true}, {{{5, 0, 0}, {6, 0, 0}}, false}}},
      {"c", {{{{7, 0, 0}, {8, 0.5, 0}}, false}}}};
  const std::string obj = encode_line_obj(lines);
  EXPECT_TRUE(has(obj, "o a_b\nv 0 0 1\nv 1 0 1\nv 1 2 1\nl 1 2 3 1\nv 5 0 0\nv 6 0 0\nl 4 5\no c\n"));
  EXPECT_TRUE(has(obj, "v 8 0.5 0\nl 6 7\n"));
  const std::string vtp = encode_line_vtp(lines);
  EXPECT_TRUE(has(vtp, "NumberOfPoints=\"7\" NumberOfVerts=\"0\" NumberOfLines=\"3\""));
}

}  // namespace
}  // namespace pelage
