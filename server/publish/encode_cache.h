// Encodes a tick's frames, chunks and pieces once; all clients with the same selection share the bytes. Holds
// at most limits::encoded_chunk_bytes_max of chunks, and what one tick encodes.
//
// frame(), chunk(), piece(), prop() and stone() may be called by several threads at once: who asks first
// encodes, others that ask for the same wait for it. start_tick() is called while nobody does.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "server/publish/client_view.h"
#include "server/publish/shared_bytes.h"

namespace scree {

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
  SharedBytes prop(PieceId id, const PublishedProp& prop);
  SharedBytes stone(const SettledStone& stone);
  /// The chunk's bytes are let go. While nobody encodes.
  void forget(ChunkCoord chunk);

 private:
  /// The message of a piece or a prop, whole.
  template <typename Make>
  SharedBytes whole(PieceId id, const Make& make);
  /// Written by who comes first, and constant afterwards.
  struct EncodedFrame {
    Frame frame;
    std::once_flag once;
  };
  struct Encoded {
    SharedBytes bytes;
    std::once_flag once;

    size_t size() const { return bytes ? bytes->size() : 0; }
  };
  struct EncodedChunk {
    Tick version = 0;
    uint64_t hash = 0;
    std::shared_ptr<Encoded> encoded;
  };
  EncodedFrame& entry_of(FrameSelection selection);
  std::shared_ptr<Encoded> entry_of(ChunkCoord coord, const PublishedChunk& chunk);

  std::mutex mutex_;
  // Guarded by mutex_, but for what the entries hold.
  std::unordered_multimap<uint64_t, std::unique_ptr<EncodedFrame>> frames_;  ///< by a hash of the selection
  std::unordered_map<ChunkCoord, EncodedChunk, CoordHash> chunks_;
  std::map<PieceId, Encoded> pieces_;

  std::atomic<size_t> chunk_bytes_{0};
};

}  // namespace scree
