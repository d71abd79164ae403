#pragma once
// One step of each way to fair a mesh.

#include <memory>

#include "pelage/fair.h"
#include "shape/topology.h"

namespace pelage {

/// A mesh on its way.
struct FairState {
  const Topology& topology;
  std::vector<Point> points;
  std::vector<char> fixed;  ///< per vertex: stays where it is
};

class FairMethod {
 public:
  virtual ~FairMethod() = default;
  /// Moves the points; may note what it chose.
  virtual void step(FairState& state, FairReport& report) = 0;
  /// Steps after which more do not help, when nobody says how many.
  virtual int most_steps() const = 0;
};

std::unique_ptr<FairMethod> make_guided_method(const FairState& state);
std::unique_ptr<FairMethod> make_paper_method(const FairState& state, const FairOptions& options, FairReport& report);
std::unique_ptr<FairMethod> make_isotropic_method(const FairOptions& options, FairReport& report);
std::unique_ptr<FairMethod> make_taubin_method();

}  // namespace pelage
