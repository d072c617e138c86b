#include "server/store/earlier_keyframes.h"

#include <algorithm>
#include <iterator>

#include "server/store/schema.h"

namespace scree {

Result<EarlierKeyframes> EarlierKeyframes::open(Database& database) {
  EarlierKeyframes keyframes(database);
  auto whole = database.prepare(schema::select_from("keyframes"));
  if (!whole) return tl::unexpected(whole.error());
  keyframes.select_whole_ = std::move(*whole);
  const auto has_short = database.has_table("short_keyframes");
  if (!has_short) return tl::unexpected(has_short.error());
  if (!*has_short) return keyframes;
  auto later = database.prepare(schema::select_from("short_keyframes"));
  if (!later) return tl::unexpected(later.error());
  keyframes.select_short_ = std::move(*later);
  return keyframes;
}

Result<uint64_t> EarlierKeyframes::count() {
  const auto count = database_->number("SELECT count(*) FROM keyframes");
  if (!count) return tl::unexpected(count.error());
  return static_cast<uint64_t>(count->value_or(0));
}

Result<std::optional<Tick>> EarlierKeyframes::latest(const std::string& table, Tick tick) {
  const auto row = database_->number("SELECT max(tick) FROM " + table +
                                     " WHERE tick >= 0 AND tick <= " + std::to_string(tick));
  if (!row) return tl::unexpected(row.error());
  return row->has_value() ? std::optional(static_cast<Tick>(**row)) : std::nullopt;
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
  const auto bytes = database_->get(select, tick);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!bytes->has_value()) return damaged("its keyframe is not there");
  auto keyframe = decode_recorded_keyframe(**bytes);
  if (!keyframe) return damaged(keyframe.error().message);
  if (keyframe->tick != tick) return damaged("a keyframe of another tick than it says");
  return std::move(*keyframe);
}

/// A short one has everything but the bricks that did not change.
Result<std::optional<RecordedKeyframe>> EarlierKeyframes::read_before(Tick tick) {
  const auto at = latest("keyframes", tick);
  if (!at) return tl::unexpected(at.error());
  RecordedKeyframe whole;
  if (*at) {
    auto read = row(select_whole_, **at);
    if (!read) return tl::unexpected(read.error());
    whole = std::move(*read);
  }
  const auto later = select_short_ ? latest("short_keyframes", tick) : Result<std::optional<Tick>>();
  if (!later) return tl::unexpected(later.error());
  if (!*later || (*at && **later <= **at))
    return *at ? std::optional(std::move(whole)) : std::optional<RecordedKeyframe>();
  auto keyframe = row(select_short_, **later);
  if (!keyframe) return tl::unexpected(keyframe.error());
  std::vector<BrickPatch> bricks;
  bricks.reserve(whole.bricks.size() + keyframe->bricks.size());
  // Of a brick that both have, the first is taken: the later one.
  std::ranges::set_union(keyframe->bricks, whole.bricks, std::back_inserter(bricks), {}, &BrickPatch::coord,
                         &BrickPatch::coord);
  keyframe->bricks = std::move(bricks);
  return std::optional(std::move(*keyframe));
}

}  // namespace scree
