#pragma once
// Finding the record of what made a file (io/record.h) in the file.

#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Extensions of the formats that carry one.
std::vector<std::string> record_extensions();

/// The text of the record that a file of this extension carries, as the writers put it there; empty where there is
/// none.
std::string record_in_file(std::string_view bytes, const std::string& extension);

}  // namespace pelage
