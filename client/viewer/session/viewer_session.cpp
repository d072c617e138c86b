#include "client/viewer/session/viewer_session.h"

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "client/connection/come_again.h"
#include "client/viewer/base/limits.h"
#include "proto/person_name.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

constexpr double notice_s = 5.0;
constexpr double rate_window_s = 1.0;

double seconds_of(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

void append(MirrorChanges& to, const MirrorChanges& from) {
  to.bricks.insert(to.bricks.end(), from.bricks.begin(), from.bricks.end());
  to.pieces_added.insert(to.pieces_added.end(), from.pieces_added.begin(), from.pieces_added.end());
  to.pieces_removed.insert(to.pieces_removed.end(), from.pieces_removed.begin(), from.pieces_removed.end());
}

}  // namespace

ViewerSession::ViewerSession(std::unique_ptr<Connector> connector, SessionChoice choice)
    : choice_(std::move(choice)),
      rejoin_(choice_.cache),
      connector_(std::move(connector)),
      retry_s_(limits::reconnect_min_s) {}

ViewerSession::~ViewerSession() {
  connector_.reset();
  rejoin_.finish(connection_ ? mirror_.get() : nullptr);
  if (connection_) connection_->leave();
}

SessionStep ViewerSession::step(double now_s, const Camera& camera) {
  const glm::vec3 eye_m = camera.eye_m;
  SessionStep step;
  if (!connection_) {
    if (!connector_->busy() && !gave_up_ && now_s >= next_try_s_) begin_connecting(now_s, eye_m);
    finish_connecting(now_s, step);
  }
  if (connection_) receive(now_s, step);
  if (predictions_ && !(connection_ && predict_)) predictions_->take_back();
  if (predictions_) predictions_->settle(now_s, step.changes);
  if (connection_) report(now_s, eye_m);
  if (connection_) report_cursor(now_s, camera);
  if (connection_) control_replay(now_s);
  if (connection_) rejoin_.tend(now_s, *mirror_, *connection_);
  return step;
}

void ViewerSession::set_interest_radius(float metres) {
  radius_is_new_ = radius_is_new_ || metres != choice_.interest_radius_m;
  choice_.interest_radius_m = metres;
}

void ViewerSession::begin_connecting(double now_s, glm::vec3 eye_m) {
  reported_eye_m_ = eye_m;
  HelloMessage hello;
  hello.client = choice_.program;
  hello.eye_m = eye_m;
  hello.interest_radius_m = choice_.interest_radius_m;
  hello.name = choice_.name;
  hello.meets = true;
  connector_->begin(rejoin_, hello, now_s);
}

void ViewerSession::finish_connecting(double now_s, SessionStep& step) {
  if (!connector_->busy()) return;
  std::optional<Connector::Attempt> attempt = connector_->take(now_s);
  if (!attempt) return;
  if (!attempt->channel) return lose(now_s, attempt->end);
  connection_ = std::move(attempt->channel);
  connected_since_s_ = now_s;
  predictions_.reset();
  mirror_ = rejoin_.begin(*connection_);
  predictions_ = std::make_unique<Predictions>(*mirror_);
  asked_s_.clear();
  const WelcomeMessage& welcome = connection_->welcome();
  step.new_mirror = true;
  step.other_world = std::exchange(world_, welcome.world) != welcome.world;
  tick_rate_hz_ = welcome.tick_rate_hz;
  pace_.start(tick_rate_hz_);
  playback_.start(welcome);
  pieces_.clear();
  conversation_.begin();
  timeline_.begin(tick_rate_hz_);
  trouble_.clear();
  acknowledged_ = 0;
  reported_cursor_ = {};
  watching_ = false;
  last_chunk_s_ = now_s;
  saw_pieces_ = false;
  rate_since_s_ = now_s;
  rate_bytes_ = 0;
}

void ViewerSession::lose(double now_s, const ConnectionEnd& end) {
  if (connection_) rejoin_.keep(*mirror_);
  connection_.reset();
  cursors_.clear();
  recorded_cursors_.clear();
  conversation_.begin();
  timeline_.begin(tick_rate_hz_);
  physics_.reset();
  trouble_ = end.message;
  gave_up_ = !may_come_again(end.refusal);
  if (connected_since_s_ && now_s - *connected_since_s_ >= limits::reconnect_worth_s)
    retry_s_ = limits::reconnect_min_s;
  connected_since_s_.reset();
  next_try_s_ = now_s + retry_s_;
  retry_s_ = std::min(2.0 * retry_s_, limits::reconnect_max_s);
  bytes_per_s_ = 0.0;
}

void ViewerSession::receive(double now_s, SessionStep& step) {
  const bool open = connection_->connected();
  std::vector<Received> arrived = connection_->poll();
  const bool last = !open && arrived.empty();
  for (Received& received : arrived) {
    rate_bytes_ += received.bytes;
    if (const auto* reply = std::get_if<ReplyMessage>(&received.message))
      measure(*reply, seconds_of(received.arrived));
    if (const auto* frame = std::get_if<FrameMessage>(&received.message))
      pace_.note(frame->tick, seconds_of(received.arrived));
    playback_.push(std::move(received.message), seconds_of(received.arrived));
  }
  apply_due(now_s, step);
  if (!connection_) return;
  while (const std::optional<RepairMessage> repair = mirror_->take_repair_request())
    connection_->send(*repair);
  if (now_s - rate_since_s_ >= rate_window_s) {
    bytes_per_s_ = static_cast<double>(rate_bytes_) / (now_s - rate_since_s_);
    rate_since_s_ = now_s;
    rate_bytes_ = 0;
  }
  if (last) lose(now_s, connection_->end());
}

void ViewerSession::apply_due(double now_s, SessionStep& step) {
  const double begun_s = steady_now_s();
  double last_s = begun_s;
  while (last_s - begun_s < choice_.apply_s) {
    const std::optional<ServerMessage> message = playback_.take_next(now_s);
    if (!message) return;
    apply(*message, now_s, step);
    if (!connection_) return;
    apply_worst_ms_ = std::max(apply_worst_ms_, (steady_now_s() - last_s) * 1000.0);
    last_s = steady_now_s();
  }
}

void ViewerSession::measure(const ReplyMessage& reply, double arrived_s) {
  const auto asked = asked_s_.find(reply.request);
  if (asked == asked_s_.end()) return;
  latency_ = {(arrived_s - asked->second) * 1000.0, reply.latency};
  asked_s_.erase(asked);
}

void ViewerSession::apply(const ServerMessage& message, double now_s, SessionStep& step) {
  std::visit(Overloaded{[&](const ChunkMessage&) { last_chunk_s_ = now_s; },
                        [&](const ResetMessage&) { last_chunk_s_ = now_s; },
                        [&](const KeptMessage&) { last_chunk_s_ = now_s; },
                        [&](const ReplyMessage& reply) {
                          if (reply.refusal.empty()) return;
                          timeline_.refused();
                          notice_ = reply.refusal;
                          notice_until_s_ = now_s + notice_s;
                        },
                        [&](const CursorsMessage& cursors) { cursors_ = cursors.cursors; },
                        [&](const RecordedCursorsMessage& cursors) { take(cursors); },
                        [&](const PlaybackMessage& playback) {
                          step.jumped = timeline_.take(playback, now_s) || step.jumped;
                        },
                        [&](const MarksMessage& marks) { timeline_.take(marks); },
                        [&](const PersonsMessage& persons) { conversation_.take(persons); },
                        [&](const SaidMessage& said) { conversation_.take(said, now_s); },
                        [&](const PhysicsMessage& physics) { physics_ = physics; },
                        [](const auto&) {}},  // the mirror's alone
             message);
  const Result<void> taken = rejoin_.before(message, *mirror_);
  const Result<MirrorChanges> changes = taken ? mirror_->apply(message) : tl::unexpected(taken.error());
  if (!changes) {
    lose(now_s, {{"what the server sent cannot be applied: " + changes.error().message}});
    return;
  }
  predictions_->notice(message);
  rejoin_.after(message, *mirror_, *connection_);
  saw_pieces_ = saw_pieces_ || !changes->pieces_added.empty();
  append(step.changes, *changes);
}

void ViewerSession::take(const RecordedCursorsMessage& recorded) {
  recorded_cursors_ = recorded.cursors;
  for (PlayerCursor& cursor : recorded_cursors_) {
    cursor.name = called(cursor.session, cursor.name);
    cursor.session = recorded_person(cursor.session);
  }
}

/// Wishes of a replay are acts of administrators: a token came with the hello.
void ViewerSession::control_replay(double now_s) {
  while (const std::optional<ControlReplayRequest> wish = timeline_.take_due(now_s))
    connection_->send(AdminMessage{++requests_, "", *wish});
}

void ViewerSession::report(double now_s, glm::vec3 eye_m) {
  if (now_s < next_report_s_) return;
  next_report_s_ = now_s + limits::report_interval_s;
  if (mirror_->tick() > acknowledged_) {
    acknowledged_ = mirror_->tick();
    connection_->send(AckMessage{acknowledged_});
  }
  if (glm::distance(eye_m, reported_eye_m_) < limits::report_distance_m && !radius_is_new_) return;
  radius_is_new_ = false;
  reported_eye_m_ = eye_m;
  rejoin_.follow(eye_m, choice_.interest_radius_m, *mirror_, *connection_);
}

void ViewerSession::report_cursor(double now_s, const Camera& camera) {
  if (watch_ != watching_) {
    watching_ = watch_;
    if (!watch_) physics_.reset();
    connection_->send(WatchMessage{watch_});
  }
  if (now_s < next_cursor_s_) return;
  next_cursor_s_ = now_s + limits::cursor_interval_s;
  const glm::vec3 ahead_m = camera.eye_m + camera.forward() * limits::carve_reach_m;
  const CursorMessage cursor{camera.eye_m, aim(camera.eye_m, camera.forward()).value_or(ahead_m)};
  const float moved_m = glm::distance(cursor.eye_m, reported_cursor_.eye_m) +
                        glm::distance(cursor.aim_m, reported_cursor_.aim_m);
  if (moved_m < limits::cursor_distance_m) return;
  reported_cursor_ = cursor;
  connection_->send(cursor);
}

const ScenePieces& ViewerSession::pieces(double now_s) {
  pieces_.clear();
  if (!mirror_) return pieces_;
  const double tick = playback_.draw_tick(now_s);
  for (const auto& [id, motion] : mirror_->pieces())
    pieces_.emplace_hint(pieces_.end(), id, ScenePiece{motion.volume, mirror_->pose_at(motion, tick)});
  const float voxel_m = mirror_->terrain().voxel_size_m;
  for (const auto& [id, volume] : predictions_->pieces())
    pieces_.emplace(id, ScenePiece{volume, {volume->centre_voxels * voxel_m, {1.0F, 0.0F, 0.0F, 0.0F}}});
  return pieces_;
}

const Figures& ViewerSession::figures(double now_s) {
  std::vector<PlayerCursor> all = cursors_;
  all.insert(all.end(), recorded_cursors_.begin(), recorded_cursors_.end());
  figures_.step(all, now_s);
  return figures_;
}

void ViewerSession::say(const std::string& text) {
  if (connection_ && !text.empty()) connection_->send(SayMessage{text});
}

bool ViewerSession::joined(double now_s) const {
  return connection_ != nullptr && mirror_->tick() > 0 && now_s - last_chunk_s_ >= limits::join_quiet_s;
}

bool ViewerSession::carved() const {
  const bool made = mirror_ != nullptr && mirror_->status() && mirror_->status()->pieces_made > 0;
  return saw_pieces_ || made;
}

std::optional<glm::vec3> ViewerSession::aim(glm::vec3 from_m, glm::vec3 direction) {
  if (!mirror_) return std::nullopt;
  const float voxel_m = mirror_->terrain().voxel_size_m;
  const std::optional<float> hit =
      trace(field(), from_m / voxel_m, direction, limits::carve_reach_m / voxel_m);
  if (!hit) return std::nullopt;
  return from_m + direction * (*hit * voxel_m);
}

void ViewerSession::strike(const Tool& tool, glm::vec3 from_m, glm::vec3 direction, double now_s) {
  if (!connection_) return;
  const std::optional<glm::vec3> hit_m = aim(from_m, direction);
  if (!hit_m) return;
  const Request asked = request_of(tool, *hit_m, direction, ++requests_);
  std::visit(
      Overloaded{[&](const auto& request) {
                   connection_->send(RequestMessage<std::decay_t<decltype(request)>>{request, requests_});
                 },
                 [](const SettingsRequest&) {},  // no tool's
                 [](const LeaveRequest&) {}},
      asked);
  if (asked_s_.size() >= limits::own_requests_timed_max) asked_s_.erase(asked_s_.begin());
  asked_s_[requests_] = now_s;
  if (predict_) foresee(asked, requests_, now_s);
}

/// Where everything that the request reads has arrived, and where it can be hoped to be carried out.
void ViewerSession::foresee(const Request& asked, uint32_t number, double now_s) {
  const WelcomeMessage& welcome = connection_->welcome();
  const Role role = std::holds_alternative<CarveRequest>(asked) ? Role::carver : Role::builder;
  if (welcome.replay || !may_act_as(welcome.role, role)) return;
  const float radius_m = std::min(choice_.interest_radius_m, welcome.interest_radius_m);
  const float side_m = static_cast<float>(chunk_size) * mirror_->terrain().voxel_size_m;
  const auto known = [&](ChunkCoord chunk) {
    if (!is_here(mirror_->terrain(), chunk)) return false;
    if (mirror_->held_chunks().contains(chunk)) return true;
    if (!joined(now_s)) return false;  // it may be on its way
    const glm::vec3 lo_m = glm::vec3(chunk.x, chunk.y, chunk.z) * side_m;
    const glm::vec3 nearest_m = glm::clamp(reported_eye_m_, lo_m, lo_m + side_m);
    return glm::distance(reported_eye_m_, nearest_m) <= radius_m;
  };
  predictions_->foresee(number, asked, now_s, known);
}

std::string ViewerSession::description() const {
  const std::string where = connector_->where();
  if (connection_) {
    const WelcomeMessage& welcome = connection_->welcome();
    return where + (welcome.replay ? " (a recording)" : ", as " + std::string(name_of(welcome.role)));
  }
  if (trouble_.empty()) return "connecting to " + where + " ...";
  return gave_up_ ? trouble_ : trouble_ + " - trying again";
}

std::optional<double> ViewerSession::next_try_s(double now_s) const {
  if (connection_ || gave_up_ || connector_->busy()) return std::nullopt;
  return std::max(next_try_s_ - now_s, 0.0);
}

std::optional<ConnectionCounters> ViewerSession::traffic() const {
  if (!connection_) return std::nullopt;
  return connection_->counters();
}

std::string ViewerSession::notice(double now_s) const {
  return now_s < notice_until_s_ ? notice_ : std::string();
}

}  // namespace scree
