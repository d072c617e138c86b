// What keeps the newest lines (recent_lines.h): one for the process. Internal to server/log.
#pragma once

#include <spdlog/sinks/sink.h>

namespace scree {

spdlog::sink_ptr recent_sink();

}  // namespace scree
