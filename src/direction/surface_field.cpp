#include "base/box.h"
#include "base/number.h"
#include "direction/direction_field.h"
#include "direction/guides.h"
#include "pelage/field.h"

namespace pelage {

namespace {

FieldWish wish_of(const FieldOptions& options, double diagonal) {
  FieldWish wish;
  wish.axis = options.axis;
  wish.curvature = options.curvature;
  wish.from = options.from;
  wish.to = options.to;
  wish.strokes = options.strokes;
  wish.across = options.across;
  wish.smooth = options.smooth.value_or(default_field_smoothing * diagonal);
  if (!(wish.smooth > 0))
    throw Error(Fault::usage, "a field is smoothed over a length greater than 0, not over " + number(wish.smooth));
  return wish;
}

SurfaceField public_field(DirectionField field) {
  SurfaceField result{field.n, std::move(field.direction), {}, field.roughness};
  for (std::size_t f = 0; f < field.index.size(); ++f)
    if (field.index[f] != 0) result.singularities.push_back({static_cast<Index>(f), field.index[f]});
  return result;
}

}  // namespace

struct FieldMaker::Parts {
  std::vector<Point> points;
  Connection connection;
};

FieldMaker::FieldMaker(const TriangleMesh& mesh)
    : parts_(std::make_unique<const Parts>(
          Parts{mesh.points, make_connection(make_topology(mesh.points.size(), mesh.triangles), mesh.points)})) {}

FieldMaker::~FieldMaker() = default;
FieldMaker::FieldMaker(FieldMaker&&) noexcept = default;
FieldMaker& FieldMaker::operator=(FieldMaker&&) noexcept = default;

SurfaceField FieldMaker::make(const FieldOptions& options) const {
  const auto& [points, connection] = *parts_;
  const double diagonal = box_of(points).diagonal();
  const std::vector<Guide> guides = find_guides(wish_of(options, diagonal), connection, points, diagonal);
  return public_field(direction_field(connection, options.n, guides));
}

SurfaceField surface_field(const TriangleMesh& mesh, const FieldOptions& options) {
  return FieldMaker(mesh).make(options);
}

TriangleMesh with_directions(TriangleMesh mesh, const std::vector<Point>& direction) {
  Attribute attribute{direction_attribute, 3, Domain::vertex, {}};
  for (const Point& d : direction) attribute.values.insert(attribute.values.end(), d.begin(), d.end());
  mesh.set(std::move(attribute));
  return mesh;
}

}  // namespace pelage
