// The table of settings: names, values and help of the members of WorldConfig that may change while a server
// runs. The server's flags, its configuration file, the environment, requests to change settings, recordings
// and reports all use it. To add a setting, add a member and a row in settings.cpp. The member is a choice
// between methods (methods.h), a number of the simulation (world_config.h, with its bounds in limits.h) or a
// limit of clients (service_limits.h). Where something else keeps the value, change_settings()
// (settings_change.h) hands it on. The tests of determinism take each value in turn.
#pragma once

#include <span>
#include <string_view>

#include "server/world/world_config.h"
#include "shared/base/result.h"
#include "shared/base/setting_value.h"

namespace scree {

/// Least and greatest value of a number.
struct NumberBounds {
  double min = 0.0;
  double max = 0.0;
  std::string_view unit{};
  bool whole = true;  ///< no fractions
};

/// A value that is neither a choice nor a number.
struct TextForm {
  std::string_view may_be{};  ///< the possible values, in words; empty: it is no text
  Result<void> (*parse)(WorldConfig& config, std::string_view text) = nullptr;
  std::string (*print)(const WorldConfig& config) = nullptr;
};

/// The name of WorldConfig::spawn, of which readers of settings alone make use.
inline constexpr std::string_view spawn_setting = "spawn";
/// As its value in an administrator's request: the place of a person's eye, which the network side writes in
/// its place. With a space and a session's number: of that one.
inline constexpr std::string_view spawn_here = "here";

/// The names of ServiceLimits::persons and sight, likewise.
inline constexpr std::string_view persons_setting = "persons";
inline constexpr std::string_view sight_setting = "sight";

/// A choice of several values by name, a number within bounds, or a text.
struct Setting {
  std::string_view name;                      ///< the flag's name without dashes; the same everywhere
  std::string_view help;                      ///< the effect, for --help
  std::span<const std::string_view> choices;  ///< all values of a choice; else empty
  NumberBounds bounds;                        ///< of a number
  /// Values that the tests of determinism try: all of a choice; of a number a few that have an effect in a
  /// short session, none where the simulation does not read it.
  std::span<const std::string_view> tried;
  double (*get)(const WorldConfig& config);  ///< the number, or the index in `choices`
  void (*put)(WorldConfig& config, double value);
  TextForm text{};  ///< of a text; then `bounds`, `get` and `put` mean nothing
  /// A limit of the machine that a server runs on, not a part of the world: where a server is told it at its
  /// start, that wins over what a kept world has saved.
  bool of_machine = false;

  bool is_text() const { return text.parse != nullptr; }
  /// The possible values in words: "field, mesh or rays"; "1 to 20000 pieces, whole".
  std::string may_be() const;
  /// Sets the value. The error lists the possible values; the config is then unchanged.
  Result<void> parse(std::string_view value, WorldConfig& config) const;
  std::string print(const WorldConfig& config) const;
};

std::span<const Setting> settings();

/// Changes one setting; the error names it and lists its values. Does not compare it with the others:
/// check_together() does.
Result<void> set(WorldConfig& config, const SettingValue& setting);
/// Changes all settings or none. An error: a name is unknown or comes twice, a value is unknown, or
/// check_together() refuses.
Result<void> set_all(WorldConfig& config, const SettingValues& values);
/// Refuses a setting without another that it needs.
Result<void> check_together(const WorldConfig& config);
/// Every setting, in the table's order, and then those of changed materials (material_settings.h).
SettingValues print(const WorldConfig& config);
/// Those of `values` that the configuration does not have so.
SettingValues differing(const SettingValues& values, const WorldConfig& config);

}  // namespace scree
