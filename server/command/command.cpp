#include "server/command/command.h"

namespace scree {

std::string refusal_name(const Reply& reply) {
  if (!reply.host_name.empty()) return "game:" + reply.host_name;
  return reply.reason ? std::string(name_of(*reply.reason)) : std::string();
}

}  // namespace scree
