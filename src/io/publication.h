#pragma once
// Several files that take their places together.

#include <string>
#include <vector>

#include "io/temporary_file.h"

namespace pelage {

/// Of the list that stands in the folder of the first file while the files of a set are renamed.
inline constexpr const char* publication_extension = ".pelage-set";

/// Brings all files to the disk, writes down what is going to be renamed, and renames. Where the process is killed on
/// the way, the next run that writes into that folder finishes it (finish_publication). Error(Fault::output) before the
/// first renaming, while all can still be taken back.
void put_all_in_place(std::vector<TemporaryFile> files);

/// Goes on where a killed process stopped; `list` is its list, which goes away. A list whose process is alive is left
/// alone. A list can only do what runs do: give files that end in ".pelage-partial" the names without that.
void finish_publication(const std::string& list);

/// Removes what killed runs have left in a folder, after finishing their publications.
void clear_leftovers(const std::string& folder);

}  // namespace pelage
