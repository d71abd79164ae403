#pragma once
// Fairing: noise is taken off a mesh while its shape and its edges stay.
//
//   pelage::TriangleMesh smooth = pelage::fair(pelage::load_shape("scan.ply")).mesh;
//
// All errors are pelage::Error, see error.h.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pelage/progress.h"
#include "pelage/triangle_mesh.h"

namespace pelage {

/// What is not given is chosen from the noise of the mesh; see FairReport for what was chosen.
struct FairOptions {
  std::string method = "guided";     ///< see fair_methods()
  std::optional<double> noise = {};  ///< standard deviation along the normals, in mean edges; default: estimated
  std::optional<int> steps = {};     ///< exactly so many; default: until as much has moved as the noise amounts to
  std::optional<double> tau = {};    ///< isotropic, paper: time of a step, in squared mean edges
  std::optional<double> sigma = {};  ///< paper: width of a Gaussian before curvatures are taken, in mean edges;
                                     ///< default: a bilateral filter
  std::optional<double> angle = {};  ///< paper: bend per edge beyond which diffusion across is throttled, degrees;
                                     ///< default: the median, 5 or more
  std::string motion = "normal";     ///< paper: "normal", or "full" as printed: in all directions, which folds corners
  double mu = 0;                     ///< paper: 0 adapts the tensor to the local size of triangles, 1 the time step
  bool slide = false;                ///< vertices on boundaries move along these, but for corners; else they stay
};

struct FairReport {
  double noise = 0;      ///< that was assumed, in mean edges; an estimate is refined at every step
  double mean_edge = 0;  ///< of the input, world units
  int steps = 0;
  double moved = 0;                            ///< root mean square along the normals, in mean edges
  double volume_before = 0, volume_after = 0;  ///< of the closed parts, world units^3
  double tau = 0, sigma = 0, angle = 0;        ///< that were used last, 0 where the method has none
  double range = 0;                            ///< guided: of normals in the last step, |n - n'|
  std::size_t kept = 0;                        ///< guided: vertices without noise that stayed, where some only have it
  std::size_t folded = 0;                      ///< triangles that still lean away from their smoothed normal
};

struct Faired {
  TriangleMesh mesh;  ///< the same triangles and attributes; an attribute "normal" is made anew
  FairReport report;
};

/// Methods: "guided" (edges and details stay; the default), "paper" (anisotropic diffusion, eqs (18)-(21) of Bajaj,
/// Zhang, Xu 2008, on the Loop limit surface), "isotropic" (implicit, Desbrun et al. 1999), "taubin" (lambda-mu, Taubin
/// 1995).
const std::vector<std::string>& fair_methods();

/// Vertices on boundaries stay where they are, or slide; closed parts keep their volume. Error(Fault::usage) for an
/// unknown method or options out of range; Error(Fault::input) for meshes that are not manifold;
/// Error(Fault::cancelled).
Faired fair(const TriangleMesh& mesh, const FairOptions& options = {}, const Progress& progress = {});

/// The same step by step, for a run that does something else in between.
class Fairing {
 public:
  /// Looks at the noise and chooses; nothing moves. Errors as fair().
  explicit Fairing(const TriangleMesh& mesh, const FairOptions& options = {});
  ~Fairing();
  Fairing(Fairing&&) noexcept;
  Fairing& operator=(Fairing&&) noexcept;

  bool done() const;
  /// One step of the method.
  void step();
  /// The vertices as they are now, their closed parts with the volume that they had; world units.
  std::vector<Point> points() const;
  const FairReport& report() const { return report_; }
  /// Steps after which it ends in any case.
  int most_steps() const { return most_steps_; }

  /// All that changes, to go on from later.
  struct State {
    std::vector<Point> points;  ///< between two steps: the volume of closed parts is not restored
    int steps = 0;
    bool done = false;
    std::size_t kept = 0;  ///< as in the report
  };
  State state() const;
  /// Goes on from there, with the same mesh and options. Error(Fault::usage) unless there are as many points as the
  /// mesh has vertices.
  void restore(State state);

 private:
  struct Parts;
  void measure();
  void measure_way();
  bool settle_where_some_are_noisy();
  bool noise_is_off(double correlation_before) const;

  FairOptions options_;
  FairReport report_;
  double roughness_ = 0;  ///< of the input, in mean edges: its noise, and those details of the shape that look like it
  double correlation_ = 0;  ///< of the ways of neighbours so far, see fair/whiteness.h
  int most_steps_ = 0;
  bool finished_ = false;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pelage
