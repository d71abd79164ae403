#pragma once
// What a line does in the course of time, as a picture.

#include "look/palette.h"
#include "pelage/image.h"
#include "run/run.h"

namespace pelage {

/// Keeps the fields of a run on a line after every step.
class SpaceTime {
 public:
  void add(const Run& run);

  /// A row for each of `rows` moments at even distances in time, the first one at the top, in the colours of a look
  /// that all rows share.
  Image picture(const Run& run, const Look& look, int rows) const;

 private:
  struct Moment {
    double time;
    std::vector<std::vector<double>> fields;  ///< per species of the stage
  };
  const Moment& nearest(double time) const;
  std::size_t stage_ = 0;
  std::vector<Moment> moments_;
};

}  // namespace pelage
