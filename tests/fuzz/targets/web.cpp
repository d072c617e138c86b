// One connection that speaks HTTP, and perhaps opens a WebSocket, whose stream is sent back: requests,
// handshakes and frames as they should be, any bytes between them, carried as many at once as the input says.
//
// These hold. As long as the client keeps to the rules, the bytes that arrive by the WebSocket are those that
// were sent. Behind a handshake the server sends frames without a mask and in order, and nothing behind a
// close. The values of a head are within their bounds. Whatever was asked, a page may ask what became of it.
#include <algorithm>
#include <array>
#include <memory>

#include "server/web/http_connection.h"
#include "server/web/limits.h"
#include "server/web/site.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/memory_transport.h"
#include "tests/fuzz/support/target.h"
#include "tests/support/websocket_frame.h"
#include "transport/websocket_transport.h"

namespace scree {
namespace {

constexpr int steps_max = 200;
constexpr uint64_t frame_bytes_max = 5000;
const HttpTimes times{5.0, 15.0, 20.0, 2.0};

/// Sends back what it reads.
class Echo {
 public:
  explicit Echo(std::shared_ptr<Transport> stream) : stream_(std::move(stream)) {}
  ~Echo() { stream_->close(); }
  Echo(const Echo&) = delete;
  Echo& operator=(const Echo&) = delete;

  void start() { read(); }
  const std::vector<uint8_t>& received() const { return received_; }

 private:
  void read() {
    stream_->read_some(buffer_, [this](const Moved& moved) {
      if (!moved) return;
      received_.insert(received_.end(), buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(*moved));
      write(*moved);
    });
  }
  void write(size_t left) {
    if (left == 0) return read();
    const std::span<const uint8_t> rest = std::span<const uint8_t>(received_).last(left);
    stream_->write_some({&rest, 1}, [this, left](const Moved& moved) {
      if (moved) write(left - *moved);
    });
  }

  std::shared_ptr<Transport> stream_;
  std::array<uint8_t, 700> buffer_{};
  std::vector<uint8_t> received_;
};

class Server final : public HttpHost {
 public:
  explicit Server(const std::shared_ptr<MemoryTransport>& link)
      : connection_(std::make_shared<HttpConnection>(link, 1, *this, times, 0.0)) {
    connection_->start({});
  }
  ~Server() override {
    if (connection_) connection_->close();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void check_time(double now_s) {
    if (const auto connection = connection_) connection->check_time(now_s);
  }
  const Echo* echo() const { return echo_.get(); }

  HttpResponse answer(const HttpConnection& /*from*/, const HttpRequest& request) override {
    CHECK(request.path.starts_with('/') && request.path.size() < limits::http_head_bytes_max);
    CHECK(request.path.find_first_of(std::string_view("\0\r\n ?", 5)) == std::string::npos);
    if (const auto no = site_.refuse_host(request, {})) CHECK_EQ(no->status, 421);
    HttpResponse response = site_.answer(request, {});
    HttpRequest asks = request;
    asks.method = HttpMethod::get;
    asks.path = "/session.json";
    CHECK_EQ(site_.answer(asks, {}).status, 200);
    return response;
  }
  size_t file_room(const HttpConnection& /*connection*/) const override {
    return limits::http_head_bytes_max;
  }
  void sent(const HttpConnection& /*connection*/, size_t bytes) override { CHECK(bytes > 0); }
  void answered(const HttpResponse& response, size_t bytes) override {
    CHECK(bytes > 0 && response.status >= 101 && response.status < 600);
  }
  void opened_websocket(HttpConnection& /*from*/, std::shared_ptr<Transport> stream,
                        std::span<const uint8_t> arrived) override {
    echo_ = std::make_unique<Echo>(
        std::make_shared<WebSocketTransport>(std::move(stream), frame_bytes_max, arrived));
    echo_->start();
    connection_ = nullptr;
  }
  void disconnect(const HttpConnection& /*connection*/, Refusal /*reason*/) override {}
  void ended(HttpConnection& /*connection*/) override { connection_ = nullptr; }

 private:
  Site site_{std::make_shared<const WebFiles>(), WebNames({.origins = {"https://friend.example"}})};
  std::shared_ptr<HttpConnection> connection_;
  std::unique_ptr<Echo> echo_;
};

/// What the server sends behind a handshake, frame by frame.
class Frames {
 public:
  void add(std::span<const uint8_t> bytes) {
    for (const uint8_t byte : bytes) {
      CHECK(!closed_);
      add(byte);
    }
  }
  const std::vector<uint8_t>& payload() const { return payload_; }

 private:
  void add(uint8_t byte) {
    if (left_ > 0) {
      if (binary_) payload_.push_back(byte);
      if (--left_ == 0) end_frame();
      return;
    }
    head_.push_back(byte);
    if (head_.size() < 2) return;
    CHECK((head_[0] & 0x70U) == 0 && (head_[0] & 0x80U) != 0 && head_[1] < 127);
    const size_t length_bytes = head_[1] == 126 ? 2 : 0;
    if (head_.size() < 2 + length_bytes) return;
    left_ = length_bytes == 0 ? head_[1] : head_[2] * 256U + head_[3];
    CHECK(length_bytes == 0 || left_ >= 126);
    const unsigned opcode = head_[0] & 0xfU;
    CHECK(opcode == 2 || opcode == 8 || opcode == 10);
    binary_ = opcode == 2;
    if (left_ == 0) end_frame();
  }
  void end_frame() {
    closed_ = (head_[0] & 0xfU) == 8;
    head_.clear();
  }

  std::vector<uint8_t> head_;
  size_t left_ = 0;
  bool binary_ = false;
  bool closed_ = false;
  std::vector<uint8_t> payload_;
};

class Client {
 public:
  void step(FuzzInput& input) {
    const uint32_t kind = input.below(16);
    if (kind == 0) break_rules(input.packet());
    if (kind == 1) send_text("GET /" + input.text(20) + " HTTP/1.1\r\nHost: a\r\n\r\n");
    if (kind == 2) send_text("HEAD /healthz HTTP/1.1\r\nHost: a\r\n\r\n");
    if (kind == 3) open_websocket("");
    if (kind == 12) open_websocket("Origin: http://" + input.text(40) + "\r\n");
    if (kind > 3 && kind < 9) send_frame(input);
    if (kind == 9) link_->read_on(input.flag());
    if (kind == 10) server_.check_time(now_s_ += input.byte() / 32.0);
    if (kind == 11 && input.below(4) == 3) link_->end(input.flag());
    carry(kind < 12 ? SIZE_MAX : 1 + input.byte());
  }
  void finish() {
    link_->read_on(true);
    for (int i = 0; i < steps_max && carry(SIZE_MAX); ++i) continue;
    if (server_.echo() == nullptr) return;
    const std::vector<uint8_t>& received = server_.echo()->received();
    CHECK(frames_.payload().size() <= received.size());
    CHECK(std::equal(frames_.payload().begin(), frames_.payload().end(), received.begin()));
    if (!keeps_rules_) return;
    CHECK(received.size() <= sent_.size() && std::equal(received.begin(), received.end(), sent_.begin()));
  }

 private:
  void send_text(const std::string& text) {
    const std::span bytes(reinterpret_cast<const uint8_t*>(text.data()), text.size());
    if (asked_websocket_)
      break_rules(bytes);
    else
      link_->send(bytes);
  }
  void break_rules(std::span<const uint8_t> bytes) {
    keeps_rules_ = false;
    link_->send(bytes);
  }
  void open_websocket(const std::string& field) {
    send_text("GET /session?attempt=" + std::string(limits::socket_digits, 'a') +
              " HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" + field +
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    asked_websocket_ = true;
  }
  void send_frame(FuzzInput& input) {
    FrameShape shape{.opcode = static_cast<uint8_t>(input.below(12)), .fin = input.flag()};
    if (input.below(8) == 7) shape.masked = false;
    if (input.below(8) == 7) shape.says_bytes = input.number<uint64_t>();
    const std::span<const uint8_t> payload = input.packet();
    const bool good = shape.opcode == (in_message_ ? 0 : 2) && shape.masked && !shape.says_bytes &&
                      asked_websocket_ && payload.size() <= frame_bytes_max;
    if (!good) return break_rules(websocket_frame(payload, shape));
    in_message_ = !shape.fin;
    if (keeps_rules_) sent_.insert(sent_.end(), payload.begin(), payload.end());
    link_->send(websocket_frame(payload, shape));
  }
  bool carry(size_t bytes) {
    const bool moved = link_->pump(bytes);
    const std::vector<uint8_t> arrived = link_->drain_arrived();
    if (server_.echo() == nullptr || !handshake_over_)
      skip_answers(arrived);
    else
      frames_.add(arrived);
    return moved;
  }
  /// Up to the end of the head that opens the WebSocket.
  void skip_answers(const std::vector<uint8_t>& arrived) {
    answers_.append(arrived.begin(), arrived.end());
    const size_t upgrade = answers_.find("HTTP/1.1 101");
    const size_t end = upgrade == std::string::npos ? upgrade : answers_.find("\r\n\r\n", upgrade);
    if (end == std::string::npos) return;
    handshake_over_ = true;
    const std::string rest = answers_.substr(end + 4);
    frames_.add(std::span(reinterpret_cast<const uint8_t*>(rest.data()), rest.size()));
  }

  std::shared_ptr<MemoryTransport> link_ = std::make_shared<MemoryTransport>("client");
  Server server_{link_};
  Frames frames_;
  std::string answers_;
  std::vector<uint8_t> sent_;  ///< as payload, by the rules
  double now_s_ = 0.0;
  bool asked_websocket_ = false;
  bool handshake_over_ = false;
  bool in_message_ = false;
  bool keeps_rules_ = true;
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  scree::FuzzInput input(data, size);
  scree::Client client;
  for (int i = 0; i < scree::steps_max && !input.at_end(); ++i) client.step(input);
  client.finish();
  return 0;
}
