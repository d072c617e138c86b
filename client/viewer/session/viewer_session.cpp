#include "client/viewer/session/viewer_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <utility>

#include "client/session/edit_reach.h"
#include "client/viewer/base/limits.h"
#include "client/viewer/session/refusal_words.h"
#include "client/viewer/session/way_ahead.h"
#include "proto/person_name.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

constexpr double notice_s = 5.0;
constexpr double rate_window_s = 1.0;

void append(MirrorChanges& to, const MirrorChanges& from) {
  to.bricks.insert(to.bricks.end(), from.bricks.begin(), from.bricks.end());
  to.pieces_added.insert(to.pieces_added.end(), from.pieces_added.begin(), from.pieces_added.end());
  to.pieces_removed.insert(to.pieces_removed.end(), from.pieces_removed.begin(), from.pieces_removed.end());
  to.props_added.insert(to.props_added.end(), from.props_added.begin(), from.props_added.end());
  to.stones.insert(to.stones.end(), from.stones.begin(), from.stones.end());
  to.props_removed.insert(to.props_removed.end(), from.props_removed.begin(), from.props_removed.end());
}

std::string told_of_paint(uint32_t bricks) {
  if (bricks == 0) return "Nothing was painted: in this shape there is no other material";
  return "Painted, in " + std::to_string(bricks) + (bricks == 1 ? " brick" : " bricks") +
         " of 8 voxels a side";
}

std::string told_of_reach(float away_m, float most_m) {
  std::array<char, 128> words{};
  std::snprintf(words.data(), words.size(), "This is %.0f m away, and you reach %g m: go nearer",
                static_cast<double>(away_m), static_cast<double>(most_m));
  return words.data();
}

}  // namespace

ViewerSession::ViewerSession(std::unique_ptr<Connector> connector, SessionChoice choice)
    : choice_(std::move(choice)), client_(std::move(connector), {.cache = choice_.cache, .delayed = true}) {
  client_.predict(true);
}

SessionStep ViewerSession::step(double now_s, const Camera& camera) {
  SessionStep step;
  if (!connected() && !client_.joining() && attempts_.due(now_s)) join(now_s, camera.eye_m);
  take_events(now_s, step);
  client_.settle(now_s, step.changes);
  if (foreseen_walk_ && mirror() != nullptr) foreseen_walk_->follow(*mirror());
  if (!connected() || at_spawn_) return step;
  measure_rate(now_s);
  report(now_s, camera.eye_m);
  report_cursor(now_s, camera);
  control_replay(now_s);
  return step;
}

/// As many as there is time for, and one at least.
void ViewerSession::take_events(double now_s, SessionStep& step) {
  client_.poll(now_s);
  const double begun_s = steady_now_s();
  double last_s = begun_s;
  do {
    const std::optional<Client::Event> event = client_.next();
    if (!event) return;
    std::visit(Overloaded{[&](const Client::Joined& joined) { begin(joined, now_s, step); },
                          [&](const Client::Applied& applied) { apply(applied, now_s, step); },
                          [&](const Client::Lost& lost) { lose(now_s, lost.end); }},
               *event);
    const double began_s = std::exchange(last_s, steady_now_s());
    if (std::holds_alternative<Client::Applied>(*event))
      apply_worst_ms_ = std::max(apply_worst_ms_, (last_s - began_s) * 1000.0);
  } while (last_s - begun_s < choice_.apply_s);
}

void ViewerSession::set_interest_radius(float metres) {
  radius_is_new_ = radius_is_new_ || metres != choice_.interest_radius_m;
  choice_.interest_radius_m = metres;
}

void ViewerSession::join(double now_s, glm::vec3 eye_m) {
  HelloMessage hello;
  hello.client = choice_.program;
  hello.eye_m = eye_m;
  hello.interest_radius_m = choice_.interest_radius_m;
  hello.name = choice_.name;
  hello.meets = true;
  hello.at_spawn = at_spawn_;
  hello.stones = true;
  client_.join(hello, now_s);
}

void ViewerSession::begin(const Client::Joined& joined, double now_s, SessionStep& step) {
  attempts_.joined(now_s);
  asked_s_.clear();
  step.new_mirror = true;
  step.other_world = joined.other_world;
  if (joined.other_world && was_here_)
    show_notice("This is another world: the server began it while you were away.", now_s);
  was_here_ = true;
  tick_rate_hz_ = welcome()->tick_rate_hz;
  pace_.start(tick_rate_hz_);
  foreseen_walk_.emplace(welcome()->tick_rate_hz);
  pieces_.clear();
  conversation_.begin();
  timeline_.begin(tick_rate_hz_);
  trouble_.clear();
  reported_cursor_ = {};
  physics_requested_ = false;
  saw_pieces_ = false;
  rate_since_s_ = now_s;
  rate_bytes_ = client_.counters().received_bytes;
}

void ViewerSession::lose(double now_s, const ConnectionEnd& end) {
  cursors_.clear();
  recorded_cursors_.clear();
  conversation_.begin();
  timeline_.begin(tick_rate_hz_);
  physics_.reset();
  trouble_ = without_options(end.message);
  attempts_.lost(now_s, end.refusal);
  bytes_per_s_ = 0.0;
}

void ViewerSession::measure_rate(double now_s) {
  if (now_s - rate_since_s_ < rate_window_s) return;
  const uint64_t received = client_.counters().received_bytes;
  bytes_per_s_ = static_cast<double>(received - rate_bytes_) / (now_s - rate_since_s_);
  rate_since_s_ = now_s;
  rate_bytes_ = received;
}

void ViewerSession::apply(const Client::Applied& applied, double now_s, SessionStep& step) {
  const double arrived_s = applied.received.arrived_s();
  std::visit(Overloaded{[&](const FrameMessage& frame) {
                          pace_.note(frame.tick, arrived_s);
                          note(frame.operations, step);
                        },
                        [&](const ReplyMessage& reply) { settle(reply, arrived_s, now_s); },
                        [&](const CursorsMessage& cursors) { cursors_ = cursors.cursors; },
                        [&](const RecordedCursorsMessage& cursors) { set_recorded_cursors(cursors); },
                        [&](const PlaybackMessage& playback) {
                          step.jumped = timeline_.apply(playback, now_s) || step.jumped;
                        },
                        [&](const MarksMessage& marks) { timeline_.apply(marks); },
                        [&](const PersonsMessage& persons) { conversation_.apply(persons); },
                        [&](const SaidMessage& said) { conversation_.apply(said, now_s); },
                        [&](const PhysicsMessage& physics) { physics_ = physics; },
                        [&](const CuesMessage& cues) { note(cues, step); },
                        [&](const ChannelMessage& heard) { step.heard.push_back(heard); },
                        [](const auto&) {}},  // the mirror's alone
             applied.received.message);
  saw_pieces_ = saw_pieces_ || !applied.changes.pieces_added.empty();
  append(step.changes, applied.changes);
}

/// For the frame that is shown; more than a frame can use are left out.
void ViewerSession::note(const CuesMessage& cues, SessionStep& step) {
  for (const Cue& cue : cues.cues)
    if (step.cues.size() < limits::piece_events_per_step_max) step.cues.push_back(cue);
}

void ViewerSession::note(const std::vector<Operation>& operations, SessionStep& step) {
  const size_t room = limits::piece_events_per_step_max - step.edits.size();
  step.edits.insert(step.edits.end(), operations.begin(),
                    operations.begin() + static_cast<std::ptrdiff_t>(std::min(room, operations.size())));
}

void ViewerSession::settle(const ReplyMessage& reply, double arrived_s, double now_s) {
  if (const auto asked = asked_s_.find(reply.request); asked != asked_s_.end()) {
    latency_ = {(arrived_s - asked->second) * 1000.0, reply.latency};
    asked_s_.erase(asked);
    if (reply.refusal.empty()) answer_ = {{}, now_s, answer_.number + 1};
  }
  if (reply.refusal.empty() && !reply.painted) return;
  if (reply.refusal.empty()) return show_notice(told_of_paint(*reply.painted), now_s);
  timeline_.refused();
  refuse(without_options(reply.refusal), reply.refusal_name, now_s);
}

void ViewerSession::refuse(std::string words, std::string_view refusal, double now_s) {
  answer_ = {std::string(in_brief(refusal)), now_s, answer_.number + 1};
  show_notice(std::move(words), now_s);
}

void ViewerSession::show_notice(std::string words, double now_s) {
  notice_ = std::move(words);
  notice_until_s_ = now_s + notice_s;
}

void ViewerSession::set_recorded_cursors(const RecordedCursorsMessage& recorded) {
  recorded_cursors_ = recorded.cursors;
  for (PlayerCursor& cursor : recorded_cursors_) {
    cursor.name = called(cursor.session, cursor.name);
    cursor.session = recorded_person(cursor.session);
  }
}

/// Wishes of a replay are acts of administrators: a token came with the hello.
void ViewerSession::control_replay(double now_s) {
  while (const std::optional<ControlReplayRequest> wish = timeline_.pop_due(now_s))
    client_.send(AdminMessage{++requests_, "", *wish});
}

void ViewerSession::report(double now_s, glm::vec3 eye_m) {
  if (now_s < next_report_s_) return;
  next_report_s_ = now_s + limits::report_interval_s;
  if (glm::distance(eye_m, client_.eye_m()) < limits::report_distance_m && !radius_is_new_) return;
  radius_is_new_ = false;
  client_.follow(eye_m, choice_.interest_radius_m);
}

void ViewerSession::report_cursor(double now_s, const Camera& camera) {
  if (wants_physics_ != physics_requested_) {
    physics_requested_ = wants_physics_;
    if (!wants_physics_) physics_.reset();
    client_.send(PhysicsSubscriptionMessage{wants_physics_});
  }
  if (now_s < next_cursor_s_) return;
  next_cursor_s_ = now_s + limits::cursor_interval_s;
  const glm::vec3 ahead_m = camera.eye_m + camera.forward() * limits::carve_reach_m;
  const CursorMessage cursor{camera.eye_m, aim(camera.eye_m, camera.forward()).value_or(ahead_m)};
  const float moved_m = glm::distance(cursor.eye_m, reported_cursor_.eye_m) +
                        glm::distance(cursor.aim_m, reported_cursor_.aim_m);
  if (moved_m < limits::cursor_distance_m) return;
  reported_cursor_ = cursor;
  client_.send(cursor);
}

const ScenePieces& ViewerSession::pieces(double now_s) {
  pieces_.clear();
  const Mirror* mirror = client_.mirror();
  if (mirror == nullptr) return pieces_;
  const double tick = client_.draw_tick(now_s);
  for (const auto& [id, motion] : mirror->pieces())
    pieces_.emplace_hint(pieces_.end(), id, ScenePiece{motion.volume, mirror->pose_at(motion, tick)});
  const float voxel_m = mirror->terrain().voxel_size_m;
  for (const auto& [id, volume] : client_.predictions()->pieces())
    pieces_.emplace(id, ScenePiece{volume, {volume->centre_voxels * voxel_m, {1.0F, 0.0F, 0.0F, 0.0F}}});
  return pieces_;
}

void ViewerSession::say(const std::string& text) {
  if (!text.empty()) client_.send(SayMessage{text});
}

bool ViewerSession::send(ChannelData data) {
  if (!connected() || !validate(data)) return false;
  client_.send(ChannelMessage{std::move(data)});
  return true;
}

bool ViewerSession::carved() const {
  const Mirror* mirror = client_.mirror();
  const bool made = mirror != nullptr && mirror->status() && mirror->status()->pieces_made > 0;
  return saw_pieces_ || made;
}

std::optional<glm::vec3> ViewerSession::aim(glm::vec3 from_m, glm::vec3 direction) {
  if (mirror() == nullptr) return std::nullopt;
  const float voxel_m = mirror()->terrain().voxel_size_m;
  const std::optional<float> hit =
      trace(field(), from_m / voxel_m, direction, limits::carve_reach_m / voxel_m);
  if (!hit) return std::nullopt;
  return from_m + direction * (*hit * voxel_m);
}

std::optional<float> ViewerSession::reach_m() const {
  const Mirror* const mirror = client_.mirror();
  if (mirror == nullptr || welcome() == nullptr) return std::nullopt;
  return edit_reach_m(mirror->status(), welcome()->role);
}

bool ViewerSession::is_beyond_reach(const Shape& shape, glm::vec3 from_m) const {
  const std::optional<float> most_m = reach_m();
  return most_m && distance(shape, from_m) > *most_m;
}

void ViewerSession::strike(const Tool& tool, glm::vec3 from_m, glm::vec3 direction, double now_s) {
  if (!connected()) return;
  const std::optional<glm::vec3> hit_m = aim(from_m, direction);
  if (!hit_m) return;
  const ToolHolder by = holder();
  const Shape shape = shape_of_strike(tool, *hit_m, direction);
  if (is_beyond_reach(shape, from_m))
    return refuse(told_of_reach(distance(shape, from_m), *reach_m()), "reach", now_s);
  if (tool.use == ToolUse::place && by.carried.empty())
    return refuse("You carry nothing to place: dig some rock first", "store_missing", now_s);
  Request request = request_of(tool, *hit_m, direction, requests_ + 1, by);
  if (auto* const dig = std::get_if<DigRequest>(&request)) dig->shape = shape;
  ask(request, now_s);
}

Shape ViewerSession::shape_of_strike(const Tool& tool, glm::vec3 hit_m, glm::vec3 direction) {
  Shape shape = shape_of(tool, hit_m, direction, holder().voxel_size_m);
  if (!feet_m_ || tool.use != ToolUse::dig || tool.kind == ToolKind::tunnel) return shape;
  shape.a = middle_of_way(field(), *feet_m_, direction, tool.radius_m).value_or(shape.a);
  return shape;
}

void ViewerSession::ask(const Request& request, double now_s) {
  ++requests_;
  if (asked_s_.size() >= limits::own_requests_timed_max) asked_s_.erase(asked_s_.begin());
  asked_s_[requests_] = now_s;
  client_.ask(request, requests_, now_s);
}

void ViewerSession::give_away(double now_s) {
  if (!connected()) return;
  if (holder().carried.empty()) return refuse("You carry nothing to give away", "store_missing", now_s);
  ask(TransferRequest{.from = {}, .to = worlds_store()}, now_s);
  show_notice("What you carried is in the world's store now", now_s);
}

ToolHolder ViewerSession::holder() const {
  static const MaterialMasses nothing;
  const Mirror* const mirror = client_.mirror();
  return {palette(), mirror == nullptr ? nothing : mirror->carried(),
          mirror == nullptr ? limits::voxel_size_min_m : mirror->terrain().voxel_size_m,
          welcome() != nullptr && may_act_as(welcome()->role, Role::builder)};
}

std::string ViewerSession::description() const {
  const std::string where = client_.where();
  if (const WelcomeMessage* told = welcome())
    return where + (told->replay ? " (a recording)" : ", as " + std::string(name_of(told->role)));
  if (trouble_.empty()) return "connecting to " + where + " ...";
  return gave_up() ? trouble_ : trouble_ + " - trying again";
}

std::optional<double> ViewerSession::next_try_s(double now_s) const {
  if (connected() || gave_up() || client_.joining()) return std::nullopt;
  return attempts_.wait_s(now_s);
}

std::optional<ConnectionCounters> ViewerSession::traffic() const {
  if (!connected()) return std::nullopt;
  return client_.counters();
}

std::string ViewerSession::notice(double now_s) const {
  return now_s < notice_until_s_ ? notice_ : std::string();
}

}  // namespace scree
