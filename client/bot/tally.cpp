#include "client/bot/tally.h"

#include <algorithm>

#include "proto/operation_codec.h"
#include "shared/base/overloaded.h"

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
    report.costs[operation].add(cost);
  }
}

}  // namespace

void tally(const Received& received, BotReport& report) {
  BytesByKind& bytes = report.bytes;
  std::visit(Overloaded{[&](const FrameMessage& frame) {
                          const size_t transforms = std::min(
                              field_bytes(frame.transforms.size()) + field_bytes(frame.motions.size()),
                              received.bytes);
                          bytes.transforms += transforms;
                          bytes.frames += received.bytes - transforms;
                          tally_operations(frame, received.bytes - transforms, report);
                        },
                        [&](const ChunkMessage&) { bytes.chunks += received.bytes; },
                        [&](const UnchangedChunksMessage&) { bytes.chunks += received.bytes; },
                        [&](const TileMessage&) { bytes.tiles += received.bytes; },
                        [&](const PieceMessage&) { bytes.pieces += received.bytes; },
                        [&](const StatusMessage& status) {
                          bytes.other += received.bytes;
                          report.status = status;
                          report.tick_medians_ms.push_back(status.tick_median_ms);
                          report.tick_worst_ms = std::max<double>(report.tick_worst_ms, status.tick_worst_ms);
                        },
                        [&](const auto&) { bytes.other += received.bytes; }},
             received.message);
}

}  // namespace scree
