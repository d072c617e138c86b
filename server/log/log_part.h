// The parts of a server that its log tells of, and how much a line matters.
#pragma once

#include <cstdint>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

enum class LogPart : uint8_t { app, world, content, net, web, admin, chat, store, replay, rules, bus };

struct LogPartRow {
  std::string_view name;
  std::string_view what;  ///< for the help
};

constexpr LogPartRow row_of(LogPart part) {
  switch (part) {
    case LogPart::app:
      return {"app", "start, options and end"};
    case LogPart::world:
      return {"world", "ticks: late ones, and the work that they may do"};
    case LogPart::content:
      return {"content", "materials, images and models"};
    case LogPart::net:
      return {"net", "connections and sessions"};
    case LogPart::web:
      return {"web", "HTTP"};
    case LogPart::admin:
      return {"admin", "what administrators do; bans; open doors"};
    case LogPart::chat:
      return {"chat", "lines that people say"};
    case LogPart::store:
      return {"store", "the world's file, recordings and events"};
    case LogPart::replay:
      return {"replay", "a recording that is played"};
    case LogPart::rules:
      return {"rules", "rules of a game"};
    case LogPart::bus:
      return {"bus", "NATS: a world that is told, and edges"};
  }
  return {};
}

/// From the lowest on; `off` is above all.
enum class LogLevel : uint8_t { trace, debug, info, warn, error, off };

struct LogLevelRow {
  std::string_view name;
};

constexpr LogLevelRow row_of(LogLevel level) {
  switch (level) {
    case LogLevel::trace:
      return {"trace"};
    case LogLevel::debug:
      return {"debug"};
    case LogLevel::info:
      return {"info"};
    case LogLevel::warn:
      return {"warn"};
    case LogLevel::error:
      return {"error"};
    case LogLevel::off:
      return {"off"};
  }
  return {};
}

}  // namespace scree
