// What a EditHistory is made of: for its own sources, which follow ticks (history.cpp) and answer
// (history_answers.cpp).
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <thread>
#include <unordered_map>
#include <variant>

#include "server/history/authors.h"
#include "server/history/edit_history.h"
#include "server/history/history_text.h"
#include "server/history/undo_run.h"

namespace scree {

struct EditHistory::State {
  using Question = std::variant<HistoryRequest, UndoRequest>;
  struct Asked {
    Question question;
    std::string who;
    Answer answer;
  };
  /// The last run of a brick, and whether the file does not have it as it is.
  struct Known {
    ImageRow run;
    bool changed = false;
  };

  State(HistoryConfig c, std::unique_ptr<HistoryFile> opened, TerrainThen past)
      : config(std::move(c)), then(std::move(past)), file(std::move(opened)) {}

  Result<void> load();
  void run();
  Result<void> write_waiting();
  Result<void> write(const TickDelta& delta);
  Result<void> write_image(const TickDelta& delta, const BrickPatch& was, AuthorId author);
  Result<Known*> known_run(BrickCoord brick);
  Result<void> write_known();
  Result<void> keep_within_bound();
  void note_result(const Result<void>& done);

  HistoryUnits units() const;
  Result<std::string> answer(const HistoryRequest& request);
  Result<std::string> answer(const UndoRequest& request, const std::string& who);
  /// An error where nobody is meant.
  Result<std::vector<AuthorId>> authors_named(const std::string& by) const;
  Result<UndoTerms> terms_of(const UndoRequest& request) const;
  Result<void> take_terrain_then(const UndoRequest& request, UndoPlan& plan) const;
  void plan_again(UndoRun& run);
  void tell_end(const UndoRun& run);
  std::vector<PieceId> pieces_of(const UndoTerms& terms) const;
  Tick ago(uint32_t seconds) const;
  Result<std::string> begin_undo(const UndoRequest& request, const std::string& who, UndoSummary summary,
                                 UndoPlan plan, std::vector<PieceId> pieces);

  const HistoryConfig config;
  const TerrainThen then;
  std::unique_ptr<HistoryFile> file;  ///< used by the history's thread alone, as the next ones
  Authors authors;
  std::map<PieceId, Tick> made;  ///< when pieces with a maker were made
  std::unordered_map<BrickCoord, Known, CoordHash> known;
  std::set<AuthorId> saved_authors;  ///< whose rows have their parties
  uint32_t undo_number = 0;          ///< of the last one
  AuthorId undo = 0;                 ///< whose restores are
  UndoRequest undo_request;          ///< by which it was asked for
  UndoTerms undo_terms;              ///< and what that means
  uint32_t undo_told = 0;            ///< number of the last one whose end was logged
  RetryPause pause;
  std::thread thread;

  mutable std::mutex mutex;  ///< guards the members below
  std::condition_variable changed;
  std::deque<std::shared_ptr<const TickDelta>> queue;
  std::deque<Author> arrived;
  std::deque<Asked> asked;
  std::vector<Command> marks;        ///< for the next tick
  std::shared_ptr<UndoRun> undoing;  ///< the last one; null: none since the start
  std::shared_ptr<const TickDelta> last;
  Tick noted = 0, committed = 0;
  HistoryStatus told;
  bool stopping = false;
};

}  // namespace scree
