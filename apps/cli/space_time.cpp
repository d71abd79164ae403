#include "space_time.h"

#include <algorithm>

#include "look/grid_picture.h"

namespace pelage {

void SpaceTime::add(const Run& run) {
  if (run.stage() != stage_) {  // the plot is that of the last one
    stage_ = run.stage();
    moments_.clear();
  }
  Moment moment{run.summary().time, {}};
  for (const Vector& u : run.coefficients()) moment.fields.emplace_back(u.begin(), u.end());
  moments_.push_back(std::move(moment));
}

const SpaceTime::Moment& SpaceTime::nearest(double time) const {
  const auto next = std::ranges::lower_bound(moments_, time, {}, &Moment::time);
  if (next == moments_.begin()) return *next;
  if (next == moments_.end() || time - (next - 1)->time < next->time - time) return *(next - 1);
  return *next;
}

Image SpaceTime::picture(const Run& run, const Look& look, int rows) const {
  const CoatFields fields = run.fields();
  const std::size_t earlier = fields.species.size() - run.coefficients().size();
  const std::vector<Point> line = run.space().geometry(SampleRule::vertices, false).position;
  CoatSamples samples;
  samples.fields.resize(fields.species.size());
  samples.length_unit = fields.length_unit;
  samples.origin = fields.origin;
  samples.period = fields.period;
  samples.seed = fields.seed;
  const double first = moments_.front().time, last = moments_.back().time;
  for (int row = 0; row < rows; ++row) {
    const Moment& moment = nearest(first + (last - first) * row / std::max(1, rows - 1));
    for (std::size_t i = 0; i < samples.fields.size(); ++i) {
      const auto& of_row = i < earlier ? fields.coefficients[i] : moment.fields[i - earlier];
      samples.fields[i].insert(samples.fields[i].end(), of_row.begin(), of_row.end());
    }
    samples.position.insert(samples.position.end(), line.begin(), line.end());
    samples.normal.insert(samples.normal.end(), line.size(), Point{0, 0, 1});
  }
  const std::vector<double> colors =
      paint(samples, make_palette(resolve_paint(look, fields.species), samples, fields.uniform));
  std::vector<std::vector<double>> by_row;
  for (std::size_t k = 0; k < colors.size(); k += 3 * line.size())
    by_row.emplace_back(colors.begin() + static_cast<std::ptrdiff_t>(k),
                        colors.begin() + static_cast<std::ptrdiff_t>(k + 3 * line.size()));
  return space_time_image(by_row);
}

}  // namespace pelage
