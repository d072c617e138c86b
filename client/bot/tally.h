// The bookkeeping of what arrives: bytes by kind, and what each operation cost.
#pragma once

#include "client/bot/report.h"
#include "client/connection/connection.h"

namespace scree {

/// Counts one message, before or after it is applied.
void tally(const Received& received, BotReport& report);

}  // namespace scree
