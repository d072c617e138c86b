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

void write_audience(wire::Audience& to, const Audience& from) {
  to.set_kind(static_cast<wire::AudienceKind>(from.kind));
  to.set_session(from.session);
  to.set_team(from.team);
}

Audience read_audience(const wire::Audience& from, FieldChecker& check) {
  return {check.kind<AudienceKind>(from.kind(), "kind of audience"), from.session(), from.team()};
}

void write_sign(wire::Sign& to, const Sign& from) {
  to.set_name(from.name);
  if (from.to != Audience{}) write_audience(*to.mutable_to(), from.to);
  to.set_kind(static_cast<wire::SignKind>(from.kind));
  to.set_text(from.text);
  to.set_share(from.share);
  if (from.kind == SignKind::marker) scree::write(*to.mutable_place(), from.place_m);
  uint32_t colour = 0;
  for (const uint8_t part : from.colour) colour = colour << byte_bits | part;
  to.set_colour(colour);
  to.set_until(from.until);
  to.set_counts(from.counts);
}

Sign read_sign(const wire::Sign& from, FieldChecker& check) {
  Sign sign;
  sign.name = from.name();
  sign.to = read_audience(from.to(), check);
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

void write_cue(wire::Cue& to, const Cue& from) {
  to.set_kind(static_cast<wire::CueKind>(from.kind));
  scree::write(*to.mutable_place(), from.place_m);
  to.set_size_m(from.size_m);
  to.set_energy_j(from.energy_j);
  to.set_material(static_cast<uint32_t>(row_number(from.material)));
}

Cue read_cue(const wire::Cue& from, FieldChecker& check) {
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

struct WritingRules {
  wire::Rules& to;

  void operator()(const KeepValue& from) const {
    to.mutable_keep()->set_key(from.value.key);
    to.mutable_keep()->set_value(from.value.value);
  }
  void operator()(const ForgetValue& from) const { to.set_forget(from.key); }
  void operator()(const ShowSign& from) const { write_sign(*to.mutable_show(), from.sign); }
  void operator()(const RemoveSign& from) const {
    if (from.to != Audience{}) write_audience(*to.mutable_remove()->mutable_to(), from.to);
    to.mutable_remove()->set_name(from.name);
  }
  void operator()(const SetPlayer& from) const {
    wire::SetPlayer& player = *to.mutable_player();
    player.set_session(from.session);
    if (from.team) player.set_team(*from.team);
    if (from.pace) player.set_pace(*from.pace);
    if (from.place_m) scree::write(*player.mutable_place(), *from.place_m);
  }
  void operator()(const Notice& from) const { write(*to.mutable_notice(), from); }
};

SetPlayer read_player(const wire::SetPlayer& from, FieldChecker& check) {
  SetPlayer player;
  player.session = from.session();
  if (from.has_team()) player.team = from.team();
  if (from.has_pace()) player.pace = check.finite(from.pace(), "pace of a person");
  if (from.has_place()) player.place_m = check.vec3(from.place(), "place of a person");
  refuse_invalid(validate(Player{player.session, player.team.value_or(""), player.pace.value_or(1.0F)}),
                 check);
  return player;
}

RulesAct read_rules_act(const wire::Rules& from, FieldChecker& check) {
  switch (from.act_case()) {
    case wire::Rules::kKeep: {
      KeepValue keep{{from.keep().key(), from.keep().value()}};
      refuse_invalid(validate(keep.value), check);
      return keep;
    }
    case wire::Rules::kForget:
      refuse_invalid(validate(KeptValue{from.forget(), ""}), check);
      return ForgetValue{from.forget()};
    case wire::Rules::kShow:
      return ShowSign{read_sign(from.show(), check)};
    case wire::Rules::kRemove: {
      RemoveSign remove{read_audience(from.remove().to(), check), from.remove().name()};
      refuse_invalid(validate(Sign{.name = remove.name, .to = remove.to}), check);
      return remove;
    }
    case wire::Rules::kPlayer:
      return read_player(from.player(), check);
    case wire::Rules::kNotice:
      return read(from.notice(), check);
    case wire::Rules::ACT_NOT_SET:
      break;
  }
  check.refuse("an act of rules of an unknown kind");
  return ForgetValue{};
}

}  // namespace

void write(wire::ChannelData& to, const ChannelData& from) {
  to.set_channel(from.channel);
  to.set_data(std::string(from.bytes.begin(), from.bytes.end()));
}

void write(wire::Signs& to, const SignsMessage& from) {
  CHECK(from.signs.size() <= limits::signs_max);
  for (const Sign& sign : from.signs) write_sign(*to.add_signs(), sign);
}

void write(wire::Cues& to, const CuesMessage& from) {
  CHECK(from.cues.size() <= limits::notices_a_tick_max);
  to.set_tick(from.tick);
  for (const Cue& cue : from.cues) write_cue(*to.add_cues(), cue);
}

void write(wire::Notice& to, const Notice& from) {
  if (from.to != Audience{}) write_audience(*to.mutable_to(), from.to);
  std::visit(Overloaded{[&](const NoticeLine& line) { to.set_line(line.text); },
                        [&](const Cue& cue) { write_cue(*to.mutable_cue(), cue); },
                        [&](const ChannelData& data) { write(*to.mutable_data(), data); }},
             from.what);
}

void write(wire::Rules& to, const RequestMessage<RulesRequest>& from) {
  to.set_request(from.request);
  std::visit(WritingRules{to}, from.act);
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
    Sign sign = read_sign(one, check);
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
    if (static_cast<size_t>(one.kind()) < kind_count<CueKind>) message.cues.push_back(read_cue(one, check));
  }
  return message;
}

Notice read(const wire::Notice& from, FieldChecker& check) {
  Notice notice;
  notice.to = read_audience(from.to(), check);
  switch (from.what_case()) {
    case wire::Notice::kLine:
      notice.what = NoticeLine{from.line()};
      break;
    case wire::Notice::kCue:
      notice.what = read_cue(from.cue(), check);
      break;
    case wire::Notice::kData:
      notice.what = read_data(from.data(), check);
      break;
    case wire::Notice::WHAT_NOT_SET:
      check.refuse("a notice of nothing");
      return notice;
  }
  refuse_invalid(validate(notice), check);
  return notice;
}

RequestMessage<RulesRequest> read(const wire::Rules& from, FieldChecker& check) {
  return {{read_rules_act(from, check)}, from.request()};
}

ControlRulesRequest read(const wire::ControlRules& from, FieldChecker& check) {
  return {check.asked_kind<RulesControl>(from.control(), "act about rules"),
          check.text(from.rules(), limits::region_name_bytes_max, "name of rules"),
          check.text(from.line(), limits::console_line_bytes_max, "line for rules")};
}

}  // namespace scree
