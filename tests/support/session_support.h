// A whole server in this process, stepped by hand, and clients on loopback as users run them. In step: after
// step() every client has applied the tick. Every wait has a deadline.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/session/client.h"
#include "server/app/live_server.h"
#include "shared/field/chunk_distance.h"

namespace scree {

/// The request as a client sends it.
CarveMessage carve_message(const CarveRequest& carve, uint32_t request);

class SessionClient {
 public:
  /// Joins; on failure, `failure` has the reason.
  SessionClient(uint16_t port, glm::vec3 eye_m, float radius_m);

  /// Applies messages up to the frame of `tick`; false, and a failure, when it does not come.
  bool follow_to(Tick tick);
  void send(const ClientMessage& message) { client_.send(message); }
  void set_eye(glm::vec3 eye_m) { client_.follow(eye_m, client_.radius_m()); }
  /// Ends the connection like a lost link: messages on their way are lost.
  void abort();

  Mirror& mirror() { return *client_.mirror(); }
  const Client& client() const { return client_; }

  std::string failure;                       ///< empty: no failure
  std::map<uint32_t, ReplyMessage> replies;  ///< by request

 private:
  /// Notes an event, before which the mirror was at tick `before`.
  void note(const Client::Event& event, Tick before);

  Client client_;
};

class LoopbackSession {
 public:
  /// Port and pacing are filled in. `failure` when the server does not start.
  explicit LoopbackSession(LiveConfig config);

  SessionClient& join(glm::vec3 eye_m, float radius_m);
  /// Cuts a client off, and waits until the server has noticed.
  void abort(const SessionClient& client);

  /// Runs one tick, which every client applies; false, with a failure, when one does not.
  bool step();
  bool steps(int count);
  /// Steps until no piece is alive and nothing changed for a second; false when it takes a minute.
  bool settle();
  /// Steps until the client has the reply; null, and a failure, when it does not come.
  const ReplyMessage* ask(SessionClient& client, const CarveMessage& carve);

  LiveServer& server() { return *server_; }
  const Field& field() { return server_->world()->field(); }
  Tick tick() const { return tick_; }
  const std::vector<std::unique_ptr<SessionClient>>& clients() const { return clients_; }

  std::string failure;

 private:
  std::unique_ptr<LiveServer> server_;
  std::vector<std::unique_ptr<SessionClient>> clients_;
  Tick tick_ = 0;
};

}  // namespace scree
