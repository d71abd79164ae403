#include "fair/flow.h"
#include "fair/normal_filter.h"
#include "fair/vertex_update.h"

namespace pelage {

namespace {

/// Normals are filtered, then the vertices follow them.
class Guided final : public FairMethod {
 public:
  explicit Guided(const FairState& state)
      : faces_of_vertex_(faces_of_vertices(state.topology)),
        filter_(state.topology, state.points),
        unfolding_(state.topology, state.points) {}

  void step(FairState& s, FairReport& report) override {
    const std::vector<Vector3> normal = filter_.filter(face_geometry(s.topology.triangles, s.points));
    follow_normals(s.topology, faces_of_vertex_, normal, s.fixed, vertex_rounds, s.points);
    report.folded = unfolding_.apply(faces_of_vertex_, normal, s.fixed, unfold_rounds, s.points);
    report.range = filter_.range();
  }

  /// Flat parts go on improving slowly; from here on it is hardly worth the time.
  int most_steps() const override { return 40; }

 private:
  static constexpr int vertex_rounds = 10, unfold_rounds = 5;  // the first as Zhang et al. 2015
  FaceLists faces_of_vertex_;
  NormalFilter filter_;
  Unfolding unfolding_;
};

}  // namespace

std::unique_ptr<FairMethod> make_guided_method(const FairState& state) { return std::make_unique<Guided>(state); }

}  // namespace pelage
