#include "client/render/scene/draw_option.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "shared/base/check.h"
#include "shared/base/listed.h"

namespace scree {

std::string text_of(const DrawOption& option, int value) {
  return option.is_number() ? std::to_string(value) : std::string(option.names[index_of(option, value)]);
}

std::optional<int> value_of(const DrawOption& option, std::string_view text) {
  for (const int value : option.values)
    if (text_of(option, value) == text) return value;
  return std::nullopt;
}

size_t index_of(const DrawOption& option, int value) {
  const auto found = std::ranges::find(option.values, value);
  CHECK(found != option.values.end());
  return static_cast<size_t>(found - option.values.begin());
}

std::string describe_values(const DrawOption& option) {
  std::vector<std::string> texts;
  for (const int value : option.values) texts.push_back(text_of(option, value));
  return listed(std::vector<std::string_view>(texts.begin(), texts.end()));
}

std::string key_of(const DrawOption& option) {
  std::string key(option.name);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::string variable_of(const DrawOption& option) {
  std::string variable = "SCREE_" + key_of(option);
  std::transform(variable.begin(), variable.end(), variable.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return variable;
}

int DrawOptionValues::of(const DrawOption& option) const {
  const auto found = unusual_.find(option.name);
  return found == unusual_.end() ? option.usual : found->second;
}

void DrawOptionValues::set(const DrawOption& option, int value) {
  CHECK(std::ranges::find(option.values, value) != option.values.end());
  if (value == option.usual)
    unusual_.erase(option.name);
  else
    unusual_.insert_or_assign(option.name, value);
}

}  // namespace scree
