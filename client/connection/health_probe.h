// Asks a server for its health, without joining. Safe to call from any thread.
#pragma once

#include <chrono>

#include "client/connection/endpoint.h"
#include "proto/health.h"
#include "shared/base/result.h"

namespace scree {

/// The error names the address, and why there is no answer: a server of an earlier release refuses.
Result<HealthMessage> ask_health(const ServerEndpoint& server, std::chrono::milliseconds within);

}  // namespace scree
