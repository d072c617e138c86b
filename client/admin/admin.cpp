#include "client/admin/admin.h"

#include "client/connection/connection.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds wait_step{50};

class Talk {
 public:
  Talk(std::unique_ptr<Connection> connection, Clock::time_point until)
      : connection_(std::move(connection)), until_(until) {}

  void send(const ClientMessage& message) { connection_->send(message); }

  /// The next message of one kind; skips others.
  template <typename T>
  Result<T> next(const char* what) {
    for (;;) {
      while (at_ < received_.size()) {
        const ServerMessage& message = received_[at_++].message;
        if (const T* wanted = std::get_if<T>(&message)) return *wanted;
      }
      // Read before the last messages are taken: no message can come after the end.
      const bool open = connection_->connected();
      received_ = connection_->wait(wait_step);
      at_ = 0;
      if (!received_.empty()) continue;
      if (!open) return fail(connection_->close_reason());
      if (Clock::now() > until_)
        return fail(std::string("no ") + what + " came in time: does the server tick?");
    }
  }

 private:
  std::unique_ptr<Connection> connection_;
  Clock::time_point until_;
  std::vector<Received> received_;
  size_t at_ = 0;
};

Result<Talk> join(const AdminServer& server) {
  const Clock::time_point until = Clock::now() + server.within;
  HelloMessage hello;
  hello.client = "scree-admin";
  auto connected = Connection::connect(server.host, server.port, hello, server.within);
  if (!connected) return tl::unexpected(connected.error());
  return Talk(std::move(*connected), until);
}

Result<StatusMessage> status_of(Talk& talk) {
  return talk.next<StatusMessage>("status");
}

Result<SettingValues> settings_of_status(Talk& talk) {
  Result<StatusMessage> status = status_of(talk);
  if (!status) return tl::unexpected(status.error());
  return std::move(status->settings);
}

}  // namespace

Result<StatusMessage> read_status(const AdminServer& server) {
  Result<Talk> talk = join(server);
  if (!talk) return tl::unexpected(talk.error());
  return status_of(*talk);
}

Result<SettingValues> read_settings(const AdminServer& server) {
  Result<Talk> talk = join(server);
  if (!talk) return tl::unexpected(talk.error());
  return settings_of_status(*talk);
}

Result<SettingValues> change_settings(const AdminServer& server, const std::string& token,
                                      const SettingValues& changes) {
  Result<Talk> talk = join(server);
  if (!talk) return tl::unexpected(talk.error());
  talk->send(AdminMessage{1, token, changes});
  const Result<ReplyMessage> reply = talk->next<ReplyMessage>("reply");
  if (!reply) return tl::unexpected(reply.error());
  if (!reply->refusal.empty()) return fail(reply->refusal);
  // A reply follows its own tick's messages, so the next status is of a later one.
  return settings_of_status(*talk);
}

}  // namespace scree
