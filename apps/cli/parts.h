#pragma once
// Commands of many coats, which go on where they were cut off.

#include <optional>
#include <string>
#include <vector>

#include "io/journal.h"
#include "pelage/recipe.h"

namespace pelage {

/// The record of the command when all images of these recipes are read, however many of them its threads have read by
/// now. Errors of read_images().
std::string record_with_images(const std::vector<const Recipe*>& recipes);

/// "; 5 of 12 tiles are kept in FILE, and the same command goes on from there", or nothing where none is.
std::string where_to_go_on(const Journal& journal, std::size_t all, const std::string& what);

/// Keeps a picture that was written, with a text about it.
void keep_picture(Journal& journal, const std::string& part, const std::string& path, const std::string& text);
/// That text, where a command that was cut off has kept the picture and it is as that has left it.
std::optional<std::string> kept_picture(const Journal& journal, const std::string& part, const std::string& path);

/// The path of index.html in a folder, which is made if need be, as an output of the command. Error(Fault::output).
std::string page_in(const std::string& folder);

}  // namespace pelage
