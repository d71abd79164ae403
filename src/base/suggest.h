#pragma once
// Suggestions for names that were probably misspelt.

#include <string>
#include <string_view>
#include <vector>

namespace pelage {

/// Number of single-character insertions, deletions, replacements and swaps of neighbours that turn one
/// word into the other, upper and lower case being equal (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// `did you mean "turing"?` for the known name nearest to `word` (the first of several equally near ones),
/// or "" when no name is near enough to be a likely slip of the fingers.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// The known name that equals `word`, or else the only one that differs from it in upper and lower case alone; nullptr
/// if there is none.
const std::string* matching_name(std::string_view word, const std::vector<std::string>& known);

/// "a, b, c": for messages that list the known names.
std::string join_names(const std::vector<std::string>& names);

/// unknown KIND "word"; did you mean "..."? Known: a, b, c
std::string unknown_name(const std::string& kind, const std::string& word, const std::vector<std::string>& known);

}  // namespace pelage
