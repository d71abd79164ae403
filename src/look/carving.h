#pragma once
// Volumes as they are shown: with parts cut away by planes, or as the solid in which a species is high or low.

#include <optional>
#include <string>
#include <vector>

#include "look/dress.h"
#include "pelage/up_axis.h"
#include "react/place_formula.h"
#include "shape/tet_cut.h"

namespace pelage {

/// A part of space that is cut away.
class SpaceCut {
 public:
  /// "x < 0", "x + 2*y >= z", "x > 0 and y > 0": where that holds. "x = 0": the side of it that pictures look from.
  /// Formulas of coordinates; those that are linear cut in planes, others as finely as the cells of the volume.
  /// Error(Fault::usage) for what is none.
  SpaceCut(const std::string& text, UpAxis up);
  /// One for each condition.
  std::vector<Cut> at(const std::vector<Point>& nodes) const;

 private:
  std::vector<PlaceFormula> kept_;  ///< above 0 where it is kept
};

/// The part of a volume in which a species is above or below a level.
struct LevelPart {
  std::string species;
  std::optional<double> level;  ///< default: halfway between the lowest and the highest value
  bool above = true;
};

/// "u", "u=0.3" (above it), "u>0.3", "u<0.3". Error(Fault::usage) for another text.
LevelPart parse_level_part(const std::string& text);

struct Carving {
  std::vector<SpaceCut> cuts;
  std::optional<LevelPart> part;

  bool empty() const { return cuts.empty() && !part; }
};

/// Whether anything is left of a volume (tetrahedra or a block) with these nodes. Error(Fault::usage) for too many
/// cuts.
bool leaves_something(const NodeShape& volume, const std::vector<Point>& nodes, const std::vector<SpaceCut>& cuts);

/// Gives a part its level: the middle of what the species has, also where the one that was asked for lies outside; no
/// part where it is the same everywhere. Says so, or returns an empty text. Error(Fault::usage) for an unknown species.
std::string fit_level(Carving& carving, const CoatFields& fields);

/// The surface of a coat in a volume, flat, coloured as the volume is, with the attributes of dress() and "normal" at
/// corners, sharp at edges. Of a volume that fills a surface this surface, as tessellate() gives it; with a carving,
/// and of other volumes, the closed surface of what that leaves, split until the colours are smooth. A part has its
/// level. Error(Fault::usage) where nothing is left, and those of dress().
TriangleMesh dress_body(const CoatFields& fields, const Look& look, const Carving& carving);

}  // namespace pelage
