// A client that looks at how a running server stands, and at its settings, and changes them. Each function is
// one connection, that follows no terrain. Waits for the server's answers; safe to call from any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "proto/messages.h"
#include "shared/base/result.h"

namespace scree {

struct AdminServer {
  std::string host = "127.0.0.1";
  uint16_t port = default_port;
  std::chrono::milliseconds within{10000};  ///< all of the server's answers
};

/// The server's next status, settings included. Needs no token.
Result<StatusMessage> read_status(const AdminServer& server);
/// What people read of it, as JSON or as lines of a name and a value.
std::string status_json(const StatusMessage& status);
std::string status_lines(const StatusMessage& status);

/// Every setting as it stands. Needs no token.
Result<SettingValues> read_settings(const AdminServer& server);

/// Changes them, all or none, and says how every setting stands then. The error is the server's own words.
Result<SettingValues> change_settings(const AdminServer& server, const std::string& token,
                                      const SettingValues& changes);

}  // namespace scree
