#include "server/formats/world_game.h"

#include "server/formats/region_list.h"

namespace scree {

void write_world_game(kept::Moment& to, const GameValue& from) {
  for (const KeptValue& one : *from.kept) {
    wire::KeptValue& added = *to.add_kept();
    added.set_key(one.key);
    added.set_value(one.value);
  }
  if (!from.signs->empty()) to.set_signs(pack_signs(*from.signs));
  for (const Player& player : *from.players) {
    wire::SetPlayer& added = *to.add_players();
    added.set_session(player.session);
    added.set_team(player.team);
    added.set_pace(player.pace);
  }
}

GameValue read_world_game(const kept::Moment& from, FieldChecker& check) {
  GameValue game;
  if (static_cast<size_t>(from.kept_size()) > limits::kept_values_max ||
      static_cast<size_t>(from.players_size()) > limits::players_max) {
    check.refuse("rules keep more values, or made something of more persons, than a world has");
    return game;
  }
  std::vector<KeptValue> kept;
  for (const wire::KeptValue& one : from.kept()) kept.push_back({one.key(), one.value()});
  game.kept = std::make_shared<const std::vector<KeptValue>>(std::move(kept));
  if (from.has_signs())
    game.signs = std::make_shared<const std::vector<Sign>>(unpack_signs(from.signs(), check));
  std::vector<Player> players;
  for (const wire::SetPlayer& one : from.players())
    players.push_back({one.session(), one.team(), check.not_negative(one.pace(), "pace of a person")});
  game.players = std::make_shared<const std::vector<Player>>(std::move(players));
  return game;
}

}  // namespace scree
