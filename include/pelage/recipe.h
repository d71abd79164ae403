#pragma once
// A recipe is data only: what to grow, how large, how to colour it. Names become components in resolve().

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelage/channel.h"
#include "pelage/error.h"
#include "pelage/point.h"

namespace pelage {

/// A name or number with the place where the user gave it.
template <class T>
struct Given {
  T value{};
  Location where;
};

struct Length {
  enum class Unit {
    diagonals,  ///< of the shape's bounding box; at most 1
    world,
    metres,  ///< which need a shape whose unit is known (TriangleMesh::metres_per_unit)
    cells    ///< of a grid
  };
  double value = 0;
  Unit unit = Unit::diagonals;
};

/// "0.04" is a fraction of the diagonal; "4mm", "2cm", "0.1m", "3in", "1ft" are metres; "1.5u" is in units of the
/// shape; "24px" is in cells of a grid. Error(Fault::usage) otherwise.
Length parse_length(const std::string& text, const Location& where);

/// What the directions of anisotropic diffusion follow: at least one of these.
struct Directions {
  std::optional<Point> axis;                     ///< the projection of this vector
  std::optional<Point> centre;                   ///< away from this place, in the bounding box (-1 to 1 each)
  bool curvature = false;                        ///< the larger principal curvature
  std::optional<Given<std::string>> from, to;    ///< formulas: the gradient of the harmonic function between the
                                                 ///< vertices where the one and those where the other is not 0
  std::vector<std::vector<Point>> strokes = {};  ///< polylines near the surface, world units
  bool across = false;                           ///< the others, strokes excepted, turned by a right angle
  Location where;
};

/// An image whose values formulas read through the uv of the shape: attribute(NAME) is its luminance,
/// attribute(NAME_1), _2 and _3 its red, green and blue, all from 0 to 1 as they are stored.
struct TextureFile {
  Given<std::string> name;
  std::string path;  ///< PNG or JPEG; recipes give it relative to their own file
};

/// An attribute that is painted: formulas read attribute(NAME), 0 where nothing is. Strokes come one over the other.
struct Brush {
  struct Stroke {
    std::vector<Point> points;  ///< a polyline near the surface, or a single dab [world units]
    Given<Length> radius;
    double value = 1;       ///< towards which the brush moves the attribute
    double hardness = 0.5;  ///< the share of the radius that gets all of the value; beyond it fades; 0 to 1
  };
  Given<std::string> name;
  std::vector<Stroke> strokes;
};

/// One run of a model to its stop. Formulas know the place (x, nx, k1, attribute(NAME), ...), the parameters of the
/// model, the fields of earlier stages as STAGE.SPECIES, and `points` where it is set. docs/recipes.md.
struct Stage {
  Given<std::string> name{"stage1", {}};  ///< as later stages and the look refer to it; default: stage1, stage2, ...
  Given<std::string> model{"turing",
                           {}};  ///< built-in name, "name:variant", path of a .toml file, or of Recipe::models
  struct Setting {
    std::string name;
    double value = 0;
    Location where;
    std::string formula = {};  ///< instead of the value, for a parameter that differs from place to place
  };
  std::vector<Setting> parameters;  ///< of the model, instead of its defaults
  struct SpeciesFormula {
    std::string species;
    Given<std::string> formula;
  };
  std::optional<Given<std::string>> from;   ///< start from the species of an earlier stage that have the same names
  std::vector<SpeciesFormula> initial;      ///< initial concentrations instead of the model's or the earlier stage's
  std::optional<Given<std::string>> mask;   ///< formula: inside where it is not 0
  Given<std::string> inside{"frozen", {}};  ///< "frozen": concentrations stay what they are, and diffuse outward;
                                            ///< "excluded": nothing reacts or diffuses inside, nor through the border
  std::vector<SpeciesFormula> pin;          ///< concentrations to which the inside of the mask is set at the start
  /// What holds for a species at a side of a grid instead of no flux: a value, or n . D grad u = flux - loss u with the
  /// normal n outwards; formulas of the place and the time t, in the units of the model.
  struct Border {
    Given<std::string> side;  ///< "xmin", "xmax", "ymin", ...: the ends of the first, second and third axis
    Given<std::string> species;
    std::optional<Given<std::string>> value, flux, loss;
  };
  std::vector<Border> boundary;
  std::optional<Directions> directions;  ///< default: the shape's attribute "direction", or its smoothest field
  std::optional<Given<Length>> points;   ///< spacing of random points; the formula `points` is the distance to the
                                         ///< nearest in spacings
  std::optional<Given<double>> jitter;   ///< 0 to 1: on flat grids these points are a grid of diamonds, each moved by
                                         ///< up to half of so many spacings along both axes
  std::optional<Given<Length>> size;     ///< wanted wavelength of the pattern; default: 4 % of the diagonal
  std::optional<Given<Length>> unit;     ///< instead of it: the length of the model's own length unit
  std::optional<Given<std::string>> size_map;  ///< formula of the place: factor on the size
  Given<std::string> method{"remeshed", {}};   ///< discretisation
  std::optional<Given<std::int64_t>> cells;    ///< how many the method "cells" scatters; default: as the size needs
  Given<std::string> stepper{"", {}};          ///< empty: the first that suits the method and the model
  Given<std::string> solver{"", {}};           ///< of its linear systems: "jacobi-cg" (the default), "cg", "red-black"
                                               ///< or "sor"; empty: any
  std::optional<Given<std::int64_t>> refresh;  ///< its matrices are made anew every so many steps ("semi-implicit");
                                               ///< default: every one
  std::optional<double> step;         ///< fixed step [model time]; default: adaptive, or the stepper's safe step
  std::optional<double> until;        ///< stop at this model time; default: the model's suggestion
  std::optional<std::int64_t> steps;  ///< stop after so many steps
  std::optional<double>
      stationary;  ///< stop when the pattern changes by less than this fraction per unit of time; 0: never
  std::uint64_t seed = 1;
  bool interpolate = false;             ///< the limit surface passes through the vertices of the shape
  std::optional<Given<double>> crease;  ///< [degrees] edges where the shape bends by more than this stay sharp
};

/// How the surface moves while the pattern grows on it. By default it does not.
struct Motion {
  std::optional<Given<std::string>> fair;  ///< the shape is faired by this method; see fair_methods()
  double growth = 0;                       ///< rate at which all lengths grow [1 / model time], exponentially
  Given<std::string> mode{"texture", {}};  ///< "texture": values ride along; "physical": amounts do, so that values
                                           ///< are diluted where the area grows
  std::int64_t every = 10;                 ///< the surface and its matrices are renewed every so many time steps
};

/// A coat of paint over those below it. Formulas know what those of stages know, and the species of the last stage by
/// their own names.
struct Layer {
  std::optional<Given<std::string>> color;  ///< "#rrggbb"; or
  std::optional<Given<std::string>> ramp;   ///< the colours of a ramp, at a value
  Given<std::string> value;                 ///< formula; on the ramp from low to high
  double low = 0, high = 1;
  std::optional<Given<std::string>> opacity;  ///< formula, 0..1; default 1
};

/// Every level of detail makes four times as many triangles: beyond this no mesh fits into memory.
inline constexpr int most_detail = 10;

/// How fields become colours and geometry.
struct Look {
  std::optional<Given<std::string>> species;       ///< which one is shown; default: the last
  Given<std::string> ramp;                         ///< "": the way in which the model shows itself, else tawny
  bool invert = false;                             ///< exchange the ends of the ramp
  std::vector<Layer> layers;                       ///< painted over it, the first one lowest
  std::map<Channel, Given<std::string>> channels;  ///< formulas that know what those of layers know; lengths in sizes
                                                   ///< of the finest pattern
  bool keep_shape = false;    ///< the input as it is: its own vertices and flat triangles, never split
  bool flat = false;          ///< the input's flat triangles instead of the limit surface, split as the detail says
  bool displace = false;      ///< heights move the vertices, instead of being noted beside them
  bool fields = true;         ///< the coat carries the species as attributes, beside its colours
  std::optional<int> detail;  ///< extra splits of every triangle into four, 0 to most_detail; default: as needed
};

/// A model of your own as TOML text (docs/models.md); `file` is the name for messages, without one that of the model.
struct ModelText {
  std::string text;
  std::string file = {};
};

/// By the name that stages give it, "name:variant" for a variant of it. A name hides the built-in model called so.
using ModelTexts = std::map<std::string, ModelText>;

struct Recipe {
  std::string name;
  std::string summary;
  std::string shape;                         ///< used when the command names none
  Given<std::string> quality{"normal", {}};  ///< "draft", "normal" or "fine"
  std::vector<TextureFile> textures;
  std::vector<Brush> brushes;
  ModelTexts models;             ///< beside the built-in ones and files
  std::vector<Stage> stages{1};  ///< at least one
  Motion motion;
  Look look;
};

/// Reads a recipe from TOML text; `file` is the name for messages. Error(Fault::usage) with file and line for anything
/// unknown or misspelt.
Recipe parse_recipe(const std::string& text, const std::string& file);

}  // namespace pelage
