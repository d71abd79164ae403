#include "run/moving_surface.h"

#include <cmath>

#include "base/box.h"

namespace pelage {

MovingSurface::MovingSurface(const TriangleMesh& shape, const SurfaceMotion& motion)
    : motion_(motion), middle_(box_of(shape.points).middle()) {
  if (motion.fair)
    fairing_ = std::make_unique<Fairing>(shape, *motion.fair);
  else
    still_ = shape.points;
}

bool MovingSurface::advance(std::int64_t steps, double time) {
  if (steps % motion_.every != 0) return false;
  const bool fair_now = fairing_ && !fairing_->done() && fairing_->report().steps * motion_.every <= steps;
  if (fair_now) fairing_->step();
  const double scale = std::exp(motion_.growth * time);
  const bool grown = scale != scale_;
  scale_ = scale;
  return fair_now || grown;
}

std::vector<Point> MovingSurface::grown(std::vector<Point> points) const {
  if (scale_ == 1) return points;
  for (Point& p : points)
    for (std::size_t k = 0; k < 3; ++k) p[k] = middle_[k] + scale_ * (p[k] - middle_[k]);
  return points;
}

MovingSurface::State MovingSurface::state() const {
  if (!fairing_) return {{}, scale_};
  return {fairing_->state(), scale_};
}

void MovingSurface::restore(State state) {
  if (fairing_) fairing_->restore(std::move(state.fairing));
  scale_ = state.scale;
}

}  // namespace pelage
