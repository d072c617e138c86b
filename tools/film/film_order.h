// What a film shall show of a recording: which moments, and from where.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "client/viewer/pictures/camera_path.h"
#include "proto/event.h"
#include "server/replay/recorded_moment.h"
#include "server/replay/replay_source.h"
#include "tools/film/shot.h"

namespace scree {

/// Round which event: the one of that number, counted from 1 in the order of `replay events`; or the largest
/// of a kind; or, of neither, the largest of all.
using WhichEvent = std::variant<std::monostate, size_t, EventKind>;
Result<WhichEvent> parse_event(const std::string& text);

/// By whose eye: the name of a person who was there (EyeShot::of).
struct PersonsEye {
  std::string person;
};

/// From where visitors of the world begin.
struct AtSpawn {};

struct FilmOrder {
  std::optional<TickOrTime> from{};
  std::optional<TickOrTime> to{};
  double frames_per_s = 30.0;
  double speed = 1.0;  ///< seconds of the recording in one of the film
  /// From where; WhichEvent: an orbit round it, or, where nothing happened and none is asked for, AtSpawn.
  std::variant<WhichEvent, Camera, CameraPath, PersonsEye, AtSpawn> camera{};
};

/// The ticks of a film's frames.
struct FilmSpan {
  double from_tick = 0.0;
  double ticks_per_frame = 1.0;
  size_t frames = 1;

  double tick(size_t frame) const { return from_tick + ticks_per_frame * static_cast<double>(frame); }
};

struct FilmPlan {
  FilmSpan span;
  Shot shot;
  std::optional<Event> event;  ///< of an orbit
};

/// Finds the event, and what was not said: an orbit begins shortly before its event and ends some seconds
/// after it; a path's film is as long as the path; any other shows the whole recording. The error says what
/// the recording has not, or what would be too much.
Result<FilmPlan> plan_film(const FilmOrder& order, const std::string& recording, const GroundGiver& ground);

}  // namespace scree
