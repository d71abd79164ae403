#include "catalog/size.h"

namespace pelage {

double world_length(const Length& length, double diagonal) {
  return length.relative ? length.value * diagonal : length.value;
}

void require_one_size(const Stage& stage) {
  if (stage.size && stage.unit)
    throw Error(Fault::usage, "a stage has either a size or a unit, since one follows from the other",
                stage.unit->where);
}

StageSize stage_size(const Stage& stage, double model_wavelength, double diagonal) {
  if (stage.unit) {
    const double unit = world_length(stage.unit->value, diagonal);
    return {unit * model_wavelength, unit};
  }
  const double size = world_length(stage.size ? stage.size->value : Length{default_size, true}, diagonal);
  return {size, size / model_wavelength};
}

}  // namespace pelage
