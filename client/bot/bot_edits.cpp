// The bot's requests that change terrain: carves, then digs, then places.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "client/bot/bot.h"
#include "client/bot/limits.h"
#include "client/session/edit_reach.h"
#include "shared/base/edit_reach.h"

namespace scree {

namespace {

/// A refused input on foot is answered by its own number: those of requests are beyond.
constexpr uint32_t edits_from = 1U << 29U;

}  // namespace

bool Bot::all_asked() const {
  return report_.carves_asked == config_.carves && report_.digs.asked == config_.digs &&
         report_.places.asked == config_.places;
}

/// Nothing where a place has to wait: the bot does not know yet what it carries.
std::optional<Bot::Kind> Bot::next_kind() const {
  if (report_.carves_asked < config_.carves) return Kind::carve;
  if (report_.digs.asked < config_.digs) return Kind::dig;
  return knows_store_ ? std::optional(Kind::place) : std::nullopt;
}

/// Who walks edits nothing before it is on foot, and has to know how far it reaches.
bool Bot::may_edit() const {
  if (first_frame_ == 0 || !client_.rejoin().has_near_ground()) return false;
  return config_.walks == 0 || (foot_ && foot_->on_foot() && client_.mirror()->status());
}

void Bot::ask(Clock::time_point now) {
  stand_on_ground();
  if (!may_edit()) return;
  while (!all_asked() && requests_.size() < limits::bot_requests_waiting_max) {
    const uint32_t asked = report_.carves_asked + report_.digs.asked + report_.places.asked;
    const double due_s = config_.rate_hz > 0.0 ? asked / config_.rate_hz : 0.0;
    if (std::chrono::duration<double>(now - first_frame_at_).count() < due_s) return;
    const std::optional<Kind> kind = next_kind();
    if (!kind) return;
    switch (*kind) {
      case Kind::carve:
        carve(Clock::now());
        break;
      case Kind::dig:
        dig(Clock::now());
        break;
      case Kind::place:
        place(Clock::now());
        break;
    }
  }
}

/// The number of the next request, which is counted as asked.
uint32_t Bot::number_of(Kind kind) {
  ++(kind == Kind::carve ? report_.carves_asked : moves(kind).asked);
  return edits_from + report_.carves_asked + report_.digs.asked + report_.places.asked;
}

void Bot::carve(Clock::time_point now) {
  const Carver::Target target = aim(Kind::carve);
  const uint32_t number = number_of(Kind::carve);
  const CarveMessage message = carver_.carve(target, number);
  requests_[number] = {now, Kind::carve, message.random_seed};
  unseen_[message.random_seed] = now;
  if (const auto paint = client_.mirror()->palette()->named(config_.paint))
    client_.send(PaintMessage{{message.shape, *paint}, 0});
  client_.send(message);
}

void Bot::dig(Clock::time_point now) {
  const Shape shape = carver_.shape_at(aim(Kind::dig));
  const uint32_t number = number_of(Kind::dig);
  requests_[number] = {now, Kind::dig};
  client_.send(DigMessage{{shape}, number});
}

/// A ball of rubble that lies on the ground.
void Bot::place(Clock::time_point now) {
  const Mirror& mirror = *client_.mirror();
  if (!places_) places_.emplace(mirror.carried(), config_.places);
  const MaterialMass share = places_->next();
  const RubbleRows& rubble = *mirror.terrain().rubble;
  const int fill = rubble.fill[row_number(rubble.rubble[row_number(share.material)])];
  const float radius_m =
      std::clamp(ball_radius_m(share.mass, fill, mirror.terrain().voxel_size_m), limits::bot_place_min_m,
                 greatest_edit_reach_m(mirror.terrain().voxel_size_m));
  const Carver::Target target = aim_apart(radius_m + limits::bot_place_apart_m);
  const Shape ball = sphere(target.point_m + glm::vec3(0.0F, radius_m, 0.0F), radius_m);
  const uint32_t number = number_of(Kind::place);
  requests_[number] = {now, Kind::place};
  client_.send(PlaceMessage{{ball, share.material}, number});
}

MoveReport& Bot::moves(Kind kind) {
  return kind == Kind::dig ? report_.digs : report_.places;
}

void Bot::count(Kind kind, const ReplyMessage& reply) {
  const bool accepted = reply.refusal.empty();
  if (kind == Kind::carve) {
    ++(accepted ? report_.carves_accepted : report_.carves_refused);
    if (accepted) unsaved_.push_back(reply.tick);
  } else {
    MoveReport& counts = moves(kind);
    ++(accepted ? counts.accepted : counts.refused);
    counts.mass += reply.mass.value_or(0);
  }
  if (accepted) return;
  ++(kind == Kind::carve ? report_.refusals : moves(kind).refusals)[reply.refusal_name];
  constexpr std::array names{"carve", "dig", "place"};
  log("refused", fmt::format("{} {} was refused ({}): {}", names[static_cast<size_t>(kind)],
                             reply.request - edits_from, reply.refusal_name, reply.refusal));
}

/// Where the server lets it edit: it goes there first, or on foot takes a place near itself.
Carver::Target Bot::aim(Kind kind) {
  Field& field = client_.mirror()->field();
  const bool elsewhere = kind == Kind::place && config_.place_m;
  const Carver::Target target =
      elsewhere ? carver_.aim_near(field, *config_.place_m, config_.carver.area_m) : carver_.aim(field);
  if (config_.walks == 0) {
    go_near(target.point_m);
    return target;
  }
  const glm::vec3 eye_m = foot_->walker().eye_m();
  const float near_m = limits::bot_foot_reach_part * reach_m();
  if (glm::distance(eye_m, target.point_m) <= near_m) return target;
  return carver_.aim_near(field, eye_m, 0.5F * near_m);
}

/// Likewise, and away from the own body, which nothing can be put into.
Carver::Target Bot::aim_apart(float apart_m) {
  Carver::Target target = aim(Kind::place);
  for (int looks = 1; config_.walks > 0 && looks < limits::bot_looks_max; ++looks) {
    if (glm::distance(foot_->walker().feet_m(), target.point_m) > apart_m) break;
    target = aim(Kind::place);
  }
  return target;
}

/// What is not known yet is as servers have it by default.
float Bot::reach_m() const {
  const auto told_m = edit_reach_m(client_.mirror()->status(), report_.welcome.role);
  return std::min(limits::bot_reach_m, told_m.value_or(limits::bot_reach_m));
}

/// Servers refuse edits far from the eye.
void Bot::go_near(glm::vec3 place_m) {
  if (glm::distance(eye_m_, place_m) <= reach_m()) return;
  const float ground_m = ground_height_m(client_.mirror()->terrain(), place_m.x, place_m.z);
  set_interest({place_m.x, ground_m, place_m.z}, config_.interest_radius_m);
}

}  // namespace scree
