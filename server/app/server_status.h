// status.json, what operators see of a running server in a browser (docs/browser.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/app/server_report.h"

namespace scree {

/// What does not change while a server runs.
struct ServerFacts {
  uint32_t tick_rate_hz = 0;
  bool replay = false;
  std::shared_ptr<const Palette> palette{};  ///< not null
};

std::string status_json(const ServerReport& report, const NetFigures& figures, const ServerFacts& facts);

}  // namespace scree
