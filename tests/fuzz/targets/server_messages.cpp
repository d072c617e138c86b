// One message of a server, as a client's connection decodes it.
//
// Holds: what is decoded can be encoded, and decodes to the same bytes; its memory is within what its limits
// allow.
#include <vector>

#include "proto/codec.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

/// All limits of a message's content together: 4,096 bricks, or a volume, and small things beside.
constexpr size_t decoded_bytes_max = size_t{64} << 20;

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  const Result<ServerMessage> message = decode_server({data, size});
  if (!message) {
    CHECK(!message.error().message.empty());
    return 0;
  }
  CHECK(memory_bytes(*message) <= decoded_bytes_max);
  const std::vector<uint8_t> bytes = encode(*message);
  const Result<ServerMessage> again = decode_server(std::span(bytes).subspan(length_prefix_bytes));
  CHECK(again.has_value());
  CHECK(encode(*again) == bytes);
  return 0;
}
