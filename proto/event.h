// The log of events: what happened in a world, and to the server that ran it, as recordings keep it and
// --events writes it.
//
// World events follow from the simulation: who verifies a recording derives them again and compares. Events
// of the machine (who joined, which tick was slow) do not, and are recorded apart.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "proto/cursor.h"
#include "shared/base/ids.h"
#include "shared/base/kind_table.h"

namespace scree {

/// The numbers are those in recordings: new ones come last.
enum class EventKind : uint8_t {
  carve,
  fill,
  paint,
  dent,
  crush,
  broke,
  fall,
  merge,
  setting,
  rebuild,
  join,
  leave,
  slow,
  contact,
  joint_ended,
  prop_added,
  prop_removed,
  region_enter,
  region_leave,
  hurt,
  buried,
  dig,
  place,
};

struct EventRow {
  EventKind kind{};
  std::string_view name;
  bool of_machine = false;  ///< it does not follow from the simulation
  std::string_view what;
};

constexpr EventRow row_of(EventKind kind) {
  switch (kind) {
    case EventKind::carve:
      return {kind, "carve", false, "a carve that was asked for; volume and pieces: cut out"};
    case EventKind::fill:
      return {kind, "fill", false, "a fill"};
    case EventKind::paint:
      return {kind, "paint", false, "a paint"};
    case EventKind::dent:
      return {kind, "dent", false, "a blow dented soft ground; volume and pieces: thrown out"};
    case EventKind::crush:
      return {kind, "crush", false, "a neck was crushed by the load on it; volume and pieces: cut out"};
    case EventKind::broke:
      return {kind, "break", false, "a blow broke a piece; volume and pieces: the fragments"};
    case EventKind::fall:
      return {kind, "fall", false, "loose terrain became a piece, or dust"};
    case EventKind::merge:
      return {kind, "merge", false,
              "pieces became terrain near each other within a second; place: the first one"};
    case EventKind::setting:
      return {kind, "setting", false, "a setting changed; text: its name and value"};
    case EventKind::rebuild:
      return {kind, "rebuild", true, "a server built the world anew from its saved value"};
    case EventKind::join:
      return {kind, "join", true, "a session joined, or came back; place: its eye; text: the person's name"};
    case EventKind::leave:
      return {kind, "leave", true, "a session's connection ended; text: the person's name"};
    case EventKind::slow:
      return {kind, "slow", true,
              "the tick's simulation took longer than a tick's time; ms: how long; text: its longest stage; "
              "place "
              "and session: of the largest operation in that"};
    case EventKind::contact:
      return {
          kind, "contact", false,
          "a hard blow; body, other, normal, impulse and energy: of it; left_out: so many others were not "
          "told in the last second, of which it was the hardest"};
    case EventKind::joint_ended:
      return {kind, "joint_ended", false,
              "a joint is no more; text: why; body and other: that it held; session: who removed it"};
    case EventKind::prop_added:
      return {kind, "prop_added", false, "a prop was added; body: the prop; tag: its own"};
    case EventKind::prop_removed:
      return {kind, "prop_removed", false, "a prop was removed, or left the world; body and tag likewise"};
    case EventKind::region_enter:
      return {
          kind, "region_enter", false,
          "the middle of a piece or a prop came into a region that tells; text: its name; body and tag: of "
          "what came"};
    case EventKind::region_leave:
      return {kind, "region_leave", false, "it left the region, or is no more; text, body and tag likewise"};
    case EventKind::hurt:
      return {
          kind, "hurt", false,
          "a piece or a prop struck a person on foot; body and tag: the person's body and session; other: "
          "what struck; energy: of the blow; session: the party that made what struck"};
    case EventKind::buried:
      return {kind, "buried", false,
              "rock closed around a person on foot, who could not be pushed out; body, tag: likewise"};
    case EventKind::dig:
      return {kind, "dig", false, "terrain or a piece was dug; volume: into the store; body: the piece"};
    case EventKind::place:
      return {kind, "place", false, "a shape was placed; volume: out of the store"};
  }
  return {};
}

struct Event {
  EventKind kind{};
  Tick tick = 0;
  std::optional<glm::vec3> place_m{};  ///< nothing where it has no place
  float volume_m3 = 0.0F;
  uint32_t pieces = 0;
  uint64_t session = 0;  ///< who asked for it, or joined or left; 0: it is nobody's
  float ms = 0.0F;       ///< of the tick; of machine events alone, for a simulation knows no time
  std::string text{};
  uint64_t token_id = 0;  ///< of the access token, by which a session joined or left; 0: none

  PieceId body = 0, other = 0;  ///< that take part; 0: the terrain, or nothing
  uint64_t tag = 0;             ///< of a prop (Prop::tag)
  glm::vec3 normal{0.0F};       ///< of a contact: unit, towards `body`
  float impulse_n_s = 0.0F;     ///< of a contact, along the normal
  float energy_j = 0.0F;        ///< that a contact took
  uint32_t left_out = 0;        ///< contacts since the last such event that are told by none

  bool operator==(const Event&) const = default;
};

/// Who a session is.
struct Participant {
  uint64_t session = 0;
  std::string name{};
  uint64_t token_id = 0;  ///< of the access token; 0: none

  bool operator==(const Participant&) const = default;
};

/// What a recording holds of the machine at one of its ticks: the durations of the ticks since the last such
/// row, this one's last, and the events and the persons' cursors in them.
struct RecordedMachine {
  Tick tick = 0;
  std::vector<uint32_t> tick_us;
  std::vector<Event> events;
  std::vector<CursorSample> cursors{};  ///< ascending; the first has all persons
  uint64_t unix_ms = 0;                 ///< when its tick was written, ms since 1970; 0: it is not known
  std::vector<Participant> persons{};   ///< where a part of a recording begins: who joined before
};

}  // namespace scree
