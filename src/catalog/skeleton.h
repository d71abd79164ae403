#pragma once
// The beginning of a model file.

#include <string>

namespace pelage {

/// A model that grows spots, with every key that a model file may have, those that it does not need as comments "# key
/// = value". Error(Fault::usage) for a name that is not made of letters, digits, - and _.
std::string model_skeleton(const std::string& name);

}  // namespace pelage
