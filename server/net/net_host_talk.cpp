// NetHost's part of what persons are told of each other.
#include "server/net/net_host.h"
#include "shared/base/timing.h"

namespace scree {
/// Who reads slowly is told later, when he has caught up.
void NetHost::tell_persons(double now_s) {
  const std::vector<uint64_t> sessions = talk_.untold(now_s);
  if (sessions.empty()) return;
  const SharedBytes list = share(talk_.list());
  for (const uint64_t id : sessions) {
    ClientSession& session = *sessions_.at(id).session;
    if (!session.backlog().reads_along()) continue;
    talk_.told(id, now_s);
    session.send(list);
  }
}

/// Who reads slowly misses a line.
void NetHost::hear(ClientSession& speaker, const SayMessage& said) {
  const std::optional<Talk::Heard> heard = talk_.say(speaker.id(), said.text, steady_now_s());
  if (!heard) return;
  const SharedBytes line = share(heard->line);
  if (!heard->by_all) return speaker.send(line);
  for (const uint64_t id : talk_.everybody()) {
    const auto session = sessions_.at(id).session;
    if (session->backlog().reads_along()) session->send(line);
  }
}

}  // namespace scree
