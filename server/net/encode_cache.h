// Encodes a tick's frames, chunks and pieces once; all clients with the same selection share the bytes. Holds
// at most limits::encoded_chunks_max chunks. Not thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/net/client_view.h"

namespace scree {

using SharedBytes = std::shared_ptr<const std::vector<uint8_t>>;

class EncodeCache {
 public:
  struct Frame {
    FrameSelection selection;
    SharedBytes bytes;
    size_t transform_bytes = 0;
  };

  /// Forgets the frames and pieces of the tick before.
  void start_tick();

  /// Bytes include the length prefix. A frame is valid until start_tick().
  const Frame& frame(FrameSelection selection, const TickChanges& changes);
  SharedBytes chunk(ChunkCoord coord, const PublishedChunk& chunk);
  SharedBytes piece(PieceId id, const PublishedPiece& piece);

 private:
  struct EncodedChunk {
    Tick version = 0;
    uint64_t hash = 0;
    SharedBytes bytes;
  };
  std::unordered_multimap<uint64_t, std::unique_ptr<Frame>> frames_;  ///< by a hash of the selection
  std::unordered_map<ChunkCoord, EncodedChunk, CoordHash> chunks_;
  std::map<PieceId, SharedBytes> pieces_;
};

}  // namespace scree
