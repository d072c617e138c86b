// What one client is told of a game: its signs, and notices that are meant for it (proto/game.proto).
#pragma once

#include <string>

#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class GameStream {
 public:
  /// `team`: that of the access token. `meets`: lines are wanted (HelloMessage::meets).
  void set_own(std::string team, bool meets) {
    team_of_token_ = std::move(team);
    meets_ = meets;
  }
  /// The signs, where they are others than the client has, not oftener than limits::signs_wait_s; and the
  /// tick's notices.
  void serve(const ServedTick& tick, Outlet& outlet, ServedPart& part);
  /// The client has no signs any more.
  void forget() { told_.clear(); }

 private:
  std::string team(const ServedTick& tick, uint64_t session) const;

  std::string team_of_token_;
  bool meets_ = false;
  std::vector<Sign> told_;  ///< as the client has them
  /// The lists that the client's signs were chosen from.
  std::shared_ptr<const std::vector<Sign>> seen_;
  std::shared_ptr<const std::vector<Player>> seen_players_;
  Tick told_at_ = 0;
};

}  // namespace scree
