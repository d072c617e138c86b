// Counts received messages: bytes by kind, and bytes of each operation.
#pragma once

#include "client/bot/report.h"
#include "client/connection/connection.h"

namespace scree {

/// Counts one message, before or after it is applied.
void tally(const Received& received, BotReport& report);

}  // namespace scree
