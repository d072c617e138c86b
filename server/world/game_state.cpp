#include "server/world/game_state.h"

#include <algorithm>

#include "server/world/state_hash.h"

namespace scree {

namespace {

template <typename T>
using Shared = std::shared_ptr<const std::vector<T>>;

/// The list with the value in its place, or in the place of the one there.
template <typename T, typename Less>
Shared<T> with(const Shared<T>& list, const T& value, Less less) {
  auto changed = std::make_shared<std::vector<T>>(*list);
  const auto at = std::lower_bound(changed->begin(), changed->end(), value, less);
  if (at != changed->end() && !less(value, *at))
    *at = value;
  else
    changed->insert(at, value);
  return changed;
}

template <typename T, typename Is>
Shared<T> without(const Shared<T>& list, Is is) {
  auto changed = std::make_shared<std::vector<T>>();
  for (const T& one : *list)
    if (!is(one)) changed->push_back(one);
  return changed;
}

bool key_before(const KeptValue& a, const KeptValue& b) {
  return a.key < b.key;
}

bool session_before(const Player& a, const Player& b) {
  return a.session < b.session;
}

size_t bytes_of_kept(const KeptValue& value) {
  return value.key.size() + value.value.size();
}

template <typename T, typename Less>
bool ascends(const std::vector<T>& list, Less less) {
  for (size_t i = 1; i < list.size(); ++i)
    if (!less(list[i - 1], list[i])) return false;
  return true;
}

}  // namespace

const KeptValue* GameState::kept(const std::string& key) const {
  const auto at = std::ranges::lower_bound(*value_.kept, key, {}, &KeptValue::key);
  return at != value_.kept->end() && at->key == key ? &*at : nullptr;
}

void GameState::keep(const KeptValue& value) {
  value_.kept = with(value_.kept, value, key_before);
  changed_kept();
}

void GameState::forget(const std::string& key) {
  if (kept(key) == nullptr) return;
  value_.kept = without(value_.kept, [&](const KeptValue& one) { return one.key == key; });
  changed_kept();
}

const Sign* GameState::sign(const Audience& to, const std::string& name) const {
  const auto is_it = [&](const Sign& sign) { return sign.to == to && sign.name == name; };
  const auto at = std::ranges::find_if(*value_.signs, is_it);
  return at != value_.signs->end() ? &*at : nullptr;
}

void GameState::show(const Sign& sign) {
  value_.signs = with(value_.signs, sign, sign_before);
  changed_signs();
}

void GameState::remove(const Audience& to, const std::string& name) {
  value_.signs = without(value_.signs, [&](const Sign& sign) { return sign.to == to && sign.name == name; });
  changed_signs();
}

bool GameState::end_signs(Tick now) {
  const auto is_over = [&](const Sign& sign) { return sign.until != 0 && sign.until < now; };
  if (std::ranges::none_of(*value_.signs, is_over)) return false;
  value_.signs = without(value_.signs, is_over);
  changed_signs();
  return true;
}

const Player* GameState::player(uint64_t session) const {
  const auto at = std::ranges::lower_bound(*value_.players, session, {}, &Player::session);
  return at != value_.players->end() && at->session == session ? &*at : nullptr;
}

void GameState::set(const Player& player) {
  if (player.team.empty() && player.pace == 1.0F)
    value_.players =
        without(value_.players, [&](const Player& one) { return one.session == player.session; });
  else
    value_.players = with(value_.players, player, session_before);
  sum_up();
}

bool GameState::leave(uint64_t session) {
  if (player(session) != nullptr) set({session});
  const auto is_for_it = [&](const Sign& sign) { return sign.to.session == session; };
  if (std::ranges::none_of(*value_.signs, is_for_it)) return false;
  value_.signs = without(value_.signs, is_for_it);
  changed_signs();
  return true;
}

void GameState::changed_kept() {
  kept_bytes_ = 0;
  kept_hash_ = 0;
  for (const KeptValue& value : *value_.kept) {
    kept_bytes_ += bytes_of_kept(value);
    kept_hash_ += hash_of(value);
  }
  sum_up();
}

void GameState::changed_signs() {
  signs_hash_ = 0;
  for (const Sign& sign : *value_.signs) signs_hash_ += hash_of(sign);
  sum_up();
}

void GameState::sum_up() {
  hash_ = kept_hash_ + signs_hash_;
  for (const Player& player : *value_.players) hash_ += hash_of(player);
}

Result<void> GameState::restore(const GameValue& value) {
  size_t bytes = 0;
  for (const KeptValue& one : *value.kept) {
    TRY(validate(one));
    bytes += bytes_of_kept(one);
  }
  for (const Sign& sign : *value.signs) TRY(validate(sign));
  for (const Player& player : *value.players) TRY(validate(player));
  if (!ascends(*value.kept, key_before) || !ascends(*value.signs, sign_before) ||
      !ascends(*value.players, session_before))
    return fail("what its rules keep, its signs or its players are not in order");
  if (value.kept->size() > limits::kept_values_max || bytes > limits::kept_bytes_max ||
      value.signs->size() > limits::signs_max || value.players->size() > limits::players_max)
    return fail(
        "its rules keep or show more than a world has (limits.kept_values_max, kept_bytes_max, "
        "signs_max, players_max)");
  value_ = value;
  changed_kept();
  changed_signs();
  return {};
}

}  // namespace scree
