#pragma once
// From the values of fields to colours: what a look says, with its names resolved; the same with its ranges fixed; and
// the one function that paints samples with it.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "look/ramp.h"
#include "look/samples.h"
#include "pelage/channel.h"
#include "pelage/recipe.h"
#include "react/place_formula.h"

namespace pelage {

/// A coat of paint over those below it.
struct PaintLayer {
  Color color{};                        ///< everywhere, unless there is a ramp
  std::optional<RampTable> ramp;        ///< at a value, from low to high
  std::optional<PlaceFormula> value;    ///< of the ramp
  double low = 0, high = 1;             ///< where it begins and ends
  std::optional<PlaceFormula> opacity;  ///< 0..1; default 1
};

/// What is said of a channel.
struct ChannelFormula {
  PlaceFormula value;
  Location where;
};

struct Paint {
  std::vector<std::string> species;  ///< of the fields, "STAGE.SPECIES" those of earlier stages
  std::size_t shown = 0;             ///< the one whose values the ramp shows
  RampTable ramp;
  bool invert = false;
  bool fields = true;              ///< whether the coat carries the species as attributes
  std::vector<PaintLayer> layers;  ///< the first one lowest
  std::map<Channel, ChannelFormula> channels = {};
  bool displace = false;                     ///< heights move the vertices
  std::optional<ChannelFormula> holes = {};  ///< above 0 where there is nothing

  /// What layers and channels read from the place, species and fields included.
  std::vector<Symbol> symbols() const;
};

/// By which layers know an attribute of the shape that is called like a species, and by which files of a coat hold it.
inline std::string input_name(const std::string& name) { return "input_" + name; }

/// A formula that knows the species of the last stage by their own names. Error(Fault::usage), located, for a fault.
PlaceFormula layer_formula(const Given<std::string>& text, const std::vector<std::string>& species);

/// Error(Fault::usage), located, for an unknown species, ramp or colour and for faults in the formulas of layers and
/// channels.
Paint resolve_paint(const Look& look, std::vector<std::string> species);

/// A paint with the ends of its ramp: samples with these values get the ends' colours.
struct Palette {
  Paint paint;
  double low = 0, high = 0;  ///< equal for a field without a pattern, which gets the colour of the ramp's middle
};

/// The lowest and the highest half percent of the samples at the ends. `uniform`: per species, whether there is no
/// pattern to show.
Palette make_palette(Paint paint, const CoatSamples& samples, const std::vector<char>& uniform);

/// Colours of the samples, 3 each, linear light. Error(Fault::usage), located, where they lack what a layer reads.
std::vector<double> paint(const CoatSamples& samples, const Palette& palette);

/// A formula at the samples. Error(Fault::usage), located, where they lack what it reads. `paint`: with what it reads
/// among its symbols.
std::vector<double> formula_values(const PlaceFormula& formula, const CoatSamples& samples, const Paint& paint);

/// What a channel of the paint is at the samples, lengths in world units; beyond its range it is clamped. Error,
/// located, where they lack what the formula reads (Fault::usage) or it is not a number (Fault::numerics).
std::vector<double> channel_values(const CoatSamples& samples, const Paint& paint, Channel channel);

/// How far the samples lie in holes, if the paint has any: above 0 inside. Errors of channel_values.
std::vector<double> hole_values(const CoatSamples& samples, const Paint& paint);

/// A condition as formulas of layers know it, above 0 where it holds. Error(Fault::usage), located, where it is none.
ChannelFormula condition_on_coat(const Given<std::string>& text, const std::vector<std::string>& species);

/// A line for each channel that is out of its range, with the values that it had.
std::vector<std::string> clamped_channels(const CoatSamples& samples, const Paint& paint);

}  // namespace pelage
