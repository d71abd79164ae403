// Shipped models and variants as values of parameterised tests.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "catalog/models.h"

namespace pelage {

inline std::vector<std::string> all_model_names() {
  std::vector<std::string> names;
  for (const ModelEntry& entry : model_list()) names.push_back(entry.name);
  return names;
}

/// GoogleTest allows letters, digits and underscores.
inline std::string model_test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace pelage
