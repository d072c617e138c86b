#include <fmt/format.h>

#include "client/mirror/limits.h"
#include "client/mirror/mirror.h"
#include "proto/limits.h"

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

Result<void> Mirror::within_limits() const {
  if (const size_t chunks = held_.size() + incomplete_.size(); chunks > limits::mirror_chunks_max)
    return fail(
        fmt::format("{} edited chunks are over this client's {} (limits.mirror_chunks_max); ask for a "
                    "smaller radius of interest",
                    chunks, limits::mirror_chunks_max));
  if (props_.size() > limits::mirror_props_max)
    return fail(fmt::format("{} props are over this client's {} (limits.mirror_props_max)", props_.size(),
                            limits::mirror_props_max));
  if (motions_.size() > limits::mirror_pieces_max)
    return fail(fmt::format("{} pieces are over this client's {} (limits.mirror_pieces_max)", motions_.size(),
                            limits::mirror_pieces_max));
  if (piece_voxels_ > limits::piece_voxels_max)
    return fail(fmt::format("pieces of {} voxels are over the limit of {} (limits.piece_voxels_max)",
                            piece_voxels_, limits::piece_voxels_max));
  return {};
}

}  // namespace scree
