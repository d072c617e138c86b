#include "server/formats/recording_values.h"

#include <algorithm>

#include "proto/content_codec.h"
#include "proto/height_wire.h"
#include "proto/palette_codec.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/text.h"
#include "shared/material/rubble.h"

namespace scree {

std::vector<uint8_t> bytes_of(const google::protobuf::MessageLite& message) {
  std::vector<uint8_t> bytes(message.ByteSizeLong());
  if (bytes.size() > INT32_MAX) return bytes;  // Protobuf writes no more; no row of a file holds as much
  CHECK(message.SerializeToArray(bytes.data(), static_cast<int>(bytes.size())));
  return bytes;
}

void write(recorded::Ledger& to, const Ledger& from) {
  to.set_terrain(from.terrain);
  to.set_pieces(from.pieces);
  to.set_dust(from.dust);
  to.set_poured(from.poured);
  to.set_moved(from.moved);
  to.set_stored(from.stored);
}

Ledger read(const recorded::Ledger& from, FieldChecker& check) {
  return {ledger_mass(from.terrain(), check), ledger_mass(from.pieces(), check),
          ledger_mass(from.dust(), check),    ledger_mass(from.poured(), check),
          ledger_mass(from.moved(), check),   ledger_mass(from.stored(), check)};
}

void write(recorded::MaterialLedger& to, const MaterialLedger& from) {
  to.set_rows(pack_ledger(from));
  to.set_stored(pack_stored(from));
}

MaterialLedger read(const recorded::MaterialLedger& from, FieldChecker& check) {
  return unpack_ledger(from.rows(), from.stored(), check);
}

void write(recorded::Header& to, const RecordedHeader& from) {
  to.set_format(from.format);
  to.set_program(showable(from.program, limits::program_bytes_max));
  to.set_terrain_kind(static_cast<uint32_t>(from.terrain.kind));
  to.set_terrain_seed(from.terrain.random_seed);
  to.set_voxel_size_m(from.terrain.voxel_size_m);
  to.set_tick_rate_hz(from.tick_rate_hz);
  to.set_merges_per_tick_max(from.merges_per_tick_max);
  write(*to.mutable_settings(), from.settings);
  if (from.ground != Digest{}) to.set_ground(std::string(from.ground.begin(), from.ground.end()));
  to.set_merge_burst_ticks(from.merge_burst_ticks);
  to.set_contacts_j(from.contacts_j);
  if (from.spawn) to.set_spawn(text_of(*from.spawn));
  to.set_rules(from.rules);
  if (from.terrain.rows != GroundRows{}) write(*to.mutable_rows(), from.terrain.rows);
  if (from.palette != nullptr) to.set_palette(to_string(encode_palette(*from.palette)));
}

RecordedHeader read(const recorded::Header& from, FieldChecker& check) {
  RecordedHeader header;
  header.format = from.format();
  if (!reads_recording_format(header.format)) return header;
  header.program = check.text(from.program(), limits::program_bytes_max, "program");
  header.terrain.kind = check.kind<TerrainKind>(from.terrain_kind(), "terrain_kind");
  header.terrain.random_seed = from.terrain_seed();
  header.terrain.voxel_size_m = check.finite(from.voxel_size_m(), "voxel_size_m");
  if (header.terrain.voxel_size_m < limits::voxel_size_min_m ||
      header.terrain.voxel_size_m > limits::voxel_size_max_m)
    check.refuse("voxel_size_m is not within the limits (limits.voxel_size_min_m, voxel_size_max_m)");
  header.tick_rate_hz =
      check.within(from.tick_rate_hz(), limits::tick_rate_min_hz, limits::tick_rate_max_hz, "tick_rate_hz");
  header.merges_per_tick_max = from.merges_per_tick_max();
  header.merge_burst_ticks =
      check.within(from.merge_burst_ticks(), 0, limits::merge_burst_ticks_max, "merge_burst_ticks");
  header.contacts_j = check.not_negative(from.contacts_j(), "contacts_j");
  header.rules = from.rules();
  header.settings = check.settings(from.settings());
  if (!from.spawn().empty())
    header.spawn = check.value_or_refuse(
        parse_spawn(check.text(from.spawn(), limits::setting_value_bytes_max, "spawn")));
  if (from.ground().size() == header.ground.size())
    std::ranges::copy(as_span(from.ground()), header.ground.begin());
  else if (!from.ground().empty())
    check.refuse("the hash of its ground is not of 32 bytes");
  if (from.has_rows()) header.terrain.rows = read_rows(from.rows(), check);
  if (!from.palette().empty())
    header.palette =
        std::make_shared<const Palette>(check.value_or_refuse(decode_palette(as_span(from.palette()))));
  if (header.palette != nullptr) header.terrain.rubble = Rubble(rubble_rows(*header.palette));
  return header;
}

}  // namespace scree
