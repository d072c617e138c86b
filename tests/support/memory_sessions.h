// Sessions over streams without sockets, in a table, and an owner that admits everybody.
#pragma once

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>

#include "proto/codec.h"
#include "server/net/session_table.h"
#include "tests/fuzz/support/memory_transport.h"

namespace scree {

class MemorySessions final : public SessionHost {
 public:
  MemorySessions() = default;
  MemorySessions(const MemorySessions&) = delete;
  MemorySessions& operator=(const MemorySessions&) = delete;
  /// What a link waits for holds its session, and the session holds the link.
  ~MemorySessions() {
    for (const auto& [id, link] : links) link->close();
  }

  /// A session that has said nothing.
  std::shared_ptr<ClientSession> connect(uint64_t id, const std::string& ip) {
    links[id] = std::make_shared<MemoryTransport>(ip);
    SessionTimes times{100.0, 100.0, 100.0};
    times.now_s = [this] { return now_s; };
    const auto session =
        std::make_shared<ClientSession>(links[id], door_address(ip), id, *this, times, now_s);
    table.add(session, false);
    session->start();
    return session;
  }
  /// A session that has joined, with this grant.
  std::shared_ptr<ClientSession> join(uint64_t id, const std::string& ip, const Grant& grant = {}) {
    const auto session = connect(id, ip);
    links[id]->send(encode(ClientMessage(HelloMessage{protocol_version, "test"})));
    pump(id);
    EXPECT_EQ(session->phase(), ClientSession::Phase::joined);
    table.at(id).grant = grant;
    return session;
  }
  /// Moves the bytes of a link until none move.
  void pump(uint64_t id) {
    while (links[id]->pump()) {
    }
  }

  tl::expected<WelcomeMessage, Refused> admit(ClientSession& session, const HelloMessage&) override {
    table.join(session, session.id());
    return WelcomeMessage{};
  }
  HealthMessage health() override { return {}; }
  tl::expected<void, Refused> receive(ClientSession&, const ClientMessage&) override { return {}; }
  void refused(ClientSession& session, const Refused& refused) override {
    reasons[session.id()] = refused.reason;
    table.refuse(session.id());
  }
  void closed(ClientSession& session, const std::string&) override {
    if (on_closed) on_closed(table.at(session.id()));
    table.erase(session.id());
  }

  double now_s = 1000.0;
  SessionTable table{30.0};
  std::map<uint64_t, std::shared_ptr<MemoryTransport>> links;
  std::map<uint64_t, Refusal> reasons;  ///< by session
  std::function<void(const SessionEntry&)> on_closed;
};

}  // namespace scree
