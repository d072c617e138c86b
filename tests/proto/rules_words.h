// What a game's rules show, tell and keep in words, as message_words.h.
#pragma once

#include "shared/game/rules_act.h"
#include "tests/proto/message_words.h"

namespace scree {

inline std::string words(const Audience& to) {
  if (to.kind == AudienceKind::all) return "all";
  return to.kind == AudienceKind::session ? fmt::format("session {}", to.session)
                                          : fmt::format("team '{}'", to.team);
}

inline std::string words(const Sign& sign) {
  std::string text =
      fmt::format("{} '{}' to {}: '{}', colour 0x{:02x}{:02x}{:02x}", name_of(sign.kind), sign.name,
                  words(sign.to), sign.text, sign.colour[0], sign.colour[1], sign.colour[2]);
  if (sign.kind == SignKind::bar) text += fmt::format(", share {}", sign.share);
  if (sign.kind == SignKind::marker) text += ", at " + words(sign.place_m);
  if (sign.until != 0) text += fmt::format(", until tick {}", sign.until);
  return text + (sign.counts ? ", counts" : "");
}

inline std::string words(const Cue& cue) {
  return fmt::format("{} at {}, {} m, {} J, material {}", name_of(cue.kind), words(cue.place_m), cue.size_m,
                     cue.energy_j, row_number(cue.material));
}

inline std::string words(const ChannelData& data) {
  const std::string bytes(data.bytes.begin(), data.bytes.end());
  return fmt::format("channel '{}': {}", data.channel, words_of_bytes(bytes));
}

inline Lines describe(const SignsMessage& m) {
  Lines lines{"signs:"};
  for (const Sign& sign : m.signs) lines.push_back(words(sign));
  return lines;
}
inline Lines describe(const CuesMessage& m) {
  Lines lines{fmt::format("cues: tick {}", m.tick)};
  for (const Cue& cue : m.cues) lines.push_back(words(cue));
  return lines;
}
inline Lines describe(const ChannelMessage& m) {
  return {words(static_cast<const ChannelData&>(m))};
}
inline Lines describe(const RestoreMessage& m) {
  return {fmt::format("restore: request {}, {} bricks, {} pieces, {} loose chunks", m.request,
                      m.bricks == nullptr ? 0 : m.bricks->size(), m.pieces.size(), m.loose.size())};
}
inline Lines describe(const RulesMessage& m) {
  return {fmt::format("rules: request {}, {}", m.request, text_of(m.act))};
}

}  // namespace scree
