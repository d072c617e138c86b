// Presets: one word for a kind of machine, instead of an option for each choice. One table says their values
// by the names of the options of server and viewer, as text: each option's own parser checks them.
//
// A flag, the environment or a configuration file overrides a preset. A preset overrides the defaults and the
// viewer's choices of earlier runs. It is for the start alone: settings change later as if it had never been.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

enum class Preset : uint8_t { laptop = 0, desktop = 1, dedicated = 2 };

struct PresetTraits {
  std::string_view name;
  std::string_view machine;  ///< for --help
  bool draws = true;         ///< whether it is a preset of viewers as well
};

constexpr PresetTraits row_of(Preset preset) {
  switch (preset) {
    case Preset::laptop:
      return {.name = "laptop", .machine = "a weak laptop, which draws what it simulates"};
    case Preset::desktop:
      return {.name = "desktop", .machine = "a desktop computer with a GPU"};
    case Preset::dedicated:
      return {.name = "dedicated", .machine = "a server without a GPU, which draws nothing", .draws = false};
  }
  return {};
}

constexpr bool is_for_viewers(Preset preset) {
  return is_known(preset) && traits_of(preset).draws;
}
inline constexpr auto viewer_presets = kinds_that<Preset, is_for_viewers>;

/// An option, and its value by each preset, in their order.
struct PresetOption {
  std::string_view name;  ///< without dashes
  std::array<std::string_view, kind_count<Preset>> values;

  constexpr std::string_view of(Preset preset) const { return values[static_cast<size_t>(preset)]; }
};

// Options of the server. None is without another that it needs, so that any one may be said otherwise.
inline constexpr std::array server_preset_options{
    PresetOption{"tick-rate", {"30", "60", "60"}},
    PresetOption{"pieces-max", {"500", "2000", "5000"}},
    PresetOption{"memory-max", {"1024", "4096", "8192"}},
    PresetOption{"work-percent", {"40", "65", "65"}},
    PresetOption{"sessions-max", {"8", "64", "1000"}},
    PresetOption{"sim-threads", {"1", "0", "0"}},
    PresetOption{"net-threads", {"1", "0", "0"}},
    PresetOption{"collider", {"field", "field", "field"}},
    PresetOption{"cutter", {"field", "field", "field"}},
    PresetOption{"simplifier", {"hull", "hull", "hull"}},
    PresetOption{"recombine", {"facets", "facets", "facets"}},
    PresetOption{"group-merges", {"true", "false", "false"}},
    PresetOption{"impacts", {"true", "true", "true"}},
    PresetOption{"dents", {"false", "true", "true"}},
};

// Options of the viewer. A preset that draws nothing has no values for them.
inline constexpr std::array viewer_preset_options{
    PresetOption{"method", {"mesh", "mesh", ""}},
    PresetOption{"quality", {"low", "high", ""}},
    PresetOption{"particles", {"false", "true", ""}},
    PresetOption{"pattern", {"radial", "radial", ""}},
};

/// A line for each preset, for --help: its name, its machine, its values.
std::string describe_presets(std::span<const Preset> presets, std::span<const PresetOption> options);

/// Sets the options of the table that nobody has set, as if somebody had. `App`: a CLI::App that has parsed.
/// Throws as parsing does.
template <typename App>
void apply_preset(App& app, Preset preset, std::span<const PresetOption> options) {
  for (const PresetOption& row : options) {
    auto* option = app.get_option("--" + std::string(row.name));
    if (option->count() > 0) continue;
    option->add_result(std::string(row.of(preset)));
    option->run_callback();
  }
}

}  // namespace scree
