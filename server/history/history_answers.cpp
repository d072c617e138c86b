// What a EditHistory answers, and how it begins to take edits back.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "server/history/history_state.h"
#include "server/history/undo_marks.h"
#include "server/log/log.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

int32_t brick_at(float metres, float voxel_size_m) {
  return static_cast<int32_t>(std::floor(metres / (voxel_size_m * static_cast<float>(brick_size))));
}
BrickCoord brick_at(glm::vec3 p_m, float voxel_size_m) {
  return {brick_at(p_m.x, voxel_size_m), brick_at(p_m.y, voxel_size_m), brick_at(p_m.z, voxel_size_m)};
}

/// Whether a ball meets the bricks of an edit.
bool is_near(const EditRow& edit, glm::vec3 at_m, float radius_m, float voxel_size_m) {
  const float side_m = voxel_size_m * static_cast<float>(brick_size);
  const auto off = [&](float p, int32_t lo, int32_t hi) {
    const float from = static_cast<float>(lo) * side_m, to = static_cast<float>(hi + 1) * side_m;
    return p < from ? from - p : (p > to ? p - to : 0.0F);
  };
  const float x = off(at_m.x, edit.lo.x, edit.hi.x), y = off(at_m.y, edit.lo.y, edit.hi.y),
              z = off(at_m.z, edit.lo.z, edit.hi.z);
  return x * x + y * y + z * z <= radius_m * radius_m;
}

std::string conflict_of(const UndoSummary& summary) {
  std::string who;
  for (const auto& [author, bricks] : summary.holders)
    who += fmt::format("{}{} {}", who.empty() ? "" : ", ", author, bricks);
  return fmt::format(
      "others edited {} of these bricks since ({}): say what becomes of that, --keep-others or "
      "--over-others",
      summary.held, who);
}

}  // namespace

Tick EditHistory::State::ago(uint32_t seconds) const {
  const Tick ticks = Tick{seconds} * config.tick_rate_hz;
  const std::scoped_lock lock(mutex);
  return noted > ticks ? noted - ticks : 0;
}

Result<std::string> EditHistory::State::answer(const HistoryRequest& request) {
  std::vector<AuthorId> by;
  if (!request.by.empty()) by = TRY(authors_named(request.by));
  const Tick since = request.since_s == 0 ? 0 : ago(request.since_s);
  size_t by_itself = 0;
  const auto wanted = [&](const EditRow& edit) {
    if (edit.tick < since) return false;
    if (!by.empty() && std::ranges::find(by, edit.author) == by.end()) return false;
    if (request.at_m && !is_near(edit, *request.at_m, request.radius_m, config.voxel_size_m)) return false;
    if (edit.author == 0) ++by_itself;
    return edit.author != 0;
  };
  auto edits = TRY(file->edits(wanted, limits::history_lines_max + 1));
  const bool more = edits.size() > limits::history_lines_max;
  if (more) edits.pop_back();
  return text_of(edits, {more, by_itself}, TRY(file->known_since()), authors, units(), request.as_json);
}

Result<std::vector<AuthorId>> EditHistory::State::authors_named(const std::string& by) const {
  std::vector<AuthorId> named = authors.named(by);
  if (named.empty())
    return fail(
        by +
        " has edited nothing here: say whose edits by name:NAME, session:NUMBER, token:ID, address:HASH "
        "or undo:NUMBER");
  return named;
}

Result<UndoTerms> EditHistory::State::terms_of(const UndoRequest& request) const {
  UndoTerms terms;
  terms.over_others = request.mode == UndoMode::over_others;
  if (!request.by.empty()) {
    for (const AuthorId author : TRY(authors_named(request.by))) terms.authors.insert(author);
  } else if (request.to_tick == 0) {
    return fail("say whose edits are taken back, or to which tick");
  }
  terms.since =
      request.to_tick != 0 ? request.to_tick + 1 : (request.since_s == 0 ? 0 : ago(request.since_s));
  if (!request.lo_m || !request.hi_m) return terms;
  const glm::vec3 lo = *request.lo_m, hi = *request.hi_m;
  if (!(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z))
    return fail("the box's first corner is not its lowest");
  const float most_m = 2.0F * limits::world_half_width_m;
  if (std::max({std::abs(lo.x), std::abs(lo.y), std::abs(lo.z), std::abs(hi.x), std::abs(hi.y),
                std::abs(hi.z)}) > most_m)
    return fail("the box reaches beyond the world");
  terms.box = std::pair(brick_at(lo, config.voxel_size_m), brick_at(hi, config.voxel_size_m));
  return terms;
}

/// Those that are there, that they made since, and that lie in the box.
std::vector<PieceId> EditHistory::State::pieces_of(const UndoTerms& terms) const {
  std::shared_ptr<const TickDelta> now;
  {
    const std::scoped_lock lock(mutex);
    now = last;
  }
  std::vector<PieceId> pieces;
  if (now == nullptr) return pieces;
  for (const PieceState& piece : now->pieces) {
    const auto maker = authors.makers().find(piece.id);
    const auto at = made.find(piece.id);
    if (maker == authors.makers().end() || at == made.end() || at->second < terms.since) continue;
    if (!terms.means(maker->second)) continue;
    if (terms.holds(brick_at(dequantise(piece.pose).position_m, config.voxel_size_m)))
      pieces.push_back(piece.id);
  }
  return pieces;
}

Result<std::string> EditHistory::State::answer(const UndoRequest& request, const std::string& who) {
  std::shared_ptr<UndoRun> run;
  {
    const std::scoped_lock lock(mutex);
    run = undoing;
  }
  if (request.mode == UndoMode::stop) {
    if (run == nullptr || run->progress().over) return fail("nothing is taken back now");
    run->stop();
    log_of(LogPart::admin).info("{} stops undo {}", who, run->progress().number);
  }
  if (request.mode == UndoMode::stop || request.mode == UndoMode::progress)
    return text_of(run == nullptr ? UndoProgress{} : run->progress(), units(), request.as_json);
  const UndoTerms terms = TRY(terms_of(request));
  UndoPlan plan = TRY(plan_undo(*file, terms));
  if (request.mode != UndoMode::preview) TRY(take_terrain_then(request, plan));
  std::vector<PieceId> pieces = pieces_of(terms);
  UndoSummary summary;
  summary.bricks = plan.bricks.size();
  summary.pieces = pieces.size();
  summary.held = plan.held;
  summary.earlier = plan.earlier;
  summary.lo = plan.lo;
  summary.hi = plan.hi;
  summary.since = terms.since;
  summary.known_since = TRY(file->known_since());
  for (const AuthorId author : terms.authors) summary.authors.push_back(authors.words_of(author));
  for (const auto& [author, bricks] : plan.holders)
    summary.holders.emplace_back(authors.words_of(author), bricks);
  if (request.mode == UndoMode::preview) {
    if (request.show_session != 0) {
      std::vector<Command> shown = marks_of(plan, request.show_session, units());
      const std::scoped_lock lock(mutex);
      marks = std::move(shown);
    }
    return text_of(summary, units(), request.as_json);
  }
  if (run != nullptr && !run->progress().over)
    return fail(fmt::format("undo {} goes on: wait, or stop it", run->progress().number));
  if (plan.held > 0 && request.mode == UndoMode::refuse_conflicts) return fail(conflict_of(summary));
  undo_terms = terms;
  return begin_undo(request, who, std::move(summary), std::move(plan), std::move(pieces));
}

/// Bricks become what the recording has of that tick, where a tick is named and there is a recording.
Result<void> EditHistory::State::take_terrain_then(const UndoRequest& request, UndoPlan& plan) const {
  if (request.to_tick == 0 || !then || plan.bricks.empty()) return {};
  const auto field = then(request.to_tick);
  TRY(field);
  if (*field == nullptr) return {};
  for (PlannedBrick& planned : plan.bricks) {
    const BrickCoord coord = planned.image.brick;
    planned.exact = std::make_shared<const BrickPatch>(
        BrickPatch{coord, (*field)->brick(coord), (*field)->materials(coord)});
  }
  return {};
}

Result<std::string> EditHistory::State::begin_undo(const UndoRequest& request, const std::string& who,
                                                   UndoSummary summary, UndoPlan plan,
                                                   std::vector<PieceId> pieces) {
  if (plan.bricks.empty() && pieces.empty()) return fail("there is nothing to take back");
  summary.number = ++undo_number;
  undo = undo_author(undo_number);
  const std::string words = text_of(summary, units(), false);
  Author author{.id = undo, .since = units().now, .name = who};
  authors.add(author);
  TRY(file->put(author));
  log_of(LogPart::admin).info("{}: {}", who, words.substr(0, words.find('\n')));
  undo_request = request;
  auto run = std::make_shared<UndoRun>(undo_number, std::move(plan), std::move(pieces));
  run->prepare(*file);
  {
    const std::scoped_lock lock(mutex);
    undoing = std::move(run);
  }
  return text_of(summary, units(), request.as_json);
}

/// What changed while it went on: by pieces that merged, or by persons.
void EditHistory::State::plan_again(UndoRun& run) {
  UndoTerms terms = undo_terms;
  terms.undo = run.author();
  auto plan = plan_undo(*file, terms);
  if (plan)
    if (const auto taken = take_terrain_then(undo_request, *plan); !taken)
      plan = tl::unexpected(taken.error());
  if (!plan) log_of(LogPart::admin).warn("an undo cannot go on: {}", plan.error().message);
  run.go_on(plan ? std::move(*plan) : UndoPlan{}, plan ? pieces_of(terms) : std::vector<PieceId>());
}

void EditHistory::State::tell_end(const UndoRun& run) {
  const UndoProgress now = run.progress();
  if (!now.over || std::exchange(undo_told, now.number) == now.number) return;
  std::string words = text_of(now, units(), false);
  std::ranges::replace(words, '\n', ' ');
  log_of(LogPart::admin).info("{}", words);
}

}  // namespace scree
