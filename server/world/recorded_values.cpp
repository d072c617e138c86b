#include "server/world/recorded_values.h"

#include "content/builtin_palette.h"
#include "server/world/settings.h"
#include "shared/material/rubble.h"

namespace scree {

RecordedHeader to_recorded(const WorldConfig& config) {
  RecordedHeader out;
  out.terrain = config.terrain;
  out.ground = config.ground;
  out.tick_rate_hz = config.tick_rate_hz;
  out.merges_per_tick_max = config.merges_per_tick_max;
  out.settings = print(config);
  // Older programs refuse a header with a setting that they do not know.
  std::erase_if(out.settings, [](const SettingValue& value) {
    return value.name == spawn_setting ||
           value == SettingValue{std::string(persons_setting), std::string(name_of(Persons::fly))} ||
           value == SettingValue{std::string(sight_setting), "false"} ||
           value == SettingValue{std::string(water_setting), text_of_water({})};
  });
  out.spawn = config.spawn;
  out.rules = config.rules;
  out.palette = config.palette;
  return out;
}

Result<WorldConfig> config_of(const RecordedHeader& header) {
  WorldConfig config;
  config.terrain = header.terrain;
  config.ground = header.ground;
  config.tick_rate_hz = header.tick_rate_hz;
  config.merges_per_tick_max = header.merges_per_tick_max;
  config.rules = header.rules;
  config.palette = header.palette != nullptr ? header.palette : shared_builtin_palette();
  if (config.rules >= rules::rubble) config.terrain.rubble = Rubble(rubble_rows(*config.palette));
  TRY(set_all(config, header.settings));
  config.spawn = header.spawn;
  TRY(validate(config));
  return config;
}

}  // namespace scree
