#include "look/sheet_image.h"

#include <algorithm>

#include "look/grid_picture.h"
#include "look/tessellation.h"

namespace pelage {

namespace {

/// Nodes that are painted together: enough for all threads.
constexpr std::size_t band_nodes = 1 << 17;

/// What its ramp ends at.
Palette palette_of(const CoatFields& fields, Paint paint) {
  CoatSamples samples;
  samples.fields.resize(fields.coefficients.size());
  samples.fields[paint.shown] = fields.coefficients[paint.shown];
  return make_palette(std::move(paint), samples, fields.uniform);
}

/// Some nodes, and behind them the first and the last of all: formulas may count from the sheet's box.
CoatSamples samples_of(const CoatFields& fields, const Grid& grid, bool curvature, std::size_t begin, std::size_t end) {
  CoatSamples s;
  for (std::size_t v = begin; v < end; ++v) s.position.push_back(grid.point(static_cast<std::int32_t>(v)));
  const std::size_t last = grid.nodes() - 1;
  s.position.insert(s.position.end(), {grid.point(0), grid.point(static_cast<std::int32_t>(last))});
  s.normal.assign(s.size(), Point{0, 0, 1});
  if (curvature) s.curvature.k1 = s.curvature.k2 = std::vector<double>(s.size(), 0.0);
  for (const std::vector<double>& field : fields.coefficients) {
    const auto first = field.begin() + static_cast<std::ptrdiff_t>(begin);
    std::vector<double>& band = s.fields.emplace_back(first, first + static_cast<std::ptrdiff_t>(end - begin));
    band.insert(band.end(), {field[0], field[last]});
  }
  s.length_unit = fields.length_unit;
  s.wavelength = fields.wavelength;
  s.origin = fields.origin;
  s.period = fields.period;
  s.seed = fields.seed;
  return s;
}

}  // namespace

bool is_bare_sheet(const CoatFields& fields) {
  const Grid* grid = as<Grid>(fields.nodes);
  return grid && grid->even() && grid->dimension() == 2 && fields.shape->attributes.empty() && fields.textures.empty();
}

Image sheet_image(const CoatFields& fields, const Look& look) {
  Paint of_look = resolve_paint(look, fields.species);
  const TessellationRequest request = tessellation_request(look, of_look);
  require_own_nodes(request);
  const Palette palette = palette_of(fields, std::move(of_look));
  const Grid& grid = *as<Grid>(fields.nodes);
  const auto width = static_cast<std::size_t>(grid.count[0]), height = static_cast<std::size_t>(grid.count[1]);
  Image image{grid.count[0], grid.count[1], std::vector<float>(3 * grid.nodes())};
  const std::size_t rows = std::max<std::size_t>(1, band_nodes / width);
  for (std::size_t j = 0; j < height; j += rows) {
    const std::size_t end = std::min(j + rows, height);
    const std::vector<double> colors =
        paint(samples_of(fields, grid, request.curvature, j * width, end * width), palette);
    for (std::size_t row = j; row < end; ++row)
      std::transform(colors.begin() + static_cast<std::ptrdiff_t>(3 * width * (row - j)),
                     colors.begin() + static_cast<std::ptrdiff_t>(3 * width * (row - j + 1)),
                     image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * width * (height - 1 - row)),
                     [](double value) { return static_cast<float>(value); });
  }
  return image;
}

}  // namespace pelage
