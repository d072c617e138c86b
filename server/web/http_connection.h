// One connection that speaks HTTP/1.1: requests one after the other, until one opens a WebSocket or the
// connection ends. All calls are on the network thread.
//
// Phases: head (waits for a request's head, or between two requests) → answering → head again, or lingering
// (the last answer is sent, input is ignored) → over. What it holds is bounded: a head, and files that all
// connections share. A file is sent as far as its host has room for it.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "server/web/http_request.h"
#include "server/web/http_response.h"
#include "transport/transport.h"

namespace scree {

class HttpConnection;

/// The owner of the connections, which handles their events.
class HttpHost {
 public:
  virtual ~HttpHost() = default;
  virtual HttpResponse answer(const HttpConnection& from, const HttpRequest& request) = 0;
  /// Bytes of a file that may be sent now; 0: it waits for go_on(). Other answers are small, and do not wait.
  virtual size_t file_room(const HttpConnection& connection) const = 0;
  /// These bytes of an answer were sent.
  virtual void sent(const HttpConnection& connection, size_t bytes) = 0;
  /// All of it was sent, the head included.
  virtual void answered(const HttpResponse& response, size_t bytes) = 0;
  /// The handshake of a WebSocket is over: the stream is the host's, with what was read of it already. The
  /// last call for this connection.
  virtual void opened_websocket(HttpConnection& from, std::shared_ptr<Transport> stream,
                                std::span<const uint8_t> arrived) = 0;
  /// Cut off for this reason, before ended().
  virtual void disconnect(const HttpConnection& connection, Refusal reason) = 0;
  /// The last call for this connection.
  virtual void ended(HttpConnection& connection) = 0;
};

struct HttpTimes {
  double head_s = 0.0;
  double idle_s = 0.0;
  double stall_s = 0.0;
  double linger_s = 0.0;
};

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(std::shared_ptr<Transport> stream, uint64_t id, HttpHost& host, const HttpTimes& times,
                 double now_s);

  /// `arrived`: what was read already.
  void start(std::span<const uint8_t> arrived);
  /// Ends what took too long. Call a few times a second.
  void check_time(double now_s);
  /// Closes at once.
  void close();
  /// Whether a file waits for room.
  bool waits() const { return waits_; }
  void go_on();

  uint64_t id() const { return id_; }
  /// The IP address.
  const std::string& ip() const { return stream_->address(); }
  bool encrypted() const { return stream_->encrypted(); }
  /// Between requests, or lingering: nobody waits for it.
  bool is_idle() const { return phase_ == Phase::lingering || (phase_ == Phase::head && !begun_); }

 private:
  enum class Phase { head, answering, lingering, over };

  void read();
  void read_done(size_t bytes);
  void parse_head();
  void respond(HttpResponse response, bool head_only, bool keep_alive);
  size_t sendable() const;
  void write();
  void written();
  void linger();
  void open_websocket();

  std::shared_ptr<Transport> stream_;
  uint64_t id_;
  HttpHost& host_;
  HttpTimes times_;
  Phase phase_ = Phase::head;
  double now_s_;
  double since_s_;     ///< of the phase; of a head its first byte; of an answer the last that was sent
  bool begun_ = true;  ///< a head has begun to arrive; the first one with the connection
  std::array<uint8_t, 4096> incoming_{};
  std::string buffer_;     ///< arrived and not answered
  size_t searched_ = 0;    ///< bytes in it without the end of a head
  size_t head_bytes_ = 0;  ///< of the request that is answered
  HttpResponse response_;
  std::string response_head_;
  bool head_only_ = false;
  bool keep_alive_ = false;
  size_t sent_ = 0;
  bool waits_ = false;
};

}  // namespace scree
