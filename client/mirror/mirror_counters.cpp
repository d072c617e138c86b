#include "client/mirror/mirror.h"

namespace scree {

MirrorCounters& MirrorCounters::operator+=(const MirrorCounters& other) {
  frames += other.frames;
  operations += other.operations;
  operation_bytes += other.operation_bytes;
  patched_bricks += other.patched_bricks;
  transforms += other.transforms;
  transform_bytes += other.transform_bytes;
  chunks += other.chunks;
  chunk_parts += other.chunk_parts;
  chunks_kept += other.chunks_kept;
  dropped_chunks += other.dropped_chunks;
  pieces_made += other.pieces_made;
  pieces_sent += other.pieces_sent;
  pieces_merged += other.pieces_merged;
  props_sent += other.props_sent;
  checks += other.checks;
  mismatches += other.mismatches;
  repairs_asked += other.repairs_asked;
  repairs_arrived += other.repairs_arrived;
  resets += other.resets;
  return *this;
}

}  // namespace scree
