#include "client/viewer/viewing/visit.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <utility>

#include "client/viewer/base/limits.h"
#include "client/viewer/events/cue_event.h"
#include "client/viewer/session/region_lines.h"

namespace scree {
Visit::Visit(std::unique_ptr<Connector> connector, SessionChoice session_choice, const VisitChoice& choice,
             std::unique_ptr<View> drawn, std::unique_ptr<Trace> traced)
    : trace(std::move(traced)),
      session(std::move(connector), std::move(session_choice)),
      view(std::move(drawn)),
      particles_(choice.particles),
      details_(choice.details),
      quality_(choice.quality),
      chosen_radius_m_(choice.view_radius_m),
      render_scale_(choice.render_scale) {
  session.begin_at_spawn(true);
  if (choice.camera) place_camera(*choice.camera);
  view->renderer().set_trace(trace.get());
  use(choice.quality);
  session.predict(choice.predict);
}

void Visit::use(Quality quality) {
  quality_ = quality;
  Fineness fineness = traits_of(quality).fineness;
  if (!details_) fineness.details_m = 0.0F;
  if (render_scale_) fineness.render_scale = *render_scale_;
  view->set_fineness(fineness, view_radius_m());
  session.set_interest_radius(interest_radius_m(chosen_radius_m_, quality_));
}

void Visit::set_view_radius(std::optional<float> metres) {
  chosen_radius_m_ = metres;
  use(quality_);
}

std::optional<Quality> Visit::choose_quality(std::optional<Quality> wanted, float frame_ms) {
  if (wanted) {
    if (*wanted != quality_) use(*wanted);
    auto_quality_ = {};
    return std::nullopt;
  }
  if (quality_ != auto_quality_.quality()) use(auto_quality_.quality());
  if (!session.connected()) return std::nullopt;
  const std::optional<Quality> other = auto_quality_.note(frame_ms, view->methods().loaded());
  if (other) use(*other);
  return other;
}

void Visit::place_camera(const Camera& place) {
  camera = place;
  stands_ = true;
  session.begin_at_spawn(false);
}

/// Where nobody said where to look from, and once: who comes back has a place. A server of an older release
/// says nothing; then the camera begins above the middle of a ground that has one.
void Visit::stand_at_spawn() {
  const WelcomeMessage* const welcome = session.welcome();
  if (welcome == nullptr || std::exchange(stands_, true)) return;
  session.begin_at_spawn(false);
  if (welcome->spawn) {
    camera.eye_m = welcome->spawn->eye_m;
    camera.yaw = glm::radians(welcome->spawn->yaw_degrees);
    camera.pitch = glm::radians(welcome->spawn->pitch_degrees);
  } else if (const auto eye_m = place_above(session.mirror()->terrain())) {
    camera.eye_m = *eye_m;
  }
}

Result<void> Visit::step(double now_s) {
  const SessionStep step = [&] {
    const TraceSpan span(trace.get(), "viewer", "messages");
    return session.step(now_s, camera);
  }();
  if (step.new_mirror) stand_at_spawn();
  if (step.new_mirror || step.jumped) {
    piece_events_.begin();
    dust_.clear();
  }
  events_.clear();
  if (session.mirror() != nullptr) follow_pieces(step, now_s);
  if (hears_) heard_.insert(heard_.end(), step.heard.begin(), step.heard.end());
  while (heard_.size() > limits::messages_heard_max) heard_.pop_front();
  const TraceSpan span(trace.get(), "viewer", "update");
  TRY(view->follow(step, session, camera, now_s));
  if (session.mirror() == nullptr) return {};
  const Scene scene = session.scene(now_s);
  std::vector<Contact> contacts =
      contacts_of({scene.field, view->methods().pieces(), scene.props}, camera.eye_m);
  session.figures(now_s).add_to(contacts);
  view->renderer().set_contacts(std::move(contacts));
  return {};
}

float Visit::interest_radius_m(std::optional<float> chosen_m, Quality quality) {
  return chosen_m.value_or(std::max(traits_of(quality).view_radius_m, limits::interest_least_m));
}

std::deque<ChannelData> Visit::drain_heard() {
  hears_ = true;
  return std::exchange(heard_, {});
}

/// In a replay, Sign::until is a tick of the recording.
SignMoment Visit::sign_moment(double now_s) {
  const double rate_hz = session.tick_rate_hz();
  if (session.is_replay() && session.timeline().is_known())
    return {session.timeline().moment(now_s), rate_hz};
  return {session.mirror() == nullptr ? 0.0 : static_cast<double>(session.mirror()->tick()), rate_hz};
}

std::vector<ShownSign> Visit::signs(float aspect, double now_s) {
  if (session.mirror() == nullptr || session.mirror()->signs().empty()) return {};
  return shown_signs(session.mirror()->signs(), sign_moment(now_s), camera, aspect);
}

/// What they do is heard and seen.
void Visit::follow_pieces(const SessionStep& step, double now_s) {
  if (!listens_ && !particles_ && !shakes_) return;
  std::vector<Cue> cues = step.cues;
  for (const Operation& edit : step.edits) add_cues_of(edit, cues);
  events_ = piece_events_.step(session.scene(now_s), now_s, session.palette());
  for (const Cue& cue : cues)
    if (events_.size() < limits::piece_events_per_step_max)
      events_.push_back(event_of(cue, session.palette()));
  if (shakes_) shake_.add(events_, camera.eye_m, now_s);
  if (!particles_) return;
  dust_.add(events_, now_s);
  view->renderer().set_particles(dust_.at(now_s, camera.eye_m));
}

void Visit::show_particles(bool on) {
  if (on == particles_) return;
  particles_ = on;
  dust_.clear();
  view->renderer().set_particles({});
}

void Visit::show_details(bool on) {
  if (std::exchange(details_, on) != on) use(quality_);
}

void Visit::shake(bool on) {
  shakes_ = on;
  if (!on) shake_.end();
}

LineList Visit::lines(const Tool& tool, const OverlayChoice& overlay, std::optional<uint64_t> looked_through,
                      double now_s, bool with_tool) {
  LineList lines;
  preview_.step(tool, session, camera, now_s);
  if (with_tool) preview_.add_to(lines, tool, session.palette());
  const Figures& figures = session.figures(now_s);
  figures.add_to(lines);
  view->renderer().set_limbs(figures.limbs(camera.eye_m, looked_through, false));
  view->renderer().set_wind_time(now_s);
  add_joints_of(session, lines, camera.eye_m, now_s);
  add_regions_of(session, lines, camera.eye_m);
  add_overlay(lines, overlay, now_s);
  return lines;
}

void Visit::add_overlay(LineList& lines, const OverlayChoice& choice, double now_s) {
  session.want_physics(choice.shown && choice.physics);
  if (!choice.shown || session.mirror() == nullptr) return;
  add_borders(lines, session, choice, camera.eye_m, now_s);
  if (const PhysicsMessage* physics = session.physics()) add_physics(lines, *physics, session.scene(now_s));
}

}  // namespace scree
