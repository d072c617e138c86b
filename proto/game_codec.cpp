#include "proto/game_codec.h"

#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

static_assert(wire::AudienceKind_ARRAYSIZE == kind_count<AudienceKind>);
static_assert(wire::SignKind_ARRAYSIZE == kind_count<SignKind>);
static_assert(wire::CueKind_ARRAYSIZE == kind_count<CueKind>);
static_assert(wire::RulesControl_ARRAYSIZE == kind_count<RulesControl>);

constexpr int byte_bits = 8;

void refuse_invalid(const Result<void>& valid, FieldChecker& check) {
  if (!valid && !check.failed()) check.refuse(valid.error().message);
}

}  // namespace

void write(wire::Audience& to, const Audience& from) {
  to.set_kind(static_cast<wire::AudienceKind>(from.kind));
  to.set_session(from.session);
  to.set_team(from.team);
}

Audience read(const wire::Audience& from, FieldChecker& check) {
  return {check.kind<AudienceKind>(from.kind(), "kind of audience"), from.session(), from.team()};
}

void write(wire::Sign& to, const Sign& from) {
  to.set_name(from.name);
  if (from.to != Audience{}) write(*to.mutable_to(), from.to);
  to.set_kind(static_cast<wire::SignKind>(from.kind));
  to.set_text(from.text);
  to.set_share(from.share);
  if (from.kind == SignKind::marker) write(*to.mutable_place(), from.place_m);
  uint32_t colour = 0;
  for (const uint8_t part : from.colour) colour = colour << byte_bits | part;
  to.set_colour(colour);
  to.set_until(from.until);
  to.set_counts(from.counts);
}

Sign read(const wire::Sign& from, FieldChecker& check) {
  Sign sign;
  sign.name = from.name();
  sign.to = read(from.to(), check);
  sign.kind = check.kind<SignKind>(from.kind(), "kind of sign");
  sign.text = from.text();
  sign.share = check.finite(from.share(), "share of a sign");
  sign.place_m = check.vec3(from.place(), "place of a sign");
  uint32_t colour = check.within(from.colour(), 0, 0xFFFFFF, "colour of a sign");
  for (size_t i = sign.colour.size(); i-- > 0; colour >>= byte_bits)
    sign.colour[i] = static_cast<uint8_t>(colour);
  sign.until = from.until();
  sign.counts = from.counts();
  refuse_invalid(validate(sign), check);
  return sign;
}

void write(wire::Cue& to, const Cue& from) {
  to.set_kind(static_cast<wire::CueKind>(from.kind));
  write(*to.mutable_place(), from.place_m);
  to.set_size_m(from.size_m);
  to.set_energy_j(from.energy_j);
  to.set_material(static_cast<uint32_t>(row_number(from.material)));
}

Cue read(const wire::Cue& from, FieldChecker& check) {
  Cue cue;
  cue.kind = check.kind<CueKind>(from.kind(), "kind of cue");
  cue.place_m = check.vec3(from.place(), "place of a cue");
  cue.size_m = check.finite(from.size_m(), "size of a cue");
  cue.energy_j = check.finite(from.energy_j(), "energy of a cue");
  cue.material = static_cast<Material>(check.within(from.material(), 0, materials_max - 1, "material"));
  refuse_invalid(validate(Notice{{}, cue}), check);
  return cue;
}

ChannelData read_data(const wire::ChannelData& from, FieldChecker& check) {
  ChannelData data{from.channel(), {from.data().begin(), from.data().end()}};
  refuse_invalid(validate(data), check);
  return data;
}

void write(wire::ChannelData& to, const ChannelData& from) {
  to.set_channel(from.channel);
  to.set_data(std::string(from.bytes.begin(), from.bytes.end()));
}

void write(wire::Signs& to, const SignsMessage& from) {
  CHECK(from.signs.size() <= limits::signs_max);
  for (const Sign& sign : from.signs) write(*to.add_signs(), sign);
}

void write(wire::Cues& to, const CuesMessage& from) {
  CHECK(from.cues.size() <= limits::notices_a_tick_max);
  to.set_tick(from.tick);
  for (const Cue& cue : from.cues) write(*to.add_cues(), cue);
}

void write(wire::ControlRules& to, const ControlRulesRequest& from) {
  to.set_control(static_cast<wire::RulesControl>(from.control));
  to.set_rules(showable(from.rules, limits::region_name_bytes_max));
  to.set_line(from.line.substr(0, limits::console_line_bytes_max));
}

ChannelMessage read(const wire::ChannelData& from, FieldChecker& check) {
  return {read_data(from, check)};
}

SignsMessage read(const wire::Signs& from, FieldChecker& check) {
  SignsMessage message;
  if (static_cast<size_t>(from.signs_size()) > limits::signs_max)
    check.refuse(fmt::format("{} signs are over the limit of {}", from.signs_size(), limits::signs_max));
  for (const wire::Sign& one : from.signs()) {
    if (check.failed()) break;
    Sign sign = read(one, check);
    if (!message.signs.empty() && !sign_before(message.signs.back(), sign))
      check.refuse("signs are not in order");
    message.signs.push_back(std::move(sign));
  }
  return message;
}

CuesMessage read(const wire::Cues& from, FieldChecker& check) {
  CuesMessage message{from.tick(), {}};
  if (static_cast<size_t>(from.cues_size()) > limits::notices_a_tick_max)
    check.refuse(
        fmt::format("{} cues are over the limit of {}", from.cues_size(), limits::notices_a_tick_max));
  for (const wire::Cue& one : from.cues()) {
    if (check.failed()) break;
    if (static_cast<size_t>(one.kind()) < kind_count<CueKind>) message.cues.push_back(read(one, check));
  }
  return message;
}

ControlRulesRequest read(const wire::ControlRules& from, FieldChecker& check) {
  return {check.asked_kind<RulesControl>(from.control(), "act about rules"),
          check.text(from.rules(), limits::region_name_bytes_max, "name of rules"),
          check.text(from.line(), limits::console_line_bytes_max, "line for rules")};
}

}  // namespace scree
