#include "catalog/size.h"

#include "catalog/resolve.h"
#include "react/wavelength.h"

namespace pelage {

double world_length(const Length& length, double diagonal) {
  return length.relative ? length.value * diagonal : length.value;
}

StageSize stage_size(const Stage& stage, const Model& plain, double diagonal) {
  if (stage.size && stage.unit)
    throw Error(Fault::usage, "a stage has either a size or a unit, since one follows from the other",
                stage.unit->where);
  const double wavelength = model_wavelength(plain);
  if (stage.unit) {
    const double unit = world_length(stage.unit->value, diagonal);
    return {unit * wavelength, unit};
  }
  const double size = world_length(stage.size ? stage.size->value : Length{default_size, true}, diagonal);
  return {size, size / wavelength};
}

}  // namespace pelage
