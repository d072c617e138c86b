#include "server/world/game_requests.h"

#include <string>

#include "server/world/person_requests.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

/// A value so long after all others, and a list of so many, do not fit.
CheckedRequest check_room(const World::State& state, const KeptValue& value) {
  const GameState& game = state.game;
  const KeptValue* const before = game.kept(value.key);
  const size_t freed = before == nullptr ? 0 : before->key.size() + before->value.size();
  const size_t bytes = game.kept_bytes() - freed + value.key.size() + value.value.size();
  if (bytes > limits::kept_bytes_max)
    return refuse(Refusal::rules_invalid, "rules keep " + std::to_string(limits::kept_bytes_max) +
                                              " bytes with a world at most, and this would make " +
                                              std::to_string(bytes) + " (limits.kept_bytes_max)");
  if (before != nullptr || game.value().kept->size() < limits::kept_values_max) return {};
  return refuse(Refusal::rules_invalid, "rules keep " + std::to_string(limits::kept_values_max) +
                                            " values with a world at most (limits.kept_values_max)");
}

CheckedRequest check_room(const World::State& state, const Sign& sign) {
  if (state.game.sign(sign.to, sign.name) != nullptr || state.game.value().signs->size() < limits::signs_max)
    return {};
  return refuse(Refusal::rules_invalid, "a world has " + std::to_string(limits::signs_max) +
                                            " signs at most (limits.signs_max): remove some");
}

tl::expected<void, Refused> as_refusal(const Result<void>& valid) {
  if (valid) return {};
  return refuse(Refusal::rules_invalid, valid.error().message);
}

Player player_after(const World::State& state, const SetPlayer& change) {
  const Player* const before = state.game.player(change.session);
  Player player = before != nullptr ? *before : Player{change.session};
  if (change.team) player.team = *change.team;
  if (change.pace) player.pace = *change.pace;
  return player;
}

CheckedRequest check_player(const World::State& state, const SetPlayer& change) {
  TRY(as_refusal(validate(player_after(state, change))));
  if (change.place_m) TRY(check(state, StandRequest{change.place_m}, change.session));
  if (state.game.player(change.session) != nullptr ||
      state.game.value().players->size() < limits::players_max)
    return {};
  return refuse(Refusal::rules_invalid, "the rules made something of " + std::to_string(limits::players_max) +
                                            " persons, and a world has no more (limits.players_max)");
}

void publish_players(const World::State& state, TickDelta& delta) {
  delta.players = state.game.value().players;
}

void set_player(World::State& state, const SetPlayer& change, TickDelta& delta) {
  state.game.set(player_after(state, change));
  if (change.place_m) perform(state, StandRequest{change.place_m}, change.session, 0, delta);
  publish_players(state, delta);
  const auto person = state.persons.find(change.session);
  const Player* const player = state.game.player(change.session);
  if (person != state.persons.end()) person->second.walker.pace = player != nullptr ? player->pace : 1.0F;
}

void publish_signs(const World::State& state, TickDelta& delta) {
  delta.signs = state.game.value().signs;
}

}  // namespace

CheckedRequest check(const World::State& state, const RulesRequest& request, uint64_t session) {
  if (session != 0)
    return refuse(Refusal::rules_invalid, "only the server's own rules do that (Rules of game.proto)");
  return std::visit(Overloaded{[&](const KeepValue& keep) -> CheckedRequest {
                                 TRY(as_refusal(validate(keep.value)));
                                 return check_room(state, keep.value);
                               },
                               [](const ForgetValue& forget) {
                                 return as_refusal(validate(KeptValue{forget.key, {}}));
                               },
                               [&](const ShowSign& show) -> CheckedRequest {
                                 TRY(as_refusal(validate(show.sign)));
                                 return check_room(state, show.sign);
                               },
                               [](const RemoveSign& remove) {
                                 return as_refusal(validate(Sign{.name = remove.name, .to = remove.to}));
                               },
                               [&](const SetPlayer& player) { return check_player(state, player); },
                               [](const Notice& notice) { return as_refusal(validate(notice)); }},
                    request.act);
}

Performed perform(World::State& state, const RulesRequest& request, TickDelta& delta) {
  if (std::holds_alternative<Notice>(request.act) && delta.notices.size() >= limits::notices_a_tick_max)
    return refuse(Refusal::rules_invalid, "a tick has " + std::to_string(limits::notices_a_tick_max) +
                                              " notices at most (limits.notices_a_tick_max)");
  std::visit(Overloaded{[&](const KeepValue& keep) { state.game.keep(keep.value); },
                        [&](const ForgetValue& forget) { state.game.forget(forget.key); },
                        [&](const ShowSign& show) {
                          state.game.show(show.sign);
                          publish_signs(state, delta);
                        },
                        [&](const RemoveSign& remove) {
                          if (state.game.sign(remove.to, remove.name) == nullptr) return;
                          state.game.remove(remove.to, remove.name);
                          publish_signs(state, delta);
                        },
                        [&](const SetPlayer& player) { set_player(state, player, delta); },
                        [&](const Notice& notice) { delta.notices.push_back(notice); }},
             request.act);
  return 0U;
}

void end_signs(World::State& state, TickDelta& delta) {
  if (state.game.end_signs(delta.tick)) publish_signs(state, delta);
}

void leave_game(World::State& state, uint64_t session, TickDelta& delta) {
  const bool was_player = state.game.player(session) != nullptr;
  if (state.game.leave(session)) publish_signs(state, delta);
  if (was_player) publish_players(state, delta);
}

Asker asker_in_game(const World::State& state, const Command& command) {
  Asker asker = command.asker;
  const Player* const player = state.game.player(command.session);
  if (player != nullptr && !player->team.empty()) asker.team = player->team;
  return asker;
}

}  // namespace scree
