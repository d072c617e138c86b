// An option of the server as it stands, and where it comes from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"

namespace scree {

/// In the order in which the later override the earlier.
enum class OptionSource : uint8_t { standard, preset, environment, file, flag };

struct OptionSourceRow {
  std::string_view name;
};

constexpr OptionSourceRow row_of(OptionSource source) {
  switch (source) {
    case OptionSource::standard:
      return {.name = "default"};
    case OptionSource::preset:
      return {.name = "preset"};
    case OptionSource::environment:
      return {.name = "environment"};
    case OptionSource::file:
      return {.name = "file"};
    case OptionSource::flag:
      return {.name = "flag"};
  }
  return {};
}

struct OptionValue {
  std::string name;                 ///< without dashes
  std::vector<std::string> values;  ///< empty: none
  OptionSource source = OptionSource::standard;
  bool is_list = false;
  bool is_secret = false;  ///< never printed

  /// "a,b"; of a secret nothing.
  std::string text() const;
};

}  // namespace scree
