#include "tools/film/eye_shot.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "client/render/scene/look_at.h"
#include "proto/person_name.h"
#include "server/replay/recorded_cursors.h"
#include "tools/film/limits.h"

namespace scree {

namespace {

/// Whom of those who were there it is about.
class PersonSearch {
 public:
  explicit PersonSearch(const std::string& person) : person_(person) {}

  std::optional<PlayerCursor> among(const std::vector<PlayerCursor>& cursors) {
    std::optional<PlayerCursor> found;
    for (const PlayerCursor& cursor : cursors) {
      const std::string name = called(cursor.session, cursor.name);
      const bool by_number = cursor.name.empty() && std::to_string(cursor.session) == person_;
      if (!found && (name == person_ || by_number)) found = cursor;
      if (seen_.size() < limits::persons_named_max) seen_.insert(name);
    }
    return found;
  }
  tl::unexpected<Error> nobody(const std::string& path) const {
    std::string there;
    for (const std::string& name : seen_) there += (there.empty() ? "" : ", ") + name;
    return fail(path + ": the eye of '" + person_ + "' is not seen in these ticks (--from, --to)" +
                (there.empty() ? "; nobody is" : "; there are " + there));
  }

 private:
  const std::string person_;
  std::set<std::string> seen_;
};

/// Between the tick and the next one; where the person leaves meanwhile, as in the tick.
Result<std::optional<PlayerCursor>> cursor_at(double tick, PersonSearch& person, RecordedCursors& cursors,
                                              RecordingReader& recording) {
  const auto whole = static_cast<Tick>(tick);
  const auto part = static_cast<float>(tick - static_cast<double>(whole));
  const auto there = TRY(cursors.at(recording, whole));
  auto now = person.among(there);
  if (!now || part == 0.0F || whole == recording.last_tick()) return now;
  const auto then = TRY(cursors.at(recording, whole + 1));
  if (const auto next = person.among(then)) {
    now->eye_m = glm::mix(now->eye_m, next->eye_m, part);
    now->aim_m = glm::mix(now->aim_m, next->aim_m, part);
  }
  return now;
}

/// Who aims at his own eye goes on looking where he did.
void see(const PlayerCursor& cursor, Camera& camera) {
  if (glm::distance(cursor.eye_m, cursor.aim_m) > limits::aim_min_m)
    camera = look_at(cursor.eye_m, cursor.aim_m);
  camera.eye_m = cursor.eye_m;
  camera.pitch = glm::clamp(camera.pitch, -limits::eye_pitch_max, limits::eye_pitch_max);
}

}  // namespace

Result<EyeShot> EyeShot::of(const std::string& name, RecordingReader& recording,
                            std::span<const double> ticks, double frames_per_s) {
  EyeShot shot;
  shot.frames_per_s_ = frames_per_s;
  PersonSearch person(name);
  RecordedCursors cursors;
  std::optional<Camera> camera;
  for (const double tick : ticks) {
    const auto cursor = TRY(cursor_at(tick, person, cursors, recording));
    if (cursor.has_value()) {
      const bool is_first = !camera;
      if (is_first) camera.emplace();
      see(*cursor, *camera);
      if (is_first) std::ranges::fill(shot.frames_, *camera);
    }
    shot.frames_.push_back(camera.value_or(Camera()));
  }
  if (!camera) return person.nobody(recording.path());
  return shot;
}

Camera EyeShot::at(double time_s) const {
  const auto frame = static_cast<size_t>(std::lround(std::max(time_s, 0.0) * frames_per_s_));
  return frames_[std::min(frame, frames_.size() - 1)];
}

}  // namespace scree
