// Reads the keyframes that KeyframeWriter wrote to a recording's tables. Every byte is checked. Owned by a
// RecordingReader; one thread at a time.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "server/formats/recording_codec.h"
#include "server/store/database.h"
#include "server/store/keyframe_parts.h"
#include "shared/field/coord.h"

namespace scree {

class KeyframeReader {
 public:
  /// `header`: how the settings stood at the recording's start. `database` must outlive it.
  static Result<KeyframeReader> open(Database& database, SettingValues header);

  /// The tick of the latest keyframe up to that one; nothing when there is none.
  Result<std::optional<Tick>> tick_before(Tick tick);
  /// That of a tick that has one.
  Result<KeyframeParts> read(Tick tick, const KnownParts& known);
  Result<uint64_t> count();

  /// The terrain of the keyframe of a tick that has one, chunk by chunk, in no order; ends at the first
  /// error, also one of `visit`.
  using ChunkVisitor = std::function<Result<void>(ChunkCoord, std::span<const BrickPatch>)>;
  Result<void> each_chunk(Tick tick, const ChunkVisitor& visit);
  /// Whether a row has the chunk with that hash, up to a tick; and its bricks.
  Result<bool> has_chunk(ChunkCoord chunk, uint64_t hash, Tick tick);
  Result<std::vector<BrickPatch>> chunk(ChunkCoord chunk, uint64_t hash);
  /// Forgets rows that a keyframe of that tick, or a later one, does not need: a ring drops them.
  void forget_before(Tick tick);

 private:
  struct Row {
    Tick tick = 0;
    int64_t id = 0;
    uint64_t hash = 0;
  };

  explicit KeyframeReader(Database& database) : database_(&database) {}
  /// Takes up rows that came since the last call.
  Result<void> index();
  Result<void> read_chunks(KeyframeParts& parts, Tick tick, const KnownParts& known);
  Result<std::vector<BrickPatch>> read_chunk(const Row& row, ChunkCoord chunk);
  /// The latest row of a chunk up to the tick; null when there is none.
  static const Row* latest(const std::vector<Row>& rows, Tick tick);
  Result<void> read_pieces(KeyframeParts& parts, const KnownParts& known);
  tl::unexpected<Error> damaged(const std::string& what, Tick tick) const;

  Database* database_;
  SettingValues header_;
  Statement select_chunk_, select_piece_, select_state_;
  std::unordered_map<uint64_t, std::vector<Row>> chunks_;  ///< by chunk_key(); each in order
  int64_t indexed_ = 0;                                    ///< the last row that is in `chunks_`
};

}  // namespace scree
