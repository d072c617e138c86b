#include "server/publish/outgoing.h"

namespace scree {

PublisherStats& PublisherStats::operator+=(const PublisherStats& other) {
  sent_bytes += other.sent_bytes;
  frame_bytes += other.frame_bytes;
  transform_bytes += other.transform_bytes;
  chunk_bytes += other.chunk_bytes;
  kept_bytes += other.kept_bytes;
  chunks_kept += other.chunks_kept;
  piece_bytes += other.piece_bytes;
  stone_bytes += other.stone_bytes;
  ground_bytes += other.ground_bytes;
  tile_bytes += other.tile_bytes;
  content_bytes += other.content_bytes;
  operations += other.operations;
  operation_bytes += other.operation_bytes;
  repairs += other.repairs;
  resets += other.resets;
  return *this;
}

}  // namespace scree
