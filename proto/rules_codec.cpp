#include "proto/rules_codec.h"

#include <rules.pb.h>

#include "proto/game_codec.h"
#include "proto/operation_codec.h"
#include "shared/base/overloaded.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

void refuse_where_invalid(const Result<void>& valid, FieldChecker& check) {
  if (!valid && !check.failed()) check.refuse(valid.error().message);
}

struct WritingRules {
  wire::Rules& to;

  void operator()(const KeepValue& from) const {
    to.mutable_keep()->set_key(from.value.key);
    to.mutable_keep()->set_value(from.value.value);
  }
  void operator()(const ForgetValue& from) const { to.set_forget(from.key); }
  void operator()(const ShowSign& from) const { write(*to.mutable_show(), from.sign); }
  void operator()(const RemoveSign& from) const {
    if (from.to != Audience{}) scree::write(*to.mutable_remove()->mutable_to(), from.to);
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
  refuse_where_invalid(validate(Player{player.session, player.team.value_or(""), player.pace.value_or(1.0F)}),
                       check);
  return player;
}

RulesAct read_rules_act(const wire::Rules& from, FieldChecker& check) {
  switch (from.act_case()) {
    case wire::Rules::kKeep: {
      KeepValue keep{{from.keep().key(), from.keep().value()}};
      refuse_where_invalid(validate(keep.value), check);
      return keep;
    }
    case wire::Rules::kForget:
      refuse_where_invalid(validate(KeptValue{from.forget(), ""}), check);
      return ForgetValue{from.forget()};
    case wire::Rules::kShow:
      return ShowSign{read(from.show(), check)};
    case wire::Rules::kRemove: {
      RemoveSign remove{read(from.remove().to(), check), from.remove().name()};
      refuse_where_invalid(validate(Sign{.name = remove.name, .to = remove.to}), check);
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

void write(wire::Notice& to, const Notice& from) {
  if (from.to != Audience{}) write(*to.mutable_to(), from.to);
  std::visit(Overloaded{[&](const NoticeLine& line) { to.set_line(line.text); },
                        [&](const Cue& cue) { write(*to.mutable_cue(), cue); },
                        [&](const ChannelData& data) { write(*to.mutable_data(), data); }},
             from.what);
}

std::string pack_rules(const RulesMessage& from) {
  wire::Rules to;
  to.set_request(from.request);
  std::visit(WritingRules{to}, from.act);
  return to.SerializeAsString();
}

Notice read(const wire::Notice& from, FieldChecker& check) {
  Notice notice;
  notice.to = read(from.to(), check);
  switch (from.what_case()) {
    case wire::Notice::kLine:
      notice.what = NoticeLine{from.line()};
      break;
    case wire::Notice::kCue:
      notice.what = read(from.cue(), check);
      break;
    case wire::Notice::kData:
      notice.what = ChannelData(read(from.data(), check));
      break;
    case wire::Notice::WHAT_NOT_SET:
      check.refuse("a notice of nothing");
      return notice;
  }
  refuse_where_invalid(validate(notice), check);
  return notice;
}

RulesMessage unpack_rules(const std::string& packed, FieldChecker& check) {
  wire::Rules from;
  if (!from.ParseFromString(packed)) {
    check.refuse("the bytes of an act of rules are none");
    return {};
  }
  RulesMessage rules;
  rules.request = from.request();
  rules.act = read_rules_act(from, check);
  return rules;
}

std::string pack_restore(const RestoreMessage& from) {
  wire::Restore to;
  to.set_request(from.request);
  std::vector<BrickView> views;
  if (from.bricks != nullptr)
    for (const RestoreRequest::Brick& brick : *from.bricks) {
      views.push_back({brick.then.coord, &brick.then.brick, brick.then.materials});
      to.add_now(brick.now);
    }
  to.set_bricks(to_string(encode_bricks(views)));
  for (const PieceId piece : from.pieces) to.add_pieces(piece);
  to.set_loose(pack_chunks(from.loose));
  return to.SerializeAsString();
}

RestoreMessage unpack_restore(const std::string& packed, FieldChecker& check) {
  wire::Restore from;
  RestoreMessage restore;
  if (!from.ParseFromString(packed)) {
    check.refuse("the bytes of a restore are none");
    return restore;
  }
  restore.request = from.request();
  auto bricks = check.value_or_refuse(decode_bricks(as_span(from.bricks()), limits::restored_bricks_max));
  if (bricks.size() != static_cast<size_t>(from.now_size()))
    check.refuse("a restore has other hashes than bricks");
  if (from.pieces_size() > static_cast<int>(limits::restored_pieces_max))
    check.refuse("a restore has more pieces than limits.restored_pieces_max");
  restore.loose = check.chunks(from.loose(), limits::loose_chunks_max, "loose chunks of a restore");
  if (check.failed()) return restore;
  auto taken = std::make_shared<std::vector<RestoreRequest::Brick>>();
  for (size_t i = 0; i < bricks.size(); ++i)
    taken->push_back({std::move(bricks[i]), from.now(static_cast<int>(i))});
  if (!taken->empty()) restore.bricks = std::move(taken);
  for (const uint32_t piece : from.pieces()) restore.pieces.push_back(piece);
  return restore;
}

}  // namespace scree
