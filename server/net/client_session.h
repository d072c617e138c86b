// One client's connection. Used by net_server.cpp only (Asio); everything happens on the network thread.
//
// waiting for hello → joined → refused (a reason is on its way; what still comes in is thrown away) → closed.
// The bytes that wait for the client are bounded: the publisher slows down and stops long before
// limits::outbox_hard_bytes, where the client is cut off.
#pragma once

#include <array>
#include <asio/ip/tcp.hpp>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "proto/frame_reader.h"
#include "proto/messages.h"
#include "server/net/encode_cache.h"
#include "server/net/rate_limit.h"

namespace scree {

class ClientSession;

/// Who owns the sessions, and hears from them.
class SessionHost {
 public:
  virtual ~SessionHost() = default;
  /// The first message. What it returns is sent: the welcome, or why the client is refused.
  virtual Result<WelcomeMessage> admit(ClientSession& session, const HelloMessage& hello) = 0;
  /// Any later message but a hello. An error is sent as a refusal, and ends the session.
  virtual Result<void> receive(ClientSession& session, const ClientMessage& message) = 0;
  virtual void refused(ClientSession& session, const std::string& reason) = 0;
  /// The last call for this session.
  virtual void closed(ClientSession& session, const std::string& reason) = 0;
};

struct SessionTimes {
  double hello_s = 0.0;
  double stall_s = 0.0;
  double linger_s = 0.0;
};

class ClientSession : public std::enable_shared_from_this<ClientSession> {
 public:
  enum class Phase { hello, joined, refused, closed };

  ClientSession(asio::ip::tcp::socket socket, uint64_t id, SessionHost& host, const SessionTimes& times,
                double now_s);

  void start();
  void send(SharedBytes bytes);
  void send(const ServerMessage& message);
  /// Sends the reason, and closes once the client has had the time to read it.
  void refuse(const std::string& reason);
  /// Closes at once.
  void close(const std::string& reason);
  /// Called a few times a second: ends what has been silent, or has not read, for too long.
  void check_time(double now_s);

  uint64_t id() const { return id_; }
  Phase phase() const { return phase_; }
  const std::string& peer() const { return peer_; }
  size_t backlog_bytes() const { return backlog_bytes_; }
  /// Whether it was closed because it did not read.
  bool was_cut() const { return was_cut_; }

 private:
  void read();
  void read_done(size_t bytes);
  void read_failed(bool orderly, const std::string& why);
  bool take_message(std::span<const uint8_t> body);
  void write();
  void write_done(size_t bytes);
  void finish_sending();

  asio::ip::tcp::socket socket_;
  uint64_t id_;
  SessionHost& host_;
  SessionTimes times_;
  std::string peer_;
  Phase phase_ = Phase::hello;
  bool was_cut_ = false;
  double phase_since_s_;
  double progress_s_;  ///< when the client last read something, or had nothing to read
  double now_s_;
  RateLimit messages_;
  FrameReader reader_;
  std::array<uint8_t, 16384> incoming_{};
  std::deque<SharedBytes> outbox_;
  size_t front_sent_bytes_ = 0;  ///< of the first in the outbox
  size_t backlog_bytes_ = 0;
  bool writing_ = false;
  bool peer_ended_ = false;  ///< it sends nothing any more
};

}  // namespace scree
