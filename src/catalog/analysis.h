#pragma once
// Everything that linear theory says about a model, in one value.

#include "pelage/analyse.h"
#include "react/model.h"

namespace pelage {

Analysis analysis_of(const Model& model);

}  // namespace pelage
