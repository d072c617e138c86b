// The checks of signs, notices and what is kept.
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <tuple>

#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/plain_number.h"
#include "shared/base/text.h"
#include "shared/base/walking.h"
#include "shared/game/kept.h"
#include "shared/game/notice.h"
#include "shared/game/rules_act.h"
#include "shared/game/sign.h"

namespace scree {

namespace {

Result<void> check_words(const std::string& text, size_t most, bool may_be_empty, const std::string& whose) {
  if ((text.empty() && !may_be_empty) || text.size() > most)
    return fail(whose + " has " + (may_be_empty ? "at most " : "1 to ") + std::to_string(most) + " bytes");
  if (const auto fault = fault_of_text(text)) return fail(whose + " " + std::string(*fault));
  return {};
}

Result<void> check_in_world(glm::vec3 place_m, const std::string& whose) {
  const glm::vec3 far = glm::abs(place_m);
  if (std::isfinite(place_m.x) && std::isfinite(place_m.y) && std::isfinite(place_m.z) &&
      std::max(far.x, far.z) <= limits::world_half_width_m && far.y <= limits::world_half_height_m)
    return {};
  return fail(whose + " is not a place in the world");
}

Result<void> check_cue(const Cue& cue) {
  TRY(validate_kind(cue.kind, "kind of cue"));
  TRY(check_in_world(cue.place_m, "the place of a cue"));
  if (!(cue.size_m > 0.0F && cue.size_m <= limits::cue_size_max_m))
    return fail("the size of a cue must lie " + range_text(0.0, limits::cue_size_max_m, "m"));
  if (!(cue.energy_j > 0.0F && cue.energy_j <= limits::cue_energy_max_j))
    return fail("the energy of a cue must lie " + range_text(0.0, limits::cue_energy_max_j, "J"));
  if (row_number(cue.material) < materials_max) return {};
  return fail("the material of a cue is over the last of a palette");
}

/// Teams are named as regions and access tokens name them.
constexpr size_t team_bytes_max = 32;

}  // namespace

bool is_meant(const Audience& audience, uint64_t session, const std::string& team) {
  switch (audience.kind) {
    case AudienceKind::all:
      return true;
    case AudienceKind::session:
      return audience.session == session;
    case AudienceKind::team:
      return !team.empty() && audience.team == team;
  }
  return false;
}

bool sign_before(const Sign& a, const Sign& b) {
  return std::tie(a.to, a.name) < std::tie(b.to, b.name);
}

Result<void> validate(const Audience& audience) {
  TRY(validate_kind(audience.kind, "kind of audience"));
  if ((audience.kind == AudienceKind::session) != (audience.session != 0))
    return fail("an audience names a session where it is one, and else none");
  if (audience.kind == AudienceKind::team)
    return check_words(audience.team, team_bytes_max, false, "the team of an audience");
  if (!audience.team.empty()) return fail("an audience names a team where it is none");
  return {};
}

Result<void> validate(const Sign& sign) {
  TRY(check_words(sign.name, limits::sign_name_bytes_max, false, "the name of a sign"));
  TRY(validate(sign.to));
  TRY(validate_kind(sign.kind, "kind of sign"));
  TRY(check_words(sign.text, limits::sign_text_bytes_max, true, "the text of a sign"));
  if (!(sign.share >= 0.0F && sign.share <= 1.0F)) return fail("the share of a bar must lie 0 to 1");
  TRY(check_in_world(sign.place_m, "the place of a marker"));
  if (sign.counts && sign.until == 0) return fail("a sign that counts has an end");
  return {};
}

Result<void> validate(const ChannelData& data) {
  TRY(check_words(data.channel, limits::channel_bytes_max, false, "the channel of a message"));
  if (data.bytes.size() <= limits::channel_data_bytes_max) return {};
  return fail("a message of rules has at most " + std::to_string(limits::channel_data_bytes_max) + " bytes");
}

Result<void> validate(const Notice& notice) {
  TRY(validate(notice.to));
  return std::visit(Overloaded{[](const NoticeLine& line) {
                                 return check_words(line.text, limits::notice_line_bytes_max, false,
                                                    "a line");
                               },
                               [](const Cue& cue) { return check_cue(cue); },
                               [](const ChannelData& data) { return validate(data); }},
                    notice.what);
}

Result<void> validate(const KeptValue& value) {
  TRY(check_words(value.key, limits::kept_key_bytes_max, false, "the key of a kept value"));
  if (value.value.size() <= limits::kept_value_bytes_max) return {};
  return fail("a kept value has at most " + std::to_string(limits::kept_value_bytes_max) + " bytes");
}

std::string text_of(const RulesAct& act) {
  return std::visit(
      Overloaded{[](const KeepValue& keep) { return "keep " + keep.value.key; },
                 [](const ForgetValue& forget) { return "forget " + forget.key; },
                 [](const ShowSign& show) { return "show the sign " + show.sign.name; },
                 [](const RemoveSign& remove) { return "remove the sign " + remove.name; },
                 [](const SetPlayer& player) {
                   return "change the person of session " + std::to_string(player.session);
                 },
                 [](const Notice& notice) {
                   return std::visit(
                       Overloaded{
                           [](const NoticeLine& line) { return "say " + line.text; },
                           [](const Cue& cue) { return "cue " + std::string(row_of(cue.kind).name); },
                           [](const ChannelData& data) { return "send to the channel " + data.channel; }},
                       notice.what);
                 }},
      act);
}

Result<void> validate(const Player& player) {
  if (player.session == 0) return fail("the server itself has no person");
  TRY(check_words(player.team, team_bytes_max, true, "the name of a team"));
  if (player.pace >= 0.0F && player.pace <= limits::walk_pace_max) return {};
  return fail("a person's pace must lie " + range_text(0.0, limits::walk_pace_max, "times the usual"));
}

}  // namespace scree
