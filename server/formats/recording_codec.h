// Converts the blobs of a recording between plain values and bytes. server/formats/recording.proto is the
// specification.
//
// Decoders check everything: a recording is an untrusted file. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "server/command/command.h"
#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/base/spawn.h"
#include "shared/material/palette.h"
#include "shared/operation/ledger.h"

namespace scree {

/// Version of the blobs and the tables that is written, and the oldest that is read: what both have is the
/// same. A reader refuses any other.
inline constexpr uint32_t recording_format = 10;
inline constexpr uint32_t recording_format_oldest = 6;
constexpr bool reads_recording_format(uint32_t format) {
  return recording_format_oldest <= format && format <= recording_format;
}

struct RecordedHeader {
  uint32_t format = recording_format;
  std::string program;
  TerrainSource terrain;  ///< decoded, without the model of a ground's file: `ground` names it
  Digest ground{};        ///< of the file that the terrain's ground is from; zeros: it is generated
  uint32_t tick_rate_hz = 60;
  uint32_t merges_per_tick_max = 0;
  SettingValues settings;          ///< to start with
  std::optional<Spawn> spawn{};    ///< as of WorldConfig: it is not among `settings`
  uint32_t merge_burst_ticks = 0;  ///< of a recording's events: EventDeriver
  float contacts_j = 0.0F;         ///< likewise
  uint32_t rules = 0;              ///< by which the simulation serves (server/world/rules.h)
  /// To start with. Null in old files alone: the built-in one, whose digest a test of tests/content pins.
  std::shared_ptr<const Palette> palette{};
};

struct RecordedFrame {
  Tick tick = 0;
  std::vector<Operation> operations;
  std::vector<PieceState> moved;  ///< pieces that are new or have another pose than before; ordered by id
  Ledger ledger;
  uint64_t field_hash = 0;
  uint64_t state_hash = 0;
  SettingValues settings;            ///< as TickDelta::settings
  std::vector<PieceMessage> pieces;  ///< that no operation made, without their poses; ordered by id
  std::vector<PropMessage> props;    ///< that were added, with their poses; ordered by id
  std::vector<PieceId> props_gone;   ///< of those that were there before; ordered
  JointsMessage joints;              ///< added, or with another motor; and those that were there before
  std::shared_ptr<const std::vector<Region>> regions{};  ///< as TickDelta::regions
  std::vector<StoreContent> stores{};                    ///< that changed, in order
  std::shared_ptr<const std::vector<Sign>> signs{};      ///< as TickDelta::signs
  std::vector<Notice> notices{};                         ///< likewise
};

struct RecordedKeyframe {
  Tick tick = 0;
  std::vector<BrickPatch> bricks;
  std::vector<PieceMessage> pieces;
  Ledger ledger;
  uint64_t field_hash = 0;
  uint64_t state_hash = 0;
  SettingValues settings;
  std::vector<PieceState> poses;       ///< of the pieces whose volumes are rows of their own; ordered by id
  MaterialLedger materials;            ///< empty in recordings that keep none
  std::vector<PropMessage> props;      ///< all there are; ordered by id
  std::vector<KnownJoint> joints;      ///< likewise
  std::vector<Region> regions{};       ///< likewise
  std::vector<StoreContent> stores{};  ///< all there are, in order
  std::vector<Sign> signs{};           ///< likewise
};

std::vector<uint8_t> encode(const RecordedHeader& header);
std::vector<uint8_t> encode(const RecordedFrame& frame);
std::vector<uint8_t> encode(const RecordedKeyframe& keyframe);
std::vector<uint8_t> encode(std::span<const Command> commands);
/// A prop as a message, wherever it is kept alone.
std::vector<uint8_t> encode_recorded_prop(const PropMessage& prop);
Result<PropMessage> decode_recorded_prop(std::span<const uint8_t> bytes);
/// A piece's row: the pose is that of the tick in which it was written.
std::vector<uint8_t> encode_recorded_piece(const PieceMessage& piece);

Result<RecordedHeader> decode_recorded_header(std::span<const uint8_t> bytes);
Result<RecordedFrame> decode_recorded_frame(std::span<const uint8_t> bytes);
Result<RecordedKeyframe> decode_recorded_keyframe(std::span<const uint8_t> bytes);
Result<std::vector<Command>> decode_recorded_commands(std::span<const uint8_t> bytes);
Result<PieceMessage> decode_recorded_piece(std::span<const uint8_t> bytes);

}  // namespace scree
