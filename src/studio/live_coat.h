#pragma once
// A coat that grows while somebody looks at it, paints on it and turns its parameters.

#include <functional>

#include "pelage/io.h"
#include "pelage/progress.h"
#include "pelage/recipe.h"
#include "shape/stroke.h"
#include "studio/message.h"
#include "studio/node_view.h"

namespace pelage {

class LiveCoat {
 public:
  /// Of a recipe on a shape, from its start. With `before` the fields go on as they stand there where they can
  /// (`kept`). Error as those of Growth (pelage/grow.h).
  LiveCoat(const ShapeFile& shape, const Recipe& recipe, const Progress& progress, const LiveCoat* before);

  bool kept() const { return kept_; }

  /// A step, and others for as long as `more` says. A coat that is done goes on: it has come to its end, not to a wall.
  /// Error(Fault::numerics) once it has failed.
  void advance(const std::function<bool()>& more);
  /// Moves a species of the stage in progress towards a value, as far as the stroke's paint comes. Error(Fault::usage)
  /// for an unknown species.
  void paint(const std::string& species, double value, const BrushStroke& stroke);
  /// Shows the coat as the look of another recipe has it, that of the last stage once it has begun.
  /// Error(Fault::usage), located, for faults in it.
  void show(const Recipe& recipe);

  /// What `begin` and `advance` reply of it: with its stages, its geometry and its colours.
  Message described() const;
  Message state() const;
  Message colors() const;
  Message field(const std::string& species) const;
  Message sampled(const Point& at) const;
  /// As finely as files get it.
  Message fine() const;
  /// What files hold.
  TriangleMesh dressed() const;
  /// The same as images, a GLB; errors of textured_coat().
  std::string baked(int size, const SaveOptions& options, const Progress& progress) const;

  const Run& run() const { return run_; }
  std::string checkpoint() const { return run_.checkpoint(); }
  void restore(const std::string& checkpoint);

 private:
  Look look_now() const;
  void follow_stage();
  std::size_t species_number(const std::string& name) const;
  void add_colors(Message& message) const;
  void add_geometry(Message& message) const;

  Run run_;
  bool kept_ = false;
  Recipe recipe_;
  Paint paint_;  ///< of the stage in progress
  NodeView view_;
};

}  // namespace pelage
