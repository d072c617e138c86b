#include "server/history/edit_history.h"

#include <algorithm>
#include <chrono>

#include "crypto/sha256.h"
#include "server/history/history_state.h"
#include "server/log/log.h"
#include "server/store/database.h"
#include "shared/base/overloaded.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

constexpr std::chrono::milliseconds undo_look_period{20};

/// Whether a tick has anything to remember.
bool has_edits(const TickDelta& delta) {
  return !delta.operations.empty();
}

uint64_t keyed_hash(const std::vector<uint8_t>& key, const std::string& text) {
  if (text.empty()) return 0;
  std::vector<uint8_t> bytes = key;
  bytes.insert(bytes.end(), text.begin(), text.end());
  const Digest digest = sha256(bytes);
  uint64_t number = 0;
  for (size_t i = 0; i < 8; ++i) number = number << 8U | digest[i];
  return number;
}

EditRow edit_of(const AppliedOperation& applied, Tick tick, AuthorId author) {
  EditRow edit;
  edit.tick = tick;
  edit.author = author;
  edit.kind = static_cast<uint8_t>(applied.operation.index());
  edit.pieces = static_cast<uint32_t>(applied.created.size());
  return edit;
}

void widen(EditRow& edit, BrickCoord brick) {
  if (edit.bricks++ == 0) edit.lo = edit.hi = brick;
  edit.lo = {std::min(edit.lo.x, brick.x), std::min(edit.lo.y, brick.y), std::min(edit.lo.z, brick.z)};
  edit.hi = {std::max(edit.hi.x, brick.x), std::max(edit.hi.y, brick.y), std::max(edit.hi.z, brick.z)};
}

}  // namespace

Result<void> EditHistory::State::load() {
  for (const Author& author : TRY(file->authors())) {
    authors.add(author);
    if (is_undo(author.id))
      undo_number = std::max(undo_number, static_cast<uint32_t>(author.id - first_undo_author));
  }
  for (const HistoryFile::PieceMaker& piece : TRY(file->pieces())) {
    authors.set_maker(piece.piece, piece.author);
    made[piece.piece] = piece.made;
  }
  told.bytes = TRY(file->bytes());
  noted = committed = config.tick;
  return {};
}

Result<std::unique_ptr<EditHistory>> EditHistory::open(const HistoryConfig& config, TerrainThen then) {
  auto file = HistoryFile::open(config.path, config.world, config.tick);
  if (!file)
    return fail(file.error().message +
                ": the history of edits is not to be used. Without the file a new one begins");
  auto state = std::make_unique<State>(config, std::move(*file), std::move(then));
  TRY(state->load());
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<EditHistory>(new EditHistory(std::move(state)));
}

EditHistory::EditHistory(std::unique_ptr<State> state) : state_(std::move(state)) {}
EditHistory::~EditHistory() {
  finish();
}

void EditHistory::joined(const JoinedPerson& person) {
  if (person.administers) return;
  Author author{.id = person.session, .token_id = person.token_id, .name = person.name};
  author.address = keyed_hash(state_->file->address_key(), person.ip);
  const std::scoped_lock lock(state_->mutex);
  author.since = state_->noted;
  state_->arrived.push_back(std::move(author));
}

std::vector<Command> EditHistory::due() {
  std::shared_ptr<UndoRun> run;
  std::vector<Command> commands;
  {
    const std::scoped_lock lock(state_->mutex);
    run = state_->undoing;
    commands.swap(state_->marks);
  }
  if (run == nullptr || run->progress().over) return commands;
  for (Command& command : run->due()) commands.push_back(std::move(command));
  if (!commands.empty()) state_->changed.notify_all();
  return commands;
}

void EditHistory::note(std::shared_ptr<const TickDelta> delta) {
  std::shared_ptr<UndoRun> run;
  {
    const std::scoped_lock lock(state_->mutex);
    run = state_->undoing;
    state_->noted = delta->tick;
    if (has_edits(*delta)) {
      if (state_->queue.size() < limits::history_ticks_waiting_max)
        state_->queue.push_back(delta);
      else
        ++state_->told.health.lost;
    }
    state_->last = delta;
  }
  if (run == nullptr || run->progress().over) return;
  run->note(*delta);
}

void EditHistory::refused(const std::vector<Reply>& replies) {
  std::shared_ptr<UndoRun> run;
  {
    const std::scoped_lock lock(state_->mutex);
    run = state_->undoing;
  }
  if (run != nullptr) run->refused(replies);
}

void EditHistory::commit_up_to(Tick tick) {
  std::unique_lock lock(state_->mutex);
  state_->changed.notify_all();
  const auto is_done = [&] {
    return state_->committed >= std::min(tick, state_->noted) || !state_->told.health.ok() ||
           state_->stopping;
  };
  state_->changed.wait_for(lock, std::chrono::duration<double>(limits::history_patience_s), is_done);
}

void EditHistory::ask(const HistoryRequest& request, Answer answer) {
  const std::scoped_lock lock(state_->mutex);
  state_->asked.push_back({request, {}, std::move(answer)});
  state_->changed.notify_all();
}

void EditHistory::ask(const UndoRequest& request, const std::string& who, Answer answer) {
  const std::scoped_lock lock(state_->mutex);
  state_->asked.push_back({request, who, std::move(answer)});
  state_->changed.notify_all();
}

HistoryStatus EditHistory::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->told;
}

void EditHistory::finish() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->changed.notify_all();
  if (!state_->thread.joinable()) return;
  state_->thread.join();
  state_->file.reset();
}

/// Commits once a second, and answers at once.
void EditHistory::State::run() {
  for (;;) {
    std::deque<Asked> questions;
    std::shared_ptr<UndoRun> run;
    bool last_time = false;
    {
      std::unique_lock lock(mutex);
      const bool restores = undoing != nullptr && !undoing->progress().over;
      const auto most = restores ? std::chrono::duration<double>(undo_look_period)
                                 : std::chrono::duration<double>(limits::history_commit_s);
      if (asked.empty() && !stopping) changed.wait_for(lock, most);
      questions.swap(asked);
      run = undoing;
      last_time = stopping;
    }
    if (last_time || pause.is_over(steady_now_s())) note_result(write_waiting());
    for (const Asked& one : questions) {
      Result<std::string> out =
          std::visit(Overloaded{[&](const HistoryRequest& request) { return answer(request); },
                                [&](const UndoRequest& request) { return answer(request, one.who); }},
                     one.question);
      one.answer(std::move(out));
    }
    if (run != nullptr) {
      if (run->wants_plan()) plan_again(*run);
      run->prepare(*file);
      tell_end(*run);
    }
    if (last_time) return;
  }
}

void EditHistory::State::note_result(const Result<void>& done) {
  const std::scoped_lock lock(mutex);
  if (done.has_value() != told.health.ok()) {
    if (done)
      log_of(LogPart::store)
          .info("{} is written again; {} ticks with edits are lost", config.path, told.health.lost);
    else
      log_of(LogPart::store)
          .warn("edits are not remembered for now, and are tried again: {}", done.error().message);
  }
  if (done) {
    told.health.because.reset();
    told.health.since_unix_ms = 0;
  } else {
    if (told.health.ok()) told.health.since_unix_ms = unix_now_ms();
    told.health.because = done.error().message;
    pause.failed(steady_now_s(), Database::is_held(done.error()));
  }
  changed.notify_all();
}

/// As one transaction, or not at all: after a failure all of it is written again.
Result<void> EditHistory::State::write_waiting() {
  std::deque<std::shared_ptr<const TickDelta>> ticks;
  std::deque<Author> persons;
  Tick until = 0;
  {
    const std::scoped_lock lock(mutex);
    ticks.swap(queue);
    persons.swap(arrived);
    until = noted;
  }
  if (ticks.empty() && persons.empty()) {
    const std::scoped_lock lock(mutex);
    committed = until;
    return {};
  }
  const auto put_all = [&]() -> Result<void> {
    TRY(file->begin());
    for (const Author& person : persons) {
      authors.add(person);
      TRY(file->put(*authors.find(person.id)));
    }
    for (const auto& tick : ticks) TRY(write(*tick));
    TRY(write_known());
    TRY(keep_within_bound());
    return file->commit();
  };
  const Result<void> done = put_all();
  if (!done) {
    file->roll_back();
    known.clear();
    saved_authors.clear();
  }
  const std::scoped_lock lock(mutex);
  if (done) {
    committed = until;
    return {};
  }
  queue.insert(queue.begin(), ticks.begin(), ticks.end());
  arrived.insert(arrived.begin(), persons.begin(), persons.end());
  return done;
}

Result<void> EditHistory::State::write(const TickDelta& delta) {
  auto replaced = delta.replaced.begin();
  for (size_t i = 0; i < delta.operations.size(); ++i) {
    const AppliedOperation& applied = delta.operations[i];
    const AuthorId author = authors.author_of(applied, undo);
    authors.note(applied, author);
    if (const Author* const known_author = authors.find(author); known_author != nullptr)
      if (saved_authors.insert(author).second) TRY(file->put(*known_author));
    EditRow edit = edit_of(applied, delta.tick, author);
    for (; replaced != delta.replaced.end() && replaced->operation == i; ++replaced) {
      widen(edit, replaced->was.coord);
      TRY(write_image(delta, replaced->was, author));
    }
    for (const PieceId piece : applied.created) {
      made[piece] = delta.tick;
      TRY(file->put_piece(piece, author, delta.tick));
    }
    for (const PieceId piece : pieces_ended_by(applied.operation)) {
      made.erase(piece);
      TRY(file->remove_piece(piece));
    }
    if (edit.bricks == 0) continue;
    TRY(file->put(edit));
    const std::scoped_lock lock(mutex);
    ++told.edits;
  }
  return {};
}

/// An edit of the author of the last run, soon after its first, belongs to that.
Result<void> EditHistory::State::write_image(const TickDelta& delta, const BrickPatch& was, AuthorId author) {
  const auto state = std::ranges::lower_bound(delta.bricks, was.coord, {}, &BrickState::coord);
  const bool is_there = state != delta.bricks.end() && state->coord == was.coord;
  const uint64_t after = is_there ? state->hash : 0;
  Known& last_run = *TRY(known_run(was.coord));
  ImageRow& run = last_run.run;
  const auto most = static_cast<Tick>(limits::history_run_s * config.tick_rate_hz);
  if (run.key != 0 && run.author == author && delta.tick - run.first <= most) {
    run.last = delta.tick;
    run.after = after;
    last_run.changed = true;
    return {};
  }
  run = {.brick = was.coord, .first = delta.tick, .last = delta.tick, .author = author, .after = after};
  run.key = TRY(file->put(run, was));
  last_run.changed = false;
  return {};
}

Result<EditHistory::State::Known*> EditHistory::State::known_run(BrickCoord brick) {
  if (known.size() >= limits::history_bricks_known_max) {
    TRY(write_known());
    known.clear();
  }
  const auto [found, is_new] = known.try_emplace(brick);
  if (is_new)
    if (const auto row = TRY(file->last_of(brick))) found->second.run = *row;
  return &found->second;
}

Result<void> EditHistory::State::write_known() {
  for (auto& [brick, one] : known)
    if (std::exchange(one.changed, false)) TRY(file->extend(one.run));
  return {};
}

/// The oldest is forgotten, but not while bricks of it go back.
Result<void> EditHistory::State::keep_within_bound() {
  const uint64_t bytes = TRY(file->bytes());
  {
    const std::scoped_lock lock(mutex);
    told.bytes = bytes;
    if (undoing != nullptr && !undoing->progress().over) return {};
  }
  if (bytes <= (uint64_t{config.mb_max} << 20U)) return {};
  known.clear();
  return file->forget_oldest();
}

HistoryUnits EditHistory::State::units() const {
  const std::scoped_lock lock(mutex);
  return {config.tick_rate_hz, config.voxel_size_m, noted};
}

}  // namespace scree
