#include "server/app/world_facts.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "content/builtin_palette.h"
#include "content/files/palette_file.h"
#include "server/app/ground_giver.h"
#include "server/world/settings.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

std::string hash_text(uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string palette_facts(const Palette* palette) {
  const Palette& own = palette != nullptr ? *palette : builtin_palette();
  const Json json{{"palette", own == builtin_palette() ? "built-in" : "of a file"},
                  {"digest", hex_of(palette_digest(own))},
                  {"rows", own.rows.size()},
                  {"names", own.names()}};
  return json.dump();
}

std::string ledger_json(const MaterialLedger& ledger, const Palette& palette) {
  Json json = Json::object();
  for (size_t i = 0; i < ledger.rows().size(); ++i) {
    const MaterialLedger::Row& row = ledger.rows()[i];
    if (row == MaterialLedger::Row{}) continue;
    json[i < palette.rows.size() ? palette.rows[i].name : std::to_string(i)] = {{"terrain", row.terrain},
                                                                                {"pieces", row.pieces},
                                                                                {"dust", row.dust},
                                                                                {"poured", row.poured},
                                                                                {"converted", row.converted}};
    if (row.stored != 0)
      json[i < palette.rows.size() ? palette.rows[i].name : std::to_string(i)]["stored"] = row.stored;
  }
  return json.dump();
}

std::string world_facts(const std::string& path, const WorldRows& rows, const ChunkSums& sums) {
  const WorldMoment& moment = rows.world.moment;
  Json settings = Json::object();
  for (const SettingValue& setting : moment.config.settings) settings[setting.name] = setting.value;
  settings[spawn_setting] = moment.config.spawn ? text_of(*moment.config.spawn) : "auto";
  const Palette& palette = moment.config.palette ? *moment.config.palette : builtin_palette();
  size_t waiting = 0;
  for (const PartyValue& party : moment.requests.parties)
    for (const SessionValue& session : party.sessions) waiting += session.requests.size();
  std::error_code ignored;
  const Json json{{"file", path},
                  {"format", sums.format},
                  {"made_by", rows.header.config.program},
                  {"terrain", terrain_text(moment.config.ground, moment.config.terrain)},
                  {"seed", moment.config.terrain.random_seed},
                  {"voxel_size_m", moment.config.terrain.voxel_size_m},
                  {"tick_rate_hz", moment.config.tick_rate_hz},
                  {"materials", Json::parse(palette_facts(moment.config.palette.get()))},
                  {"settings", std::move(settings)},
                  {"tick", moment.tick},
                  {"seconds", static_cast<double>(moment.tick) / moment.config.tick_rate_hz},
                  {"chunks_edited", sums.chunks},
                  {"bricks_edited", sums.bricks},
                  {"pieces_alive", moment.pieces.size()},
                  {"props", moment.props.size()},
                  {"requests_waiting", waiting},
                  {"ledger_error", moment.ledger.error()},
                  {"ledger_by_material", Json::parse(ledger_json(moment.materials, palette))},
                  {"field_hash", hash_text(moment.field_hash)},
                  {"state_hash", hash_text(moment.state_hash)},
                  {"bytes_of_rows", rows.bytes + sums.bytes},
                  {"bytes", std::filesystem::file_size(path, ignored)}};
  return json.dump();
}

}  // namespace scree
