#include "client/bot/tally.h"

#include <algorithm>

#include "proto/operation_codec.h"

namespace scree {

namespace {

/// Size of a bytes field within its message: tag, length, content.
size_t field_bytes(size_t content) {
  if (content == 0) return 0;
  size_t bytes = content + 2;
  for (size_t rest = content >> 7U; rest != 0; rest >>= 7U) ++bytes;
  return bytes;
}

void tally_operations(const FrameMessage& frame, size_t frame_bytes, BotReport& report) {
  if (frame.operations.empty() || !frame.patches.empty()) return;
  size_t operations = 0;
  for (const Operation& operation : frame.operations) operations += operation_bytes(operation);
  const double overhead =
      static_cast<double>(frame_bytes - operations) / static_cast<double>(frame.operations.size());
  for (const Operation& operation : frame.operations) {
    const double cost = static_cast<double>(operation_bytes(operation)) + overhead;
    if (std::holds_alternative<CarveOperation>(operation)) report.carve_cost.add(cost);
    if (std::holds_alternative<StampOperation>(operation)) report.merge_cost.add(cost);
  }
}

}  // namespace

void tally(const Received& received, BotReport& report) {
  BytesByKind& bytes = report.bytes;
  if (const auto* frame = std::get_if<FrameMessage>(&received.message)) {
    const size_t transforms = std::min(field_bytes(frame->transforms.size()), received.bytes);
    bytes.transforms += transforms;
    bytes.frames += received.bytes - transforms;
    tally_operations(*frame, received.bytes - transforms, report);
  } else if (std::holds_alternative<ChunkMessage>(received.message)) {
    bytes.chunks += received.bytes;
  } else if (std::holds_alternative<PieceMessage>(received.message)) {
    bytes.pieces += received.bytes;
  } else {
    bytes.other += received.bytes;
  }
  if (const auto* status = std::get_if<StatusMessage>(&received.message)) {
    report.status = *status;
    report.tick_medians_ms.push_back(status->tick_median_ms);
    report.tick_worst_ms = std::max<double>(report.tick_worst_ms, status->tick_worst_ms);
  }
}

}  // namespace scree
