#include "server/publish/game_stream.h"

#include <algorithm>

#include "server/publish/limits.h"

namespace scree {

std::string GameStream::team(const ServedTick& tick, uint64_t session) const {
  const auto& players = *tick.changes.state.players();
  const auto at = std::ranges::lower_bound(players, session, {}, &Player::session);
  const bool has_team = at != players.end() && at->session == session && !at->team.empty();
  return has_team ? at->team : team_of_token_;
}

void GameStream::serve(const ServedTick& tick, Outlet& outlet, ServedPart& part) {
  const auto& notices = tick.changes.delta.notices;
  const auto& signs = tick.changes.state.signs();
  const auto& players = tick.changes.state.players();
  const bool are_other = signs != seen_ || (players != seen_players_ && !signs->empty());
  if (notices.empty() && !are_other) return;
  const uint64_t session = outlet.session();
  const std::string own_team = team(tick, session);
  CuesMessage cues{tick.tick(), {}};
  for (const Notice& notice : notices) {
    if (!is_meant(notice.to, session, own_team)) continue;
    // A replay that plays fast has the notices of several ticks in one.
    if (const auto* const cue = std::get_if<Cue>(&notice.what);
        cue != nullptr && cues.cues.size() < limits::notices_a_tick_max)
      cues.cues.push_back(*cue);
    if (const auto* const data = std::get_if<ChannelData>(&notice.what))
      outlet.send(share(ChannelMessage{*data}), part);
    if (const auto* const line = std::get_if<NoticeLine>(&notice.what); line != nullptr && meets_)
      outlet.send(share(SaidMessage{0, "", line->text}), part);
  }
  if (!cues.cues.empty()) outlet.send(share(cues), part);
  const Tick wait = tick.rates.ticks_of(limits::signs_wait_s);
  if (!are_other || outlet.room_bytes() <= 0 || (told_at_ != 0 && tick.tick() < told_at_ + wait)) return;
  seen_ = signs;
  seen_players_ = players;
  std::vector<Sign> own;
  for (const Sign& sign : *signs)
    if (is_meant(sign.to, session, own_team)) own.push_back(sign);
  if (own == told_) return;
  told_ = own;
  told_at_ = tick.tick();
  outlet.send(share(SignsMessage{std::move(own)}), part);
}

}  // namespace scree
