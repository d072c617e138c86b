// The rows of keyframes in memory: of each chunk the latest, of each piece alive one. Their bytes are as
// compressed as in a recording. One thread at a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "server/formats/bus_codec.h"
#include "server/store/keyframe_parts.h"
#include "server/store/keyframe_rows.h"

namespace scree {

class ToldRows final : public KeyframeRows {
 public:
  const std::string& name() const override { return name_; }
  Result<void> put_chunk(Tick tick, ChunkCoord chunk, uint64_t hash, std::span<const uint8_t> data) override;
  Result<void> put_piece(PieceId id, std::span<const uint8_t> data) override;
  Result<void> put_state(Tick tick, std::span<const uint8_t> data) override;
  Result<std::vector<uint8_t>> last_chunk(ChunkCoord chunk) override;

  /// All rows, as one message. Pieces that the state does not name are forgotten.
  Result<ToldKeyframe> keyframe(std::span<const uint8_t> header, uint64_t world);

 private:
  struct Chunk {
    uint64_t hash = 0;
    std::vector<uint8_t> data;
  };
  const std::string name_ = "what is told to the bus";
  std::unordered_map<ChunkCoord, Chunk, CoordHash> chunks_;
  std::map<PieceId, std::vector<uint8_t>> pieces_;
  std::vector<uint8_t> state_;
};

/// What a message with a keyframe says: the world's header, and its state without what is known.
Result<RecordedHeader> header_of(const ToldKeyframe& keyframe);
Result<KeyframeParts> parts_of(const ToldKeyframe& keyframe, Tick tick, const SettingValues& header,
                               const KnownParts& known);

}  // namespace scree
