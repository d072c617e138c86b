#include "client/connection/health_probe.h"

#include <array>
#include <asio/io_context.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

#include "client/connection/dial.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "transport/transport.h"

namespace scree {

namespace {

class Probe {
 public:
  Result<HealthMessage> ask(const ServerEndpoint& server, std::chrono::milliseconds within) {
    ServerEndpoint asked = server;
    asked.token.clear();  // it is not sent, and so no fault of the way
    asked.link.reset();
    TRY(dial_.begin(
        asked, [this](std::shared_ptr<Transport> stream) { begin(std::move(stream)); },
        [this](const ConnectionEnd& failed) { end(failed.message); }));
    context_.run_for(within);
    if (!answer_ && why_.empty()) end(fmt::format("no answer within {} ms", within.count()));
    if (!answer_) return fail(why_);
    return *answer_;
  }

 private:
  void begin(std::shared_ptr<Transport> stream) {
    stream_ = std::move(stream);
    asked_ = encode(ClientMessage(AskHealthMessage{}));
    write(asked_);
    read();
  }
  void write(std::span<const uint8_t> rest) {
    stream_->write_some({&rest, 1}, [this, rest](const Moved& moved) {
      if (moved && *moved < rest.size()) write(rest.subspan(*moved));
    });
  }
  void read() {
    stream_->read_some(buffer_, [this](const Moved& moved) {
      if (!moved) return end("the connection ended without an answer: " + moved.error().why);
      reader_.push(std::span(buffer_).first(*moved));
      receive();
    });
  }
  void receive() {
    for (;;) {
      const auto body = reader_.next();
      if (!body) return end(body.error().message);
      if (!body->has_value()) return read();
      const auto message = decode_server(**body);
      if (!message) return end(message.error().message);
      if (const auto* refusal = std::get_if<RefusalMessage>(&*message))
        return end("the server refused: " + refusal->reason);
      if (const auto* health = std::get_if<HealthMessage>(&*message)) {
        answer_ = *health;
        return end({});
      }
    }
  }
  void end(const std::string& why) {
    if (why_.empty()) why_ = why;
    if (stream_) stream_->close();
    context_.stop();
  }

  asio::io_context context_;
  Dial dial_{context_};
  std::shared_ptr<Transport> stream_;
  std::vector<uint8_t> asked_;
  std::array<uint8_t, 4096> buffer_{};
  FrameReader reader_;
  std::optional<HealthMessage> answer_;
  std::string why_;
};

}  // namespace

Result<HealthMessage> ask_health(const ServerEndpoint& server, std::chrono::milliseconds within) {
  const auto failed = [&server](const std::string& why) {
    return fail(fmt::format("{}: {}", text_of(server), why));
  };
  try {
    Probe probe;
    auto health = probe.ask(server, within);
    if (!health) return failed(health.error().message);
    return health;
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

}  // namespace scree
