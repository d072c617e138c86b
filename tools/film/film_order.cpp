#include "tools/film/film_order.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "client/viewer/base/camera_text.h"
#include "server/replay/export_lines.h"
#include "server/replay/recorded_field.h"
#include "shared/base/overloaded.h"
#include "tools/film/limits.h"

namespace scree {
namespace {

/// What an orbit shows before its event, and after it: as long as pieces fly and roll.
constexpr double before_event_s = 1.0;
constexpr double after_event_s = 7.0;

/// A frame counts as within the film when it is over its end by no more than rounding.
constexpr double rounding = 1e-6;

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The wanted one of a recording's events.
class EventSearch {
 public:
  explicit EventSearch(const WhichEvent& which) : which_(which) {}

  void add(const Event& event) {
    ++number_;
    if (const auto* wanted = std::get_if<size_t>(&which_)) {
      if (*wanted == number_) found_ = event;
      return;
    }
    const auto* kind = std::get_if<EventKind>(&which_);
    if (!event.place_m || (kind != nullptr && event.kind != *kind)) return;
    if (kind == nullptr && row_of(event.kind).of_machine) return;
    if (!found_ || std::pair(event.volume_m3, event.pieces) > std::pair(found_->volume_m3, found_->pieces))
      found_ = event;
  }

  /// Nothing: any would do, and none has a place.
  Result<std::optional<Event>> found() const {
    if (found_ && found_->place_m) return found_;
    const std::string way_out = "; choose a --camera or a --path; `scree replay events` lists the events";
    if (found_)
      return fail(
          fmt::format("event {} is a {}, which has no place{}", number(), name_of(found_->kind), way_out));
    if (const auto* wanted = std::get_if<size_t>(&which_))
      return fail(fmt::format("it has {} events and no event {}{}", number_, *wanted, way_out));
    if (const auto* kind = std::get_if<EventKind>(&which_))
      return fail(fmt::format("it has no {} with a place{}", name_of(*kind), way_out));
    return std::nullopt;
  }

 private:
  size_t number() const { return std::get<size_t>(which_); }

  WhichEvent which_;
  size_t number_ = 0;  ///< of the last event
  std::optional<Event> found_;
};

Result<std::optional<Event>> find_event(const WhichEvent& which, RecordingReader& recording,
                                        const GroundGiver& ground) {
  EventSearch search(which);
  const auto read =
      each_event(recording, ground, [&](const Event& event, const EventContext&) { search.add(event); });
  TRY(read);
  auto found = search.found();
  if (!found) return fail(recording.path() + ": " + found.error().message);
  return found;
}

/// The ticks from and to which a film goes when nobody says it.
struct Ends {
  double from;
  double to;
};

Ends ends_of(const FilmOrder& order, const std::optional<Event>& event, const RecordingReader& recording) {
  const double rate_hz = recording.header().world.tick_rate_hz;
  Ends ends{static_cast<double>(recording.first_tick()) - 1.0, static_cast<double>(recording.last_tick())};
  const Ends all = ends;
  if (event) ends.from = std::max(ends.from, static_cast<double>(event->tick) - before_event_s * rate_hz);
  if (order.from) ends.from = order.from->tick(recording.header().world.tick_rate_hz);
  if (event) ends.to = std::max(ends.from, static_cast<double>(event->tick)) + after_event_s * rate_hz;
  if (const auto* path = std::get_if<CameraPath>(&order.camera))
    ends.to = ends.from + path->duration_s() * order.speed * rate_hz;
  ends.to = std::min(ends.to, all.to);
  if (order.to) ends.to = order.to->tick(recording.header().world.tick_rate_hz);
  return ends;
}

Result<FilmSpan> span_of(const FilmOrder& order, const std::optional<Event>& event,
                         const RecordingReader& recording) {
  const Ends ends = ends_of(order, event, recording);
  const auto first = static_cast<double>(recording.first_tick()) - 1.0;
  const auto last = static_cast<double>(recording.last_tick());
  for (const auto& [name, tick] : {std::pair("--from", ends.from), std::pair("--to", ends.to)})
    if (!(tick >= first && tick <= last))
      return fail(fmt::format("{}: there is no tick {:.0f} in it ({}); its ticks are {:.0f} to {:.0f}",
                              recording.path(), tick, name, first, last));
  if (ends.to < ends.from)
    return fail(fmt::format("the film would end (tick {:.0f}, --to) before it begins (tick {:.0f}, --from)",
                            ends.to, ends.from));
  FilmSpan span{.from_tick = ends.from,
                .ticks_per_frame = order.speed * recording.header().world.tick_rate_hz / order.frames_per_s};
  const double frames = std::floor((ends.to - ends.from) / span.ticks_per_frame + rounding);
  if (frames > static_cast<double>(limits::film_frames_max))
    return fail(fmt::format(
        "the film would have {:.0f} frames, over {} (limits.film_frames_max): --from, --to, --fps and "
        "--speed make it shorter",
        frames, limits::film_frames_max));
  span.frames = std::max(static_cast<size_t>(frames), size_t{1});
  return span;
}

Result<Shot> eye_shot(const PersonsEye& eye, const FilmOrder& order, const FilmSpan& span,
                      RecordingReader& recording) {
  std::vector<double> ticks;
  for (size_t frame = 0; frame < span.frames; ++frame) ticks.push_back(span.tick(frame));
  auto shot = TRY(EyeShot::of(eye.person, recording, ticks, order.frames_per_s));
  return shot;
}

/// As it stands at the film's first moment.
Result<Shot> spawn_shot(const FilmSpan& span, const RecordingReader& recording, const GroundGiver& ground) {
  const auto source = TRY(ReplaySource::open(recording.path(), static_cast<Tick>(span.from_tick), ground));
  auto camera = camera_of(source->spawn());
  if (!camera) return fail(recording.path() + ": " + camera.error().message);
  return Shot(*camera);
}

Result<Shot> shot_of(const FilmOrder& order, const std::optional<Event>& event, const FilmSpan& span,
                     RecordingReader& recording, const GroundGiver& ground) {
  if (const auto* camera = std::get_if<Camera>(&order.camera)) return *camera;
  if (const auto* path = std::get_if<CameraPath>(&order.camera)) return *path;
  if (const auto* eye = std::get_if<PersonsEye>(&order.camera)) return eye_shot(*eye, order, span, recording);
  if (!event) return spawn_shot(span, recording, ground);
  const auto field = TRY(field_at(recording.path(), static_cast<Tick>(span.from_tick), ground));
  return Orbit::around(*event, *field, static_cast<double>(span.frames) / order.frames_per_s);
}

}  // namespace

Result<WhichEvent> parse_event(const std::string& text) {
  if (const auto kind = kind_named<EventKind>(text)) return *kind;
  if (const auto number = number_in<uint32_t>(text); number && *number > 0) return size_t{*number};
  return fail("'" + text +
              "' is not an event: write its number in `scree replay events`, from 1, or one of " +
              listed(kind_names<EventKind>));
}

Result<FilmPlan> plan_film(const FilmOrder& order, const std::string& path, const GroundGiver& ground) {
  const auto recording = TRY(RecordingReader::open(path));
  FilmPlan plan;
  if (const auto* which = std::get_if<WhichEvent>(&order.camera)) {
    const auto event = TRY(find_event(*which, *recording, ground));
    plan.event = event;  // of what happened, if anything did
  }
  const auto span = TRY(span_of(order, plan.event, *recording));
  plan.span = span;
  auto shot = TRY(shot_of(order, plan.event, plan.span, *recording, ground));
  plan.shot = std::move(shot);
  return plan;
}

}  // namespace scree
