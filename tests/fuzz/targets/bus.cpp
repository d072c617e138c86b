// Messages of a bus: ticks, keyframes and pipes as any program may write them; decoded, put together and
// played.
//
// The world is flat. Ticks come as parts or whole, and are played when they follow; a keyframe's rows become
// the world.
//
// Holds: what cannot be read is an error, and what can be read is written as it was; a world plays on after
// every keyframe that it takes.
#include <array>

#include "server/replay/played_world.h"
#include "server/told/told_parts.h"
#include "server/told/told_rows.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr int messages_max = 24;
constexpr size_t value_bytes_max = 1U << 16U;

/// What was read is written, and read again.
template <typename Message, typename Decode>
void check_written(const Message& message, const Decode& decode) {
  const auto bytes = encode(message);
  const auto again = decode(bytes);
  CHECK(again.has_value());
  CHECK(encode(*again) == bytes);
}

class BusTarget {
 public:
  void take_tick(std::span<const uint8_t> bytes) {
    auto frame = decode_told(bytes);
    if (!frame) return check_said(frame.error());
    if (!whole_ || frame->tick != world_.tick() + 1) return;
    const auto delta = world_.advance(std::move(*frame));
    whole_ = delta.has_value();
    if (delta) CHECK((*delta)->tick == world_.tick());
  }
  void take_keyframe(std::span<const uint8_t> bytes, Tick tick) {
    const auto keyframe = decode_told_keyframe(bytes);
    if (!keyframe) return check_said(keyframe.error());
    check_written(*keyframe, decode_told_keyframe);
    (void)header_of(*keyframe);
    auto parts = parts_of(*keyframe, tick, {}, world_.known());
    if (!parts) return check_said(parts.error());
    BricksBefore before;
    whole_ = world_.restore(std::move(*parts), before).has_value();
    if (whole_) CHECK(world_.whole_state() != nullptr && world_.tick() == tick);
  }
  void take_part(std::span<const uint8_t> bytes, bool of_tick, Tick tick) {
    auto part = decode_told_part(bytes);
    if (!part) return check_said(part.error());
    check_written(*part, decode_told_part);
    const auto value = (of_tick ? ticks_ : keyframes_).add(std::move(*part));
    if (!value) return;
    CHECK(value->bytes.size() <= value_bytes_max);
    of_tick ? take_tick(value->bytes) : take_keyframe(value->bytes, tick);
  }
  static void take_whole(std::span<const uint8_t> bytes) {
    const auto whole = decode_told_whole(bytes);
    whole ? check_written(*whole, decode_told_whole) : check_said(whole.error());
  }
  static void take_pipe(std::span<const uint8_t> bytes) {
    const auto message = decode_pipe_message(bytes);
    message ? check_written(*message, decode_pipe_message) : check_said(message.error());
  }

 private:
  static void check_said(const Error& error) { CHECK(!error.message.empty()); }

  PlayedWorld world_{"a bus", TerrainSource{TerrainKind::flat, 1, 1.0F}};
  bool whole_ = true;  ///< else only a keyframe helps
  ToldAssembly ticks_{value_bytes_max}, keyframes_{value_bytes_max};
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  BusTarget target;
  for (int messages = 0; !input.at_end() && messages < messages_max; ++messages) {
    const uint32_t kind = input.below(6);
    const Tick tick = input.byte();
    const auto bytes = input.packet();
    switch (kind) {
      case 0:
        target.take_tick(bytes);
        break;
      case 1:
        target.take_keyframe(bytes, tick);
        break;
      case 2:
        target.take_part(bytes, true, tick);
        break;
      case 3:
        target.take_part(bytes, false, tick);
        break;
      case 4:
        BusTarget::take_whole(bytes);
        break;
      default:
        BusTarget::take_pipe(bytes);
        break;
    }
  }
  return 0;
}
