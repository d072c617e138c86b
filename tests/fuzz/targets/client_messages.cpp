// Bytes of a client, as a session reads them: FrameReader with the limit before the hello, then that after
// it, and decode_client.
//
// Holds: however the bytes are split, the same messages come out; a decoded message can be encoded, and
// decodes to the same bytes; texts that others see may be shown.
#include <vector>

#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

bool may_be_shown(const std::string& text) {
  return !fault_of_text(text).has_value();
}

void check_texts(const ClientMessage& message) {
  std::visit(Overloaded{[](const auto&) {},
                        [](const HelloMessage& hello) {
                          CHECK(may_be_shown(hello.client) && may_be_shown(hello.name));
                        },
                        [](const AdminMessage& admin) {
                          if (const auto* kick = std::get_if<KickRequest>(&admin.act))
                            CHECK(may_be_shown(kick->reason));
                          if (const auto* ban = std::get_if<BanRequest>(&admin.act))
                            CHECK(may_be_shown(ban->reason) && may_be_shown(ban->address));
                          if (const auto* settings = std::get_if<SettingsRequest>(&admin.act))
                            for (const SettingValue& setting : settings->settings)
                              CHECK(may_be_shown(setting.name) && may_be_shown(setting.value));
                        }},
             message);
}

void check_message(std::span<const uint8_t> body) {
  const Result<ClientMessage> message = decode_client(body);
  if (!message) {
    CHECK(!message.error().message.empty());
    return;
  }
  check_texts(*message);
  const std::vector<uint8_t> bytes = encode(*message);
  const Result<ClientMessage> again = decode_client(std::span(bytes).subspan(length_prefix_bytes));
  CHECK(again.has_value());
  CHECK(encode(*again) == bytes);
}

/// Bodies of the stream's messages; where it is refused, it ends. `step`: bytes that arrive at once.
std::vector<std::vector<uint8_t>> messages_of(std::span<const uint8_t> stream, size_t step) {
  std::vector<std::vector<uint8_t>> bodies;
  FrameReader reader(limits::hello_bytes_max);
  for (size_t at = 0; at < stream.size(); at += step) {
    reader.push(stream.subspan(at, std::min(step, stream.size() - at)));
    for (;;) {
      const auto body = reader.next();
      if (!body) return bodies;
      if (!body->has_value()) break;
      bodies.emplace_back((**body).begin(), (**body).end());
      reader.set_message_bytes_max(limits::client_message_bytes_max);
    }
    CHECK(reader.buffered_bytes() <= limits::client_message_bytes_max + length_prefix_bytes);
  }
  return bodies;
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  const size_t step = input.byte() + size_t{1};
  const std::span<const uint8_t> stream = input.rest();
  const auto bodies = messages_of(stream, step);
  CHECK(bodies == messages_of(stream, std::max<size_t>(stream.size(), 1)));
  for (const auto& body : bodies) check_message(body);
  return 0;
}
