// The network side's lines for the log: of each kind a few a second. On the network thread.
#pragma once

#include <string>
#include <string_view>

#include "server/doors/access.h"
#include "server/log/log.h"
#include "shared/base/log_limit.h"
#include "shared/base/timing.h"

namespace scree {

class HostLog {
 public:
  void say(const PartLog& log, LogLevel level, std::string_view kind, const std::string& line) {
    if (const auto more = limit_.admit(kind, steady_now_s())) log.write(level, line + *more);
  }

 private:
  LogLimit limit_;
};

/// Logs the server's certificate, if it has one.
void log_access(const Access& access);

}  // namespace scree
