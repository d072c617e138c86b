#include "server/history/history_text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace scree {

namespace {

using nlohmann::ordered_json;

/// Plurals of operations by their place in the variant, as reports have them.
template <size_t... kind>
std::string_view plural_of(uint8_t index, std::index_sequence<kind...>) {
  constexpr std::array<std::string_view, sizeof...(kind)> names{
      std::variant_alternative_t<kind, Operation>::plural...};
  return index < names.size() ? names[index] : std::string_view("edits");
}
std::string_view kind_of(uint8_t index) {
  return plural_of(index, std::make_index_sequence<std::variant_size_v<Operation>>{});
}

double seconds_ago(Tick tick, const HistoryUnits& units) {
  return static_cast<double>(units.now - std::min(units.now, tick)) / units.tick_rate_hz;
}

std::string time_ago(Tick tick, const HistoryUnits& units) {
  const auto s = static_cast<uint64_t>(seconds_ago(tick, units));
  if (s < 120) return fmt::format("{} s", s);
  if (s < 7200) return fmt::format("{} min", s / 60);
  return fmt::format("{:.1f} h", static_cast<double>(s) / 3600.0);
}

double metres_of(int32_t brick, const HistoryUnits& units) {
  return static_cast<double>(brick) * brick_size * static_cast<double>(units.voxel_size_m);
}

ordered_json corner(BrickCoord brick, int32_t more, const HistoryUnits& units) {
  return {metres_of(brick.x + more, units), metres_of(brick.y + more, units),
          metres_of(brick.z + more, units)};
}

std::string words_of_box(BrickCoord lo, BrickCoord hi, const HistoryUnits& units) {
  return fmt::format("{:g} {:g} {:g} to {:g} {:g} {:g} m", metres_of(lo.x, units), metres_of(lo.y, units),
                     metres_of(lo.z, units), metres_of(hi.x + 1, units), metres_of(hi.y + 1, units),
                     metres_of(hi.z + 1, units));
}

double m3_of(MassUnits mass, const HistoryUnits& units) {
  const double side = static_cast<double>(units.voxel_size_m);
  return static_cast<double>(mass) / units_per_voxel * side * side * side;
}

}  // namespace

std::string text_of(const std::vector<EditRow>& edits, const LeftOut& left_out, Tick known_since,
                    const Authors& authors, const HistoryUnits& units, bool as_json) {
  if (as_json) {
    ordered_json all;
    all["tick"] = units.now;
    all["known_since_tick"] = known_since;
    all["more"] = left_out.more;
    all["by_the_world_itself"] = left_out.by_itself;
    all["edits"] = ordered_json::array();
    for (const EditRow& edit : edits) {
      ordered_json one{
          {"tick", edit.tick}, {"kind", kind_of(edit.kind)}, {"by", authors.words_of(edit.author)}};
      if (const Author* const author = authors.find(edit.author);
          author != nullptr && !is_undo(edit.author)) {
        one["session"] = author->id;
        one["name"] = author->name;
        if (author->address != 0) one["address"] = fmt::format("{:016x}", author->address);
      }
      one["bricks"] = edit.bricks;
      one["pieces"] = edit.pieces;
      one["lo_m"] = corner(edit.lo, 0, units);
      one["hi_m"] = corner(edit.hi, 1, units);
      all["edits"].push_back(std::move(one));
    }
    return all.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
  if (edits.empty() && left_out.by_itself == 0)
    return "nobody edited there, as far as this server remembers\n";
  std::string text;
  for (const EditRow& edit : edits)
    text += fmt::format("tick {:>8}, {:>7} ago  {:<9} {:<28} {:>4} bricks, {} pieces, {}\n", edit.tick,
                        time_ago(edit.tick, units), kind_of(edit.kind), authors.words_of(edit.author),
                        edit.bricks, edit.pieces, words_of_box(edit.lo, edit.hi, units));
  if (left_out.by_itself > 0)
    text += fmt::format("besides, rock moved by itself {} times, as slides do\n", left_out.by_itself);
  if (left_out.more)
    text += fmt::format("these are the newest {}; --at, --by and --since ask for fewer\n", edits.size());
  if (known_since > 0)
    text += fmt::format("older edits than {} are forgotten (--history-mb)\n", time_ago(known_since, units));
  return text;
}

std::string text_of(const UndoSummary& s, const HistoryUnits& units, bool as_json) {
  if (as_json) {
    ordered_json all;
    if (s.number) all["undo"] = *s.number;
    all["bricks"] = s.bricks;
    all["pieces"] = s.pieces;
    all["bricks_of_others"] = s.held;
    all["others"] = ordered_json::object();
    for (const auto& [who, bricks] : s.holders) all["others"][who] = bricks;
    all["authors"] = s.authors;
    all["since_tick"] = s.since;
    all["bricks_with_earlier_edits"] = s.earlier;
    all["known_since_tick"] = s.known_since;
    if (s.bricks > 0) {
      all["lo_m"] = corner(s.lo, 0, units);
      all["hi_m"] = corner(s.hi, 1, units);
    }
    return all.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
  std::string text =
      s.number ? fmt::format("undo {} takes back ", *s.number) : std::string("this would take back ");
  text +=
      fmt::format("{} bricks and {} pieces of {}, {}\n", s.bricks, s.pieces,
                  s.authors.empty() ? "everybody" : fmt::format("{}", fmt::join(s.authors, ", ")),
                  s.since == 0 ? "of all that is remembered" : "since " + time_ago(s.since, units) + " ago");
  if (s.bricks > 0) text += "they lie within " + words_of_box(s.lo, s.hi, units) + "\n";
  if (s.held > 0) {
    text += fmt::format("others edited {} of its bricks since:\n", s.held);
    for (const auto& [who, bricks] : s.holders) text += fmt::format("  {}: {} bricks\n", who, bricks);
    if (!s.number) text += "what they did last stays with --keep-others, and goes with --over-others\n";
  }
  if (s.earlier > 0)
    text += fmt::format("of {} bricks the same persons' edits of up to a minute before go, too\n", s.earlier);
  if (s.known_since > s.since)
    text += fmt::format("older edits than {} are forgotten, and stay\n", time_ago(s.known_since, units));
  return text;
}

std::string text_of(const UndoProgress& p, const HistoryUnits& units, bool as_json) {
  if (as_json)
    return ordered_json{{"undo", p.number},
                        {"over", p.over},
                        {"stopped", p.stopped},
                        {"bricks", p.bricks_planned},
                        {"bricks_done", p.bricks_done},
                        {"bricks_changed_since", p.bricks_other},
                        {"pieces_done", p.pieces_done},
                        {"requests_refused", p.refused},
                        {"poured_m3", m3_of(p.gain, units)}}
        .dump();
  if (p.number == 0) return "nothing was taken back since the server's start\n";
  const double poured = m3_of(p.gain, units);
  std::string text = fmt::format(
      "undo {} {}: {} of {} bricks and {} pieces are taken back, {:.1f} m³ {}\n", p.number,
      p.over ? (p.stopped ? "was stopped" : "is over") : "goes on", p.bricks_done, p.bricks_planned,
      p.pieces_done, poured < 0.0 ? -poured : poured, poured < 0.0 ? "were taken out" : "were poured");
  if (p.bricks_other > 0)
    text += fmt::format("{} bricks stay: somebody changed them meanwhile, or they were not to be read\n",
                        p.bricks_other);
  if (p.refused > 0) text += fmt::format("the world refused {} requests (its log says why)\n", p.refused);
  return text;
}

}  // namespace scree
