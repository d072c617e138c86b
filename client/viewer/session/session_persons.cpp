// The persons of a session: bodies of others, figures, and the own feet.
#include <algorithm>

#include "client/viewer/session/viewer_session.h"
#include "shared/base/check.h"
#include "shared/person/person_body.h"
#include "shared/person/walker.h"

namespace scree {

/// The session whose body a prop is: of a person here, or of one who was in the recording; else nothing.
std::optional<uint64_t> ViewerSession::person_of(PieceId body, const Prop& prop) const {
  const auto& persons = client_.mirror()->persons();
  if (const auto person = persons.find(body); person != persons.end()) return person->second;
  if (!client_.connected() || !client_.welcome()->replay) return std::nullopt;
  const std::optional<uint64_t> session = person_of_body(prop);
  return session ? std::optional(recorded_person(*session)) : std::nullopt;
}

const SceneProps& ViewerSession::props(double now_s) {
  props_.clear();
  const Mirror* mirror = client_.mirror();
  if (mirror == nullptr) return props_;
  const double tick = client_.draw_tick(now_s);
  // Persons are shown as figures.
  for (const auto& [id, motion] : mirror->props())
    if (!person_of(id, *motion.prop))
      props_.emplace_hint(props_.end(), id, SceneProp{motion.prop, mirror->pose_at(motion, tick)});
  return props_;
}

const Figures& ViewerSession::figures(double now_s) {
  std::vector<PlayerCursor> all = cursors_;
  all.insert(all.end(), recorded_cursors_.begin(), recorded_cursors_.end());
  const Mirror* mirror = client_.mirror();
  PersonFacts facts;
  if (mirror != nullptr) facts.field = &field();
  add_bodies(now_s, all, facts);
  std::vector<uint64_t> present;
  for (const PlayerCursor& one : all) present.push_back(one.session);
  for (const Person& one : conversation_.persons().persons) present.push_back(one.session);
  colours_.follow(present);
  facts.colours = &colours_;
  figures_.step(all, now_s, facts);
  return figures_;
}

/// Adds those on foot.
void ViewerSession::add_bodies(double now_s, std::vector<PlayerCursor>& all, PersonFacts& facts) {
  const Mirror* mirror = client_.mirror();
  if (mirror == nullptr) return;
  const double tick = client_.draw_tick(now_s);
  for (const auto& [id, motion] : mirror->props()) {
    const std::optional<uint64_t> person = person_of(id, *motion.prop);
    if (!person || (welcome() != nullptr && *person == welcome()->session)) continue;
    add_body(facts, all, *person, mirror->pose_at(motion, tick));
  }
}

bool ViewerSession::persons_walk() const {
  return client_.mirror() != nullptr && scree::persons_walk(client_.mirror()->status());
}

WaterLevel ViewerSession::water() const {
  const Mirror* mirror = client_.mirror();
  return mirror != nullptr && mirror->status() ? water_of(mirror->status()->settings) : WaterLevel();
}

void ViewerSession::stand(bool away) {
  StandMessage message;
  message.request = ++requests_;
  message.away = away;
  client_.send(message);
}

void ViewerSession::walk(const WalkInput& input, glm::vec3 look) {
  CHECK(foreseen_walk_ && mirror() != nullptr);
  if (const auto message = foreseen_walk_->step(input, look, *mirror())) client_.send(*message);
}

}  // namespace scree
