// The rows of keyframes as tables of a recording (schema.h). Owned by a RecordingWriter; one thread at a
// time.
#pragma once

#include <functional>

#include "server/store/database.h"
#include "server/store/keyframe_rows.h"

namespace scree {

class KeyframeTables final : public KeyframeRows {
 public:
  /// `database` must outlive it.
  static Result<KeyframeTables> create(Database& database);

  const std::string& name() const override { return database_->path(); }
  Result<void> put_chunk(Tick tick, ChunkCoord chunk, uint64_t hash, std::span<const uint8_t> data) override;
  Result<void> put_piece(PieceId id, std::span<const uint8_t> data) override;
  Result<void> put_state(Tick tick, std::span<const uint8_t> data) override;
  Result<std::vector<uint8_t>> last_chunk(ChunkCoord chunk) override;

  /// The rows of chunks that are there, the latest of each last.
  Result<void> each_chunk(const std::function<void(ChunkCoord chunk, uint64_t hash)>& visit);
  /// Drops what keyframes from that tick on do not need. There is a keyframe of the tick, when the next piece
  /// to be made was `next_piece`.
  Result<void> drop_before(Tick tick, PieceId next_piece);

 private:
  explicit KeyframeTables(Database& database) : database_(&database) {}

  Database* database_;
  Statement insert_chunk_, put_piece_, put_state_;
};

}  // namespace scree
