// A build of the simulation alone has no zstd, so it reads no packed volumes: it refuses pieces that requests
// bring (AddPieceRequest). Nor does it have what packs them.
#include "proto/operation_codec.h"

namespace scree {

namespace {

constexpr const char* no_codec = "this program is built without the codec of volumes (SCREE_SERVER has it)";

}  // namespace

Result<Volume> decode_volume(std::span<const uint8_t> /*bytes*/) {
  return fail(no_codec);
}

Result<VoxelBox> decode_volume_box(std::span<const uint8_t> /*bytes*/) {
  return fail(no_codec);
}

}  // namespace scree
