#pragma once
// A growth as frames at even distances in time: pictures, a video, meshes with an index, one animated mesh.

#include <memory>
#include <optional>
#include <string>

#include "catalog/plan.h"
#include "grow_options.h"
#include "grow_report.h"
#include "look/palette.h"
#include "pelage/io.h"
#include "pelage/render.h"
#include "run/run.h"

namespace pelage {

/// How frames are drawn and written.
struct FilmForm {
  const Look& look;
  const ShapeFile& file;
  PictureOptions picture;
  SaveOptions mesh;
};

class Film {
 public:
  /// Error(Fault::usage) for what no film can be made of, Error(Fault::output) where a video needs a program that is
  /// not there. The growth is that of `planned`.
  Film(const GrowOptions& options, const Plan& planned);

  /// What frames share: the time of the last one, and the colours that values have then. `run` has grown to its end.
  void end_with(const Run& run, const Look& look);

  /// Grows the last stage once more and writes the frames: the k-th of n shows k/n of its time, with --loop of the
  /// last period. Error(Fault::cancelled) names the last one that is whole.
  void shoot(std::shared_ptr<const Program> program, const FilmForm& form, const Progress& progress,
             GrowReport& report) const;

 private:
  std::vector<double> times(double begin) const;

  const GrowOptions& options_;
  std::optional<double> period_;
  double end_ = 0;
  std::optional<Palette> palette_;
  std::optional<TriangleMesh> last_;  ///< the coat at the end, where its triangles are to be fewer
};

}  // namespace pelage
