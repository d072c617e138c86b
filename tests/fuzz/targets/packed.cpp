// The packed bytes within messages and recordings: the first byte chooses the decoder, the rest is for it.
//
// Holds: what is decoded can be encoded, and decodes to the same bytes.
#include <array>
#include <vector>

#include "proto/operation_codec.h"
#include "proto/transforms.h"
#include "server/formats/recording_codec.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

using Bytes = std::span<const uint8_t>;

/// `bytes` once around; what `encode` makes of it is the same the second time.
template <typename Decode, typename Encode>
void check_round(Bytes bytes, const Decode& decode, const Encode& encode) {
  const auto value = decode(bytes);
  if (!value) {
    CHECK(!value.error().message.empty());
    return;
  }
  const std::vector<uint8_t> encoded = encode(*value);
  const auto again = decode(Bytes(encoded));
  CHECK(again.has_value());
  CHECK(encode(*again) == encoded);
}

void operations(Bytes bytes) {
  check_round(bytes, decode_operations, [](const auto& value) { return encode_operations(value); });
}
void one_operation(Bytes bytes) {
  check_round(bytes, decode_operation, encode_operation);
}
void bricks(Bytes bytes) {
  check_round(
      bytes, [](Bytes b) { return decode_bricks(b); },
      [](const std::vector<BrickPatch>& value) { return encode_bricks(value); });
}
void volume(Bytes bytes) {
  check_round(bytes, decode_volume, encode_volume);
}
void transforms(Bytes bytes) {
  check_round(bytes, unpack_transforms,
              [](const std::vector<PieceState>& value) { return pack_transforms(value); });
}
void header(Bytes bytes) {
  check_round(bytes, decode_recorded_header, [](const RecordedHeader& value) { return encode(value); });
}
void frame(Bytes bytes) {
  check_round(bytes, decode_recorded_frame, [](const RecordedFrame& value) { return encode(value); });
}
void keyframe(Bytes bytes) {
  check_round(bytes, decode_recorded_keyframe, [](const RecordedKeyframe& value) { return encode(value); });
}
void commands(Bytes bytes) {
  check_round(bytes, decode_recorded_commands,
              [](const std::vector<Command>& value) { return encode(std::span(value)); });
}

/// The place is the first byte of an input: new ones come last.
constexpr std::array<void (*)(Bytes), 9> decoders = {operations, one_operation, bricks,   volume,  transforms,
                                                     header,     frame,         keyframe, commands};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  const uint32_t decoder = input.below(scree::decoders.size());
  scree::decoders[decoder](input.rest());
  return 0;
}
