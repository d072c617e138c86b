#include "shared/base/near_name.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace scree {

namespace {

/// Levenshtein's distance: how many letters are to be put in, left out or changed.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, changed});
    }
  }
  return row[b.size()];
}

/// One letter in three may be wrong: short names are near to each other.
std::string hint_for(std::string_view name, std::span<const std::string> known) {
  return did_you_mean(name, known, std::clamp<size_t>(name.size() / 3, 1, 4));
}

}  // namespace

std::string did_you_mean(std::string_view name, std::span<const std::string> known, size_t mistyped_max) {
  const auto near =
      std::ranges::min_element(known, {}, [&](const std::string& other) { return distance(name, other); });
  return near != known.end() && distance(name, *near) <= mistyped_max ? "; did you mean " + *near + "?"
                                                                      : std::string();
}

std::string words_of_unknown(std::span<const std::string> words, std::span<const std::string> options,
                             std::span<const std::string> commands) {
  const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
  if (const auto option = std::ranges::find_if(words, is_option); option != words.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "there is no option " + name + hint_for(name, options);
  }
  if (words.empty()) return "there is a word too many";
  if (commands.empty()) return "'" + words.front() + "' is not expected";
  return "there is no command '" + words.front() + "'" + hint_for(words.front(), commands);
}

}  // namespace scree
