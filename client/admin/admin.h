// A client that reads a running server's status and settings, and changes settings. Each function makes one
// connection that follows no terrain, and waits for the server's answers. Safe to call from any thread.
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
/// The status as JSON, or as lines of a name and a value.
std::string status_json(const StatusMessage& status);
std::string status_lines(const StatusMessage& status);

/// All current settings. Needs no token.
Result<SettingValues> read_settings(const AdminServer& server);

/// Changes all these settings or none, and returns all current settings. The error is the server's refusal.
Result<SettingValues> change_settings(const AdminServer& server, const std::string& token,
                                      const SettingValues& changes);

}  // namespace scree
