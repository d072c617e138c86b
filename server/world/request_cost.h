// What a request cost that was carried out, for reports: the clock decides nothing.
#pragma once

#include "server/command/command.h"
#include "server/world/tick_delta.h"

namespace scree {

RequestCost cost_of(const Command& command, float price_us, double clock_ms);

}  // namespace scree
