#include "base/suggest.h"

#include <algorithm>

#include "base/ascii.h"

namespace pelage {

namespace {

bool same(char a, char b) { return to_lower(a) == to_lower(b); }

bool starts_with(std::string_view word, std::string_view start) {
  return word.size() >= start.size() && std::equal(start.begin(), start.end(), word.begin(), same);
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the dynamic programme: distances of the prefixes of `a` of length i-2, i-1 and i.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  // One slip in three characters: "tring" finds "turing", "xyz" finds nothing.
  int best = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& name : known) {
    // An abbreviation of two characters or more counts as one slip.
    const int distance = word.size() >= 2 && starts_with(name, word) ? 1 : edit_distance(word, name);
    if (distance < best && distance < static_cast<int>(name.size())) {
      best = distance;
      nearest = &name;
    }
  }
  return nearest ? "did you mean \"" + *nearest + "\"?" : "";
}

const std::string* matching_name(std::string_view word, const std::vector<std::string>& known) {
  const std::string* match = nullptr;
  int matches = 0;
  for (const std::string& name : known) {
    if (name == word) return &name;
    if (name.size() != word.size() || edit_distance(name, word) > 0) continue;
    match = &name;
    ++matches;
  }
  return matches == 1 ? match : nullptr;
}

std::string join_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string unknown_name(const std::string& kind, const std::string& word, const std::vector<std::string>& known) {
  const std::string hint = did_you_mean(word, known);
  return "unknown " + kind + " \"" + word + "\"; " + (hint.empty() ? "" : hint + " ") + "known: " + join_names(known);
}

}  // namespace pelage
