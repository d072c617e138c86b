#include "server/net/talk_delivery.h"

#include <optional>
#include <vector>

#include "server/log/log.h"

namespace scree {

void send_persons(Talk& talk, const SessionTable& sessions, double now_s) {
  const std::vector<uint64_t> untold = talk.untold(now_s);
  if (untold.empty()) return;
  const SharedBytes list = share(talk.list());
  for (const uint64_t id : untold) {
    ClientSession& session = *sessions.at(id).session;
    if (!session.backlog().reads_along()) continue;
    talk.told(id, now_s);
    session.send(list);
  }
}

void pass_on(const SayMessage& said, ClientSession& speaker, Talk& talk, const SessionTable& sessions,
             double now_s, const LineListeners& listeners) {
  const std::optional<Talk::Heard> heard = talk.say(speaker.id(), said.text, now_s);
  if (!heard) return;
  if (heard->by_all && listeners.hook && !listeners.hook(heard->line)) return;
  if (heard->by_all && listeners.log)
    log_of(LogPart::chat, speaker.id())
        .info("session {} ({}) says: {}", speaker.id(), heard->line.name, heard->line.text);
  const SharedBytes line = share(heard->line);
  if (!heard->by_all) return speaker.send(line);
  for (const uint64_t id : talk.everybody()) {
    const auto session = sessions.at(id).session;
    if (session->backlog().reads_along()) session->send(line);
  }
}

}  // namespace scree
