#include "gridgen/plane_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "pelage/error.h"

namespace pelage {
namespace {

using Function = std::function<double(double, double)>;

void set_values(Grid& sheet, const Function& f) {
  Attribute b{"b", 1, Domain::vertex, {}};
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(sheet.nodes()); ++v)
    b.values.push_back(f(sheet.point(v)[0], sheet.point(v)[1]));
  sheet.set(b);
}

Grid even_sheet(const Function& f, bool periodic = false) {
  Grid sheet;
  sheet.count = {20, 12, 1};
  sheet.origin = {-1, 2, 0.5};
  sheet.spacing = {0.1, 0.25, 1};
  sheet.periodic = {periodic, periodic, false};
  set_values(sheet, f);
  return sheet;
}

/// A part of a ring.
Grid bent_sheet(const Function& f) {
  Grid sheet;
  sheet.count = {60, 30, 1};
  for (int j = 0; j < 30; ++j)
    for (int i = 0; i < 60; ++i) {
      const double angle = 0.1 + 0.04 * i, radius = 1 + 0.03 * j;
      sheet.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  set_values(sheet, f);
  return sheet;
}

double plane(double x, double y) { return 0.3 + 2 * x - 0.7 * y; }

TEST(PlaneField, PlanesAreWhatTheyAre) {
  for (const Grid& sheet : {even_sheet(plane), bent_sheet(plane)}) {
    const PlaneField field(sheet, {"b"});
    for (const std::int32_t v : {sheet.node(7, 5, 0), sheet.node(12, 6, 0)}) {
      const double x = sheet.point(v)[0] + 0.01, y = sheet.point(v)[1] + 0.02;
      const PlaneField::Value b = field.at(0, x, y);
      EXPECT_NEAR(b.value, plane(x, y), 1e-9);
      EXPECT_NEAR(b.dx, 2, 1e-9);
      EXPECT_NEAR(b.dy, -0.7, 1e-9);
    }
  }
}

double waves(double x, double y) { return std::sin(3 * x + 1) * std::cos(2 * y); }

TEST(PlaneField, DerivativesAreThoseOfDifferencesEverywhere) {
  for (const bool periodic : {false, true}) {
    const PlaneField field(even_sheet(waves, periodic), {"b"});
    constexpr double h = 1e-5;
    for (double x = -3; x < 3; x += 0.37)
      for (double y = 1; y < 6; y += 0.41) {
        const auto at = [&](double dx, double dy) { return field.at(0, x + dx, y + dy).value; };
        EXPECT_NEAR(field.at(0, x, y).dx, (at(h, 0) - at(-h, 0)) / (2 * h), 1e-7) << x << " " << y;
        EXPECT_NEAR(field.at(0, x, y).dy, (at(0, h) - at(0, -h)) / (2 * h), 1e-7) << x << " " << y;
      }
    EXPECT_EQ(std::abs(field.at(0, -0.4, 3).value - field.at(0, 1.6, 3).value) < 1e-12, periodic);  // 2 further
  }
}

TEST(PlaneField, GoesOnBeyondItsSheet) {
  const PlaneField field(even_sheet(plane), {"b"});
  EXPECT_NEAR(field.at(0, -50, 2 + 5 * 0.25).value, plane(-1, 2 + 5 * 0.25), 1e-12);
  EXPECT_EQ(field.at(0, 1e300, 3).dx, 0);
  for (const double nowhere : {1e300, -1e300, std::numeric_limits<double>::infinity(), std::nan("")})
    for (const bool periodic : {false, true})
      EXPECT_LT(std::abs(PlaneField(even_sheet(plane, periodic), {"b"}).at(0, nowhere, nowhere).value), 10);
  const PlaneField bent(bent_sheet([](double, double) { return 4; }), {"b"});
  EXPECT_NEAR(bent.at(0, 0, 0).value, 4, 1e-12);  // in the hole
}

TEST(PlaneField, IsLaidOverABox) {
  PlaneField field(even_sheet(plane), {"b"});
  field.lay_between({0, 0}, {19, 11});
  EXPECT_NEAR(field.at(0, 7.5, 4).value, plane(-1 + 0.1 * 7.5, 2 + 0.25 * 4), 1e-12);
}

TEST(PlaneField, IsOfASheetInThePlane) {
  Grid block;
  block.count = {3, 3, 3};
  EXPECT_THROW(PlaneField(block, {}), Error);
  Grid curved = bent_sheet(plane);
  curved.points[5][2] = 0.1;
  EXPECT_THROW(PlaneField(curved, {"b"}), Error);
  EXPECT_THROW(PlaneField(even_sheet(plane), {"c"}), Error);
}

TEST(PlaneField, OnlyWhatTheFormulaReads) {
  Grid sheet = even_sheet(plane);
  Attribute c = *sheet.find("b");
  c.name = "c";
  sheet.set(c);
  EXPECT_EQ(names_read(sheet, "1 + 3*attribute(b)"), std::vector<std::string>{"b"});
}

}  // namespace
}  // namespace pelage
