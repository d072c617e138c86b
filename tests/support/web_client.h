// A client of HTTP and WebSocket on loopback, plainly or by TLS, for tests that also send what no browser
// would. It shares nothing with the server's code but TLS. Every wait has a deadline.
#pragma once

#include <algorithm>
#include <charconv>
#include <chrono>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <poll.h>
#include <span>
#include <string>
#include <strings.h>
#include <sys/socket.h>
#include <vector>

#include "crypto/tls_engine.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "tests/support/loopback_socket.h"
#include "tests/support/patience.h"
#include "tests/support/websocket_frame.h"

namespace scree {

/// Bytes to and from a server.
class WebPipe {
 public:
  explicit WebPipe(const Route& route, const std::shared_ptr<const TlsClientContext>& tls = nullptr,
                   int receive_buffer_bytes = 0)
      : socket_(route, receive_buffer_bytes), connected_(socket_.connected()) {
    if (tls) tls_.emplace(tls, "localhost");
    while (tls_ && connected_ && !tls_->established()) connected_ = shake();
  }

  bool connected() const { return connected_; }
  bool send(std::span<const uint8_t> bytes) {
    if (!tls_) return send_raw(bytes);
    return tls_->write(bytes).has_value() && send_output();
  }
  bool send(std::string_view text) {
    return send(std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
  }
  void finish_sending() { socket_.finish_sending(); }
  /// What arrives next; empty: nothing more comes.
  std::vector<uint8_t> receive() {
    for (;;) {
      std::vector<uint8_t> bytes(65536);
      if (tls_) {
        const auto got = tls_->read(bytes);
        if (!got || got->ended) return {};
        bytes.resize(got->bytes);
        if (got->bytes > 0) return bytes;
      }
      const auto arrived = receive_raw();
      if (!tls_ || arrived.empty()) return arrived;
      tls_->feed(arrived);
    }
  }
  /// Whether the server ends the connection, in whatever way.
  bool ends() {
    while (!receive().empty()) continue;
    return !late_;
  }

 private:
  bool shake() {
    if (!tls_->shake() || !send_output()) return false;
    if (tls_->established()) return true;
    const auto arrived = receive_raw();
    tls_->feed(arrived);
    return !arrived.empty();
  }
  bool send_output() {
    std::vector<uint8_t> output;
    tls_->drain_output(output);
    return send_raw(output);
  }
  bool send_raw(std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes = bytes.subspan(static_cast<size_t>(sent));
    }
    return true;
  }
  std::vector<uint8_t> receive_raw() {
    pollfd waiting{socket_.number(), POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(patience.count() * 1000)) <= 0) {
      late_ = true;
      return {};
    }
    std::vector<uint8_t> bytes(65536);
    const ssize_t count = ::recv(socket_.number(), bytes.data(), bytes.size(), 0);
    bytes.resize(count > 0 ? static_cast<size_t>(count) : 0);
    return bytes;
  }

  LoopbackSocket socket_;
  bool connected_ = false;
  bool late_ = false;
  std::optional<TlsEngine> tls_;
};

/// Names of fields are the same in capitals and small letters; proxies change them.
struct FieldLess {
  bool operator()(const std::string& a, const std::string& b) const {
    return ::strcasecmp(a.c_str(), b.c_str()) < 0;
  }
};

struct HttpAnswer {
  int status = 0;  ///< 0: there was none
  std::map<std::string, std::string, FieldLess> fields;
  std::string body;

  std::string field(const std::string& name) const {
    const auto found = fields.find(name);
    return found == fields.end() ? std::string() : found->second;
  }
};

class HttpClient {
 public:
  explicit HttpClient(const Route& route, const std::shared_ptr<const TlsClientContext>& tls = nullptr,
                      int receive_buffer_bytes = 0)
      : pipe_(route, tls, receive_buffer_bytes),
        host_((route.from.empty() ? "localhost" : route.to) + ":" + std::to_string(route.port)) {}

  WebPipe& pipe() { return pipe_; }
  const std::string& host() const { return host_; }
  /// Asks under this name from now on.
  HttpClient& ask_for(const std::string& host) {
    host_ = host;
    return *this;
  }

  /// Further fields, each with its line's end.
  HttpAnswer get(const std::string& path, const std::string& fields = "", const std::string& method = "GET") {
    pipe_.send(method + " " + path + " HTTP/1.1\r\nHost: " + host_ + "\r\n" + fields + "\r\n");
    return answer(method == "HEAD");
  }
  /// The next one that arrives.
  HttpAnswer answer(bool head_only = false) {
    HttpAnswer answer;
    size_t end = 0;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
      if (!fill()) return answer;
    std::string head = buffer_.substr(0, end + 2);
    buffer_.erase(0, end + 4);
    std::from_chars(head.data() + std::min<size_t>(9, head.size()), head.data() + head.size(), answer.status);
    for (size_t line = head.find("\r\n") + 2; line < head.size();) {
      const size_t next = head.find("\r\n", line), colon = head.find(": ", line);
      answer.fields[head.substr(line, colon - line)] = head.substr(colon + 2, next - colon - 2);
      line = next + 2;
    }
    const size_t bytes = head_only ? 0 : std::atoi(answer.field("Content-Length").c_str());
    while (buffer_.size() < bytes && fill()) continue;
    answer.body = buffer_.substr(0, bytes);
    buffer_.erase(0, bytes);
    return answer;
  }
  /// What arrived behind the last answer.
  std::string rest() { return std::exchange(buffer_, {}); }

 private:
  bool fill() {
    const auto bytes = pipe_.receive();
    buffer_.append(bytes.begin(), bytes.end());
    return !bytes.empty();
  }

  WebPipe pipe_;
  std::string host_;
  std::string buffer_;
};

inline const std::string websocket_fields =
    "Upgrade: websocket\r\nConnection: keep-alive, Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// The protocol by a WebSocket.
class WebSocketClient {
 public:
  explicit WebSocketClient(const Route& route, const std::string& fields = "",
                           const std::shared_ptr<const TlsClientContext>& tls = nullptr,
                           int receive_buffer_bytes = 0, const std::string& target = "/session")
      : http_(route, tls, receive_buffer_bytes), handshake_(http_.get(target, websocket_fields + fields)) {
    arrived(http_.rest());
  }

  const HttpAnswer& handshake() const { return handshake_; }
  bool open() const { return handshake_.status == 101; }
  WebPipe& pipe() { return http_.pipe(); }
  /// Code of the server's close; 0: none came.
  uint16_t close_code() const { return close_code_; }
  size_t pongs() const { return pongs_; }

  bool send_frame(std::span<const uint8_t> payload, const FrameShape& shape = {}) {
    return pipe().send(websocket_frame(payload, shape));
  }
  bool send(const ClientMessage& message) { return send_frame(encode(message)); }

  /// Nothing at the end of the stream.
  std::optional<ServerMessage> receive() {
    for (;;) {
      const auto message = reader_.next();
      if (!message) return std::nullopt;
      if (message->has_value()) {
        auto decoded = decode_server(**message);
        return decoded ? std::optional(std::move(*decoded)) : std::nullopt;
      }
      if (!fill()) return std::nullopt;
    }
  }
  template <typename T>
  std::optional<T> receive_as() {
    while (auto message = receive())
      if (T* wanted = std::get_if<T>(&*message)) return std::move(*wanted);
    return std::nullopt;
  }
  /// Reads on until the server ends the connection.
  bool ends() {
    while (fill()) continue;
    return pipe().ends();
  }
  bool fill() {
    const auto bytes = pipe().receive();
    arrived({bytes.begin(), bytes.end()});
    return !bytes.empty();
  }

 private:
  void arrived(const std::string& bytes) {
    buffer_ += bytes;
    const auto at = [&](size_t i) { return static_cast<uint8_t>(buffer_[i]); };
    for (;;) {
      if (buffer_.size() < 2) return;
      EXPECT_EQ(at(1) & 0x80U, 0U) << "a server masks nothing";
      const size_t short_length = at(1) & 0x7fU;
      const size_t length_bytes = short_length == 126 ? 2 : short_length == 127 ? 8 : 0;
      if (buffer_.size() < 2 + length_bytes) return;
      size_t length = length_bytes == 0 ? short_length : 0;
      for (size_t i = 0; i < length_bytes; ++i) length = length << 8U | at(2 + i);
      if (buffer_.size() < 2 + length_bytes + length) return;
      receive_frame(at(0) & 0xfU, std::span(reinterpret_cast<const uint8_t*>(buffer_.data()), buffer_.size())
                                      .subspan(2 + length_bytes, length));
      buffer_.erase(0, 2 + length_bytes + length);
    }
  }
  void receive_frame(unsigned opcode, std::span<const uint8_t> payload) {
    if (opcode == 2) reader_.push(payload);
    if (opcode == 10) ++pongs_;
    if (opcode == 8 && payload.size() >= 2)
      close_code_ = static_cast<uint16_t>(payload[0] << 8U | payload[1]);
  }

  HttpClient http_;
  HttpAnswer handshake_;
  std::string buffer_;
  FrameReader reader_;
  uint16_t close_code_ = 0;
  size_t pongs_ = 0;
};

}  // namespace scree
