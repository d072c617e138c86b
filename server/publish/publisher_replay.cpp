// Publisher's part of replays: where one stands, its events, and who was there.
#include "proto/codec.h"
#include "server/publish/publisher.h"

namespace scree {

void Publisher::set_control_refusal(uint64_t session, const std::string& refusal) {
  const auto client = clients_.find(session);
  if (client != clients_.end()) client->second.control_refusal = refusal;
}

/// Who reads slowly gets events and cursors when it has caught up.
void Publisher::send_replay(Client& client, const TickDelta& delta, bool reads_along, Part& part) {
  send_playback(client, *delta.playback, delta.tick, part);
  if (!reads_along) return;
  if (delta.marks != nullptr && delta.marks != client.marks) {
    send(client, share(client.marks ? news_since(*client.marks, *delta.marks) : *delta.marks), part);
    client.marks = delta.marks;
  }
  if (delta.cursors != nullptr && delta.cursors != client.recorded_cursors) {
    const bool is_news = client.recorded_cursors || !delta.cursors->cursors.empty();
    if (is_news) send(client, share(*delta.cursors), part);
    client.recorded_cursors = delta.cursors;
  }
}

/// The moment's own pace is no news.
void Publisher::send_playback(Client& client, const PlaybackMessage& now, Tick tick, Part& part) {
  PlaybackMessage told = now;
  told.refusal = client.control_refusal;
  if (client.playback && !status_due(client, tick)) {
    PlaybackMessage known = *client.playback;
    known.moment = told.moment;
    known.last = told.last;
    if (known == told) return;
  }
  client.playback = told;
  send(client, share(told), part);
}

}  // namespace scree
