#include "server/store/earlier_keyframes.h"

#include <algorithm>
#include <iterator>

#include "server/store/schema.h"

namespace scree {

Result<EarlierKeyframes> EarlierKeyframes::open(Database& database) {
  EarlierKeyframes keyframes(database);
  auto whole = TRY(database.prepare(schema::select_from("keyframes")));
  keyframes.select_whole_ = std::move(whole);
  const auto has_short = TRY(database.has_table("short_keyframes"));
  if (!has_short) return keyframes;
  auto later = TRY(database.prepare(schema::select_from("short_keyframes")));
  keyframes.select_short_ = std::move(later);
  return keyframes;
}

Result<uint64_t> EarlierKeyframes::count() {
  const auto count = database_->number("SELECT count(*) FROM keyframes");
  TRY(count);
  return static_cast<uint64_t>(count->value_or(0));
}

Result<std::optional<Tick>> EarlierKeyframes::latest(const std::string& table, Tick tick) {
  const auto row = TRY(database_->number("SELECT max(tick) FROM " + table +
                                         " WHERE tick >= 0 AND tick <= " + std::to_string(tick)));
  return row.has_value() ? std::optional(static_cast<Tick>(*row)) : std::nullopt;
}

Result<std::optional<Tick>> EarlierKeyframes::tick_before(Tick tick) {
  auto whole = latest("keyframes", tick);
  if (!whole || !select_short_) return whole;
  const auto later = latest("short_keyframes", tick);
  if (!later) return later;
  return std::max(*whole, *later);
}

Result<RecordedKeyframe> EarlierKeyframes::row(const Statement& select, Tick tick) {
  const auto damaged = [&](const std::string& what) {
    return fail(database_->path() + ": damaged at tick " + std::to_string(tick) + ": " + what);
  };
  const auto bytes = TRY(database_->get(select, tick));
  if (!bytes.has_value()) return damaged("its keyframe is not there");
  auto keyframe = decode_recorded_keyframe(*bytes);
  if (!keyframe) return damaged(keyframe.error().message);
  if (keyframe->tick != tick) return damaged("a keyframe of another tick than it says");
  return std::move(*keyframe);
}

/// A short one has everything but the bricks that did not change.
Result<std::optional<RecordedKeyframe>> EarlierKeyframes::read_before(Tick tick) {
  const auto at = TRY(latest("keyframes", tick));
  RecordedKeyframe whole;
  if (at) {
    auto read = TRY(row(select_whole_, *at));
    whole = std::move(read);
  }
  const auto later = select_short_ ? latest("short_keyframes", tick) : Result<std::optional<Tick>>();
  TRY(later);
  if (!*later || (at && **later <= *at))
    return at ? std::optional(std::move(whole)) : std::optional<RecordedKeyframe>();
  auto keyframe = TRY(row(select_short_, **later));
  std::vector<BrickPatch> bricks;
  bricks.reserve(whole.bricks.size() + keyframe.bricks.size());
  // Of a brick that both have, the first is taken: the later one.
  std::ranges::set_union(keyframe.bricks, whole.bricks, std::back_inserter(bricks), {}, &BrickPatch::coord,
                         &BrickPatch::coord);
  keyframe.bricks = std::move(bricks);
  return std::optional(std::move(keyframe));
}

}  // namespace scree
