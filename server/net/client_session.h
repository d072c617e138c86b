// One client's connection. Used by NetHost only. All calls are on the network thread, but for backlog() and
// send_now(), which another one may call while the network thread waits for it.
//
// Phases: hello (waits for it) → joined → refused (the reason is being sent, input is ignored) → closed. A
// connection that asks for health alone is answered, and then treated as a refused one.
// The bytes that wait for the client are bounded: the publisher sends less and stops long before
// limits::outbox_hard_bytes, where the client is cut off.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "proto/frame_reader.h"
#include "proto/limits.h"
#include "proto/messages.h"
#include "server/command/refusal.h"
#include "server/doors/crowd.h"
#include "server/net/reading_pace.h"
#include "server/publish/encode_cache.h"
#include "server/publish/publisher.h"
#include "shared/base/rate_limit.h"
#include "shared/base/timing.h"
#include "transport/limits.h"
#include "transport/transport.h"

namespace scree {

class ClientSession;

/// The owner of the sessions, which handles their events.
class SessionHost {
 public:
  virtual ~SessionHost() = default;
  /// Handles the first message. Returns the welcome to send, or the reason of a refusal.
  virtual tl::expected<WelcomeMessage, Refused> admit(ClientSession& session, const HelloMessage& hello) = 0;
  /// The answer to a connection whose first message asks for nothing else.
  virtual HealthMessage health() = 0;
  /// Handles any later message. An error is sent as a refusal, and ends the session.
  virtual tl::expected<void, Refused> receive(ClientSession& session, const ClientMessage& message) = 0;
  virtual void refused(ClientSession& session, const Refused& refused) = 0;
  /// Counts what is queued for a client, with the length in front, and what came from one, without.
  virtual void count_out(std::span<const uint8_t> /*bytes*/) {}
  virtual void count_in(std::span<const uint8_t> /*body*/) {}
  /// The last call for this session.
  virtual void closed(ClientSession& session, const std::string& reason) = 0;
};

struct SessionTimes {
  double hello_s = 0.0;
  double stall_s = 0.0;
  double linger_s = 0.0;
  std::function<double()> now_s = steady_now_s;
};

class ClientSession : public std::enable_shared_from_this<ClientSession> {
 public:
  enum class Phase { hello, joined, refused, closed };

  ClientSession(std::shared_ptr<Transport> transport, std::string address, uint64_t id, SessionHost& host,
                const SessionTimes& times, double now_s);

  void start();
  void send(SharedBytes bytes);
  /// As send(), but what is queued goes with the next send(), or with send_now() and settle().
  void queue(SharedBytes bytes);
  /// Sends of what is queued what the link takes at once. Calls nobody else, and touches nothing but this
  /// session. settle() must follow before any other call.
  void send_now();
  /// Notes that it waits for its turn to be sent what is queued (FlushQueue), until flushed(). Returns
  /// whether it waited already.
  bool wait_for_flush() { return std::exchange(waits_for_flush_, true); }
  void flushed() { waits_for_flush_ = false; }
  /// Sends the rest as the link takes it. Cuts the client off if that is too much.
  void settle();
  void send(const ServerMessage& message);
  /// Closes at once, and is counted by this reason.
  void disconnect(Refusal reason, const std::string& words);
  /// Sends the reason, and closes when the client has read it or limits::linger_seconds_max are over.
  void refuse(const Refused& refused);
  /// Closes at once.
  void close(const std::string& reason);
  /// It is over, and nobody is told: its connection goes on as something else's.
  void give_up_connection();
  /// Closes at once: the client has said goodbye, and does not go on.
  void leave();
  /// Ends the session if the client sent no hello, or has not read, for too long. Call a few times a second.
  void check_time(double now_s);

  uint64_t id() const { return id_; }
  /// The door does not let it in: whatever it sends first is answered by this reason, and a silence of
  /// limits::turned_away_seconds_max is. Before the hello.
  void turn_away(const Refused& refused) { turned_away_ = refused; }
  const std::optional<Refused>& turned_away() const { return turned_away_; }
  /// It asked for the server's health, and for nothing else.
  bool only_asked() const { return only_asked_; }
  /// Its proxy has said for whom it speaks; `address` as of Door.
  void come_from(const std::string& address, const std::string& peer) {
    address_ = address;
    origin_ = Origin(address);
    peer_ = peer;
  }
  /// It goes on as another session, which has no connection any more.
  void continue_as(uint64_t id) { id_ = id; }
  Phase phase() const { return phase_; }
  const std::string& peer() const { return peer_; }
  /// As of Door.
  const std::string& address() const { return address_; }
  const Origin& origin() const { return origin_; }
  /// Whether none of its bytes has come yet.
  bool is_silent() const { return !heard_ && !transport_->encrypted(); }
  /// The IP address.
  const std::string& ip() const { return transport_->address(); }
  /// Seconds since it did anything but apply frames.
  double idle_s(double now_s) const { return now_s - acted_s_; }
  /// Whether it has been idle so long that another may have its place (limits::idle_seconds_max,
  /// inert_seconds_max).
  bool may_make_room(double now_s) const;
  bool encrypted() const { return transport_->encrypted(); }
  /// Handed to the transport.
  uint64_t sent_bytes() const { return sent_bytes_; }
  size_t backlog_bytes() const { return backlog_bytes_; }
  /// All that was sent, or waits; of a closed session, what was sent.
  uint64_t queued_bytes() const { return sent_bytes_ + backlog_bytes_; }
  /// For a slow client it includes the bytes that its socket has taken and not sent; a fast one's are soon
  /// gone.
  Backlog backlog() const {
    Backlog backlog{backlog_bytes_, pace_.bytes_max()};
    if (backlog.is_slow()) backlog.bytes += transport_->unsent_bytes();
    return backlog;
  }
  /// Why it was cut off, if it was.
  std::optional<Refusal> disconnect_reason() const { return disconnect_reason_; }
  /// For a closed session: whether it had joined, was not refused and did not leave, and whether its
  /// connection ended by itself, in order or not, rather than by the server.
  bool may_go_on() const { return may_go_on_; }
  bool was_lost() const { return was_lost_; }

 private:
  void read();
  void read_done(size_t bytes);
  void read_failed(const StreamEnd& end);
  bool receive_message(std::span<const uint8_t> body);
  bool receive_first(const ClientMessage& message);
  void end_with(const ServerMessage& last);
  void write();
  void write_done(size_t bytes);
  void count_sent(size_t bytes);
  struct Gathered {
    std::array<std::span<const uint8_t>, limits::gathered_buffers_max> buffers;
    size_t count = 0;
    size_t bytes = 0;
    Transport::Buffers all() const { return std::span(buffers).first(count); }
  };
  /// The next bytes to send, as many as the client's link takes soon.
  Gathered gather() const;
  void finish_sending();
  /// False when it is closed, or was cut off for too long a backlog.
  bool has_acceptable_backlog();
  /// Whether backlog_bytes_ is the rest of the outbox's bytes; for CHECK_DEBUG.
  bool backlog_adds_up() const;

  std::shared_ptr<Transport> transport_;
  uint64_t id_;
  SessionHost& host_;
  SessionTimes times_;
  std::string peer_;
  std::string address_;
  Origin origin_;
  Phase phase_ = Phase::hello;
  std::optional<Refusal> disconnect_reason_;
  std::optional<Refused> turned_away_;
  double phase_since_s_;
  double progress_s_;  ///< the last time at which the client read something, or had nothing to read
  double now_s_;
  double acted_s_;
  bool heard_ = false;
  bool inert_ = true;  ///< it has sent nothing but its hello
  RateLimit messages_;
  RateLimit bytes_;
  FrameReader reader_{limits::hello_bytes_max};
  std::array<uint8_t, 16384> incoming_{};
  std::deque<SharedBytes> outbox_;
  size_t front_sent_bytes_ = 0;  ///< sent bytes of the first message in the outbox
  size_t backlog_bytes_ = 0;     ///< bytes in the outbox that are not sent
  uint64_t sent_bytes_ = 0;
  ReadingPace pace_;
  size_t offered_bytes_ = 0;  ///< by the write under way
  double offered_s_ = 0.0;
  bool writing_ = false;
  bool waits_for_flush_ = false;
  bool only_asked_ = false;
  bool peer_ended_ = false;  ///< the client closed its sending side
  bool left_ = false;
  bool may_go_on_ = false;
  bool was_lost_ = false;
};

}  // namespace scree
