// What a game's rules do, derived from a fuzzer's bytes: mostly sane. Encoders trust the kinds.
#pragma once

#include "shared/game/rules_act.h"
#include "tests/fuzz/support/any_request.h"

namespace scree {

inline Audience any_audience(FuzzInput& input) {
  Audience to{.kind = any_kind<AudienceKind>(input)};
  if (to.kind == AudienceKind::session) to.session = 1 + input.below(4);
  if (to.kind == AudienceKind::team) to.team = "red";
  return to;
}

inline Sign any_sign(FuzzInput& input) {
  Sign sign{.name = std::string(1, static_cast<char>('a' + input.below(8))), .to = any_audience(input)};
  if (input.below(16) == 15) sign.name = input.text(limits::sign_name_bytes_max + 4);
  sign.kind = any_kind<SignKind>(input);
  if (input.flag()) sign.text = input.text(limits::sign_text_bytes_max + 4);
  sign.share = input.below(16) == 15 ? input.coordinate(4.0F) : input.between(0.0F, 1.0F);
  sign.place_m = any_place(input);
  sign.until = input.byte();
  sign.counts = input.flag();
  return sign;
}

inline Cue any_cue(FuzzInput& input) {
  const float size_m = std::abs(input.coordinate(16.0F));
  return {any_kind<CueKind>(input), any_place(input), size_m, std::abs(input.coordinate(1e5F)),
          any_material(input)};
}

inline ChannelData any_channel_data(FuzzInput& input) {
  const auto bytes = input.bytes(input.byte());
  return {input.below(16) == 15 ? input.text(limits::channel_bytes_max + 4) : "shop",
          {bytes.begin(), bytes.end()}};
}

inline Notice any_notice(FuzzInput& input) {
  switch (input.below(3)) {
    case 0:
      return {any_audience(input), NoticeLine{input.flag() ? "it falls" : input.text(64)}};
    case 1:
      return {any_audience(input), any_cue(input)};
    default:
      return {any_audience(input), any_channel_data(input)};
  }
}

inline RulesAct any_rules_act(FuzzInput& input) {
  const std::string key(1, static_cast<char>('a' + input.below(8)));
  switch (input.below(6)) {
    case 0:
      return KeepValue{{key, input.text(64)}};
    case 1:
      return ForgetValue{key};
    case 2:
      return ShowSign{any_sign(input)};
    case 3:
      return RemoveSign{any_audience(input), key};
    case 4:
      return SetPlayer{input.below(4), "red", input.between(0.0F, 3.0F), std::nullopt};
    default:
      return any_notice(input);
  }
}

}  // namespace scree
