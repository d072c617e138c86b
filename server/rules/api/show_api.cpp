// What rules show and tell: signs, lines, cues, and bytes for programs.
#include <algorithm>
#include <cctype>

#include "server/rules/api.h"
#include "server/rules/mod.h"
#include "server/rules/values.h"
#include "shared/base/kind_table.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// nil: everybody; a person; the name of a team.
Result<Audience> read_audience(const ScriptValue& value) {
  if (value.is_nil()) return Audience{};
  if (value.is_text()) return Audience{AudienceKind::team, 0, std::string(TRY(value.text()))};
  return Audience{AudienceKind::session, TRY(value.handle("person")), {}};
}

Result<std::array<uint8_t, 3>> read_colour(const ScriptValue& value) {
  const std::string_view text = TRY(value.text());
  std::array<uint8_t, 3> colour{};
  constexpr size_t digits = 7;
  if (text.size() != digits || text[0] != '#') return value.refuse("a colour is \"#rrggbb\"");
  for (size_t i = 1; i < digits; ++i) {
    const auto digit = std::string_view("0123456789abcdef").find(static_cast<char>(std::tolower(text[i])));
    if (digit == std::string_view::npos) return value.refuse("a colour is \"#rrggbb\"");
    uint8_t& part = colour[(i - 1) / 2];
    part = static_cast<uint8_t>(part * 16 + digit);
  }
  return colour;
}

Result<void> ask(RulesCall& call, RulesAct act) {
  TRY(call.mod.ask(call.moment, RulesRequest{std::move(act)}, 0));
  return {};
}

/// What all signs have: `options` is a table, or nothing.
Result<void> read_options(const RulesCall& call, const ScriptValue& options, Sign& sign) {
  if (options.is_nil()) return {};
  TRY(options.each([](const ScriptValue& key, const ScriptValue&) -> Result<void> {
    const std::string_view known = TRY(key.text());
    if (known == "to" || known == "colour" || known == "lasts" || known == "counts") return {};
    return key.refuse("options of a sign are to, colour, lasts and counts");
  }));
  sign.to = TRY(read_audience(TRY(options.field("to"))));
  const ScriptValue colour = TRY(options.field("colour"));
  if (!colour.is_nil()) sign.colour = TRY(read_colour(colour));
  const ScriptValue lasts = TRY(options.field("lasts"));
  if (!lasts.is_nil()) {
    const double seconds = TRY(lasts.number());
    constexpr double longest_s = 86400.0;
    if (!(seconds > 0.0 && seconds <= longest_s)) return lasts.refuse("a sign lasts up to 86,400 s");
    sign.until = call.moment.world->tick() + 1 + static_cast<Tick>(seconds * call.mod.options().tick_rate_hz);
  }
  const ScriptValue counts = TRY(options.field("counts"));
  sign.counts = !counts.is_nil() && TRY(counts.boolean());
  if (sign.counts && sign.until == 0) return counts.refuse("a sign that counts says how long it lasts");
  return {};
}

Result<void> show(RulesCall& call, Sign sign, const ScriptValue& options) {
  sign.name = std::string(TRY(call.argument(1, "name").text()));
  sign.text = showable(std::string(TRY(call.argument(2, "text").text())), limits::sign_text_bytes_max);
  TRY(read_options(call, options, sign));
  if (const Result<void> valid = validate(sign); !valid) return fail(valid.error().message);
  return ask(call, ShowSign{std::move(sign)});
}

Result<void> line(RulesCall& call) {
  return show(call, Sign(), call.argument(3, "options"));
}

Result<void> bar(RulesCall& call) {
  Sign sign;
  sign.kind = SignKind::bar;
  sign.share = static_cast<float>(std::clamp(TRY(call.argument(3, "share").number()), 0.0, 1.0));
  return show(call, std::move(sign), call.argument(4, "options"));
}

Result<void> marker(RulesCall& call) {
  Sign sign;
  sign.kind = SignKind::marker;
  sign.place_m = TRY(read_vec(call.argument(3, "at")));
  return show(call, std::move(sign), call.argument(4, "options"));
}

Result<void> remove(RulesCall& call) {
  const ScriptValue name = call.argument(1, "name");
  RemoveSign removed{TRY(read_audience(call.argument(2, "to"))), std::string(TRY(name.text()))};
  if (const Result<void> valid = validate(Sign{.name = removed.name, .to = removed.to}); !valid)
    return name.refuse(valid.error().message);
  return ask(call, std::move(removed));
}

Result<void> tell(RulesCall& call, Notice notice) {
  if (const Result<void> valid = validate(notice); !valid) return fail(valid.error().message);
  return ask(call, std::move(notice));
}

Result<void> say(RulesCall& call) {
  const std::string_view text = TRY(call.argument(1, "text").text());
  return tell(call, {TRY(read_audience(call.argument(2, "to"))),
                     NoticeLine{showable(std::string(text), limits::notice_line_bytes_max)}});
}

Result<float> number_or(const ScriptValue& table, std::string_view field, float otherwise) {
  if (table.is_nil()) return otherwise;
  const ScriptValue value = TRY(table.field(field));
  return value.is_nil() ? otherwise : static_cast<float>(TRY(value.number()));
}

Result<void> cue(RulesCall& call) {
  const ScriptValue kind_name = call.argument(1, "kind");
  const auto kind = kind_named<CueKind>(TRY(kind_name.text()));
  if (!kind) return kind_name.refuse("a cue is thud, crack, ring, rattle, dust or sparks");
  const ScriptValue options = call.argument(3, "options");
  Cue made{.kind = *kind, .place_m = TRY(read_vec(call.argument(2, "at")))};
  made.size_m = TRY(number_or(options, "size", made.size_m));
  made.energy_j = TRY(number_or(options, "energy", made.energy_j));
  Audience to;
  if (!options.is_nil()) {
    to = TRY(read_audience(TRY(options.field("to"))));
    const ScriptValue material = TRY(options.field("material"));
    if (!material.is_nil()) made.material = TRY(read_material(material, call.moment));
  }
  return tell(call, {to, made});
}

Result<void> send(RulesCall& call) {
  const std::string_view bytes = TRY(call.argument(2, "bytes").text());
  ChannelData data{std::string(TRY(call.argument(1, "channel").text())), {bytes.begin(), bytes.end()}};
  return tell(call, {TRY(read_audience(call.argument(3, "to"))), std::move(data)});
}

constexpr ApiFunction rows[] = {
    {"show", "line", "name: string, text: string, options?: sign_options", "",
     "Shows a line at the screen's top until it is removed; a sign of the same name, for the same persons, "
     "is "
     "replaced. Lines and bars stand in the order of their names.",
     "show.line(\"1 round\", \"Round 1\", { lasts = 60, counts = true, colour = \"#ffcc00\" })", line},
    {"show", "bar", "name: string, text: string, share: number, options?: sign_options", "",
     "Shows a line with a bar, of which `share` (0 to 1) is filled.",
     "show.bar(\"2 tower\", \"the tower\", 0.75)", bar},
    {"show", "marker", "name: string, text: string, at: vec, options?: sign_options", "",
     "Shows a text at a place in the world.", "show.marker(\"goal\", \"bring it here\", vec(0, 3, 0))",
     marker},
    {"show", "remove", "name: string, to?: person|string", "",
     "Takes a sign away. `to`: for whom it was shown, if it was not for all.",
     "show.line(\"hint\", \"dig here\")\nshow.remove(\"hint\")", remove},
    {"", "say", "text: string, to?: person|string", "",
     "A line for everybody, a person, or a team by its name, as persons say them.",
     "say(\"the round begins\")\nsay(\"reds, to the tower\", \"red\")", say},
    {"show", "cue", "kind: string, at: vec, options?: cue_options", "",
     "A sound (thud, crack, ring, rattle) or a puff (dust, sparks) at a place.",
     "show.cue(\"thud\", vec(0, 0, 0), { size = 3, energy = 1e5 })", cue},
    {"message", "send", "channel: string, bytes: string, to?: person|string", "",
     "Bytes for the persons' programs: at most 4,096. A program that does not know the channel skips them.",
     "message.send(\"score\", \"42\")", send},
};

}  // namespace

std::span<const ApiFunction> show_api() {
  return rows;
}

}  // namespace scree
