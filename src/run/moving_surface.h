#pragma once
// The shape of a run on its way: faired, growing, or both.

#include <memory>

#include "run/program.h"

namespace pelage {

class MovingSurface {
 public:
  MovingSurface(const TriangleMesh& shape, const SurfaceMotion& motion);

  /// Whether more moves are to come.
  bool moving() const { return motion_.growth != 0 || (fairing_ && !fairing_->done()); }
  /// Brings the surface to where it is for the time step after `steps` others, which ends at `time`; true if it has
  /// moved. Called again for a shorter step it goes to the earlier time.
  bool advance(std::int64_t steps, double time);
  /// The vertices of the shape now [world units].
  std::vector<Point> points() const { return grown(faired()); }
  /// The same without growth, and points with it.
  std::vector<Point> faired() const { return fairing_ ? fairing_->points() : still_; }
  std::vector<Point> grown(std::vector<Point> points) const;
  /// Null when the surface is not faired.
  const Fairing* fairing() const { return fairing_.get(); }

  /// All that changes, for checkpoints.
  struct State {
    Fairing::State fairing;  ///< empty when it is not faired
    double scale = 1;
  };
  State state() const;
  /// One of the same shape and motion.
  void restore(State state);

 private:
  SurfaceMotion motion_;
  std::vector<Point> still_;  ///< the vertices when they are not faired
  std::unique_ptr<Fairing> fairing_;
  Point middle_{};
  double scale_ = 1;
};

}  // namespace pelage
