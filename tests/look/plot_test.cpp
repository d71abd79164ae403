#include "look/plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catalog/models.h"
#include "look/dispersion_plot.h"
#include "look/text.h"
#include "look/ticks.h"

namespace pelage {
namespace {

Plot small_plot() {
  Plot plot;
  plot.x = {-2, 8};
  plot.y = {0, 4};
  return plot;
}

TEST(Ticks, AreRoundWithinTheRangeAndNotTooMany) {
  for (const double low : {-3e-7, -0.013, 0.0, 2.4, 700.0})
    for (const double width : {1e-6, 0.07, 1.0, 13.0, 4e5})
      for (const int most : {3, 7, 9}) {
        const auto ticks = round_ticks(low, low + width, most);
        ASSERT_GE(ticks.size(), 1u);
        EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
        for (std::size_t i = 0; i < ticks.size(); ++i) {
          EXPECT_GE(ticks[i].value, low - 1e-9 * width);
          EXPECT_LE(ticks[i].value, low + width * (1 + 1e-9));
          EXPECT_TRUE(i == 0 || ticks[i].label != ticks[i - 1].label);
        }
      }
}

TEST(Ticks, Labels) {
  const auto ticks = round_ticks(-0.1, 0.1, 5);
  ASSERT_EQ(ticks.size(), 5u);
  EXPECT_EQ(ticks[0].label, "\u22120.10");
  EXPECT_EQ(ticks[2].label, "0.00");
  EXPECT_EQ(round_ticks(0, 2e-7, 2).back().label, "2\u00b710\u207b\u2077");
  EXPECT_EQ(label_of(-1.23456), "\u22121.235");
}

TEST(PlotFrame, CornersAndMiddle) {
  const Plot plot = small_plot();
  const PlotFrame frame(plot);
  const Spot low = frame.place(-2, 0), high = frame.place(8, 4), middle = frame.place(3, 2);
  EXPECT_DOUBLE_EQ(low.x, frame.box().left);
  EXPECT_DOUBLE_EQ(low.y, frame.box().bottom);  // y grows upwards
  EXPECT_DOUBLE_EQ(high.x, frame.box().right);
  EXPECT_DOUBLE_EQ(high.y, frame.box().top);
  EXPECT_DOUBLE_EQ(middle.x, (low.x + high.x) / 2);
  EXPECT_DOUBLE_EQ(middle.y, (low.y + high.y) / 2);
  EXPECT_GE(frame.box().left, 0);
  EXPECT_LE(frame.box().bottom, plot.height);
}

TEST(Plot, CurvesEndAtTheFrame) {
  const Plot plot = small_plot();
  const PlotFrame frame(plot);
  PlotCurve zigzag;
  zigzag.points = {{-4, 2}, {0, 2}, {2, 10}, {4, 2}, {6, -2}, {10, -2}};
  const auto parts = visible_parts(zigzag, frame);
  ASSERT_EQ(parts.size(), 2u);
  const auto expect_near = [](const Spot& a, const Spot& b) { EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 1e-9); };
  expect_near(parts[0].front(), frame.place(-2, 2));
  expect_near(parts[0].back(), frame.place(0.5, 4));
  expect_near(parts[1].front(), frame.place(3.5, 4));
  expect_near(parts[1].back(), frame.place(5, 0));
}

TEST(Plot, WordsStandWhereNoCurveIs) {
  const Rectangle box{0, 0, 1000, 500};
  const Spot at{500, 100}, size{200, 60};
  const auto left = [&](const std::vector<std::vector<Spot>>& curves) { return place_of_words(at, size, curves, box); };
  EXPECT_EQ(left({}).left, 520);
  EXPECT_EQ(left({}).bottom, 490);
  const std::vector<Spot> right_foot = {{500, 400}, {900, 500}}, left_foot = {{400, 0}, {400, 500}};
  EXPECT_EQ(left({right_foot}).right, 480);
  EXPECT_EQ(left({right_foot}).bottom, 490);
  EXPECT_EQ(left({right_foot, left_foot}).left, 520);
  EXPECT_EQ(left({right_foot, left_foot}).top, 20);
  EXPECT_EQ(place_of_words({950, 100}, size, {}, box).right, 930);
}

TEST(Canvas, LinesHaveTheirWidthAndText_ItsPlace) {
  Canvas canvas(200, 100, {1, 1, 1});
  canvas.line({{50.25, 10}, {50.25, 90}}, 3, {0, 0, 0});
  const Image image = canvas.image();
  double darkness = 0;
  for (int x = 0; x < 100; ++x) darkness += 1 - std::pow(static_cast<double>(image.rgb[3 * (50 * 200 + x)]), 1 / 2.2);
  EXPECT_NEAR(darkness, 3, 0.05);

  const double width = text_width("Turing", 30);
  const TextMask mask = rasterise_text("Turing", 30);
  EXPECT_NEAR(mask.width, width, 8);
  EXPECT_NEAR(text_width("TuringTuring", 30), 2 * width, 1);
  EXPECT_NEAR(text_width("Turing", 60), 2 * width, 1e-3);
  EXPECT_LE(text_width(fitted_text("a very long title", 30, 100), 30), 100);
  EXPECT_EQ(fitted_text("short", 30, 1000), "short");
  EXPECT_GT(text_width("\u03c3", 30), 0.3 * 30);  // Greek is in the font, one character and not two
  EXPECT_LT(text_width("\u03c3", 30), 30);
}

TEST(Canvas, TextUpwardsIsTheSameTextTurned) {
  Canvas flat(100, 100, {1, 1, 1}), turned(100, 100, {1, 1, 1});
  flat.text("kT", {20, 60}, {40, {0, 0, 0}, Align::left, false});
  turned.text("kT", {60, 80}, {40, {0, 0, 0}, Align::left, true});
  const Image a = flat.image(), b = turned.image();
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) EXPECT_EQ(a.rgb[3 * (y * 100 + x)], b.rgb[3 * ((99 - x) * 100 + y)]);
}

TEST(DispersionPlot, ShowsWhatTheAnalysisFound) {
  const Stability s = analyse(compile(load_model("turing:production")));
  const Plot plot = dispersion_plot(s, "title", "subtitle");
  ASSERT_EQ(plot.bands.size(), 1u);
  EXPECT_EQ(plot.bands[0].x.low, *s.band_min);
  ASSERT_EQ(plot.marks.size(), 1u);
  EXPECT_EQ(plot.marks[0].y, s.growth);
  EXPECT_LT(*s.band_max, plot.x.high);
  EXPECT_LT(s.growth, plot.y.high);
  double highest = -1;
  for (const auto& [k, sigma] : plot.curves[0].points) highest = std::max(highest, sigma);
  EXPECT_NEAR(highest, s.growth, 1e-3 * s.growth);
}

}  // namespace
}  // namespace pelage
