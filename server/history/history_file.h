// The file of a history, beside its world's. One thread at a time. Internal to server/history.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/history/history_rows.h"
#include "shared/base/result.h"

namespace scree {

class HistoryFile {
 public:
  /// Opens the file of a world that stands at `tick`, or makes it. What it has of later ticks, which the
  /// world lost with its server, is forgotten. Refuses a file of another kind, or another world's.
  static Result<std::unique_ptr<HistoryFile>> open(const std::string& path, uint64_t world, Tick tick);
  ~HistoryFile();
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  /// A random key, which never changes: hashes of addresses say nothing without it.
  const std::vector<uint8_t>& address_key() const;

  /// Everything between two commits is written as one, or not at all.
  Result<void> begin();
  Result<void> commit();
  void roll_back();

  Result<void> put(const Author& author);
  Result<void> put(const EditRow& edit);
  /// Returns its key. `was`: the brick before it.
  Result<int64_t> put(const ImageRow& image, const BrickPatch& was);
  /// A run goes on.
  Result<void> extend(const ImageRow& image);
  Result<void> put_piece(PieceId piece, AuthorId author, Tick made);
  Result<void> remove_piece(PieceId piece);

  Result<std::vector<Author>> authors();
  struct PieceMaker {
    PieceId piece = 0;
    AuthorId author = 0;
    Tick made = 0;
  };
  Result<std::vector<PieceMaker>> pieces();
  /// The last run of a brick.
  Result<std::optional<ImageRow>> last_of(BrickCoord brick);
  /// All runs of a brick whose last edit is at that tick or later, in order.
  Result<std::vector<ImageRow>> runs_of(BrickCoord brick, Tick since);
  /// The bricks that these authors edited at that tick or later; of no author: that anybody did.
  Result<std::vector<BrickCoord>> bricks_of(const std::vector<AuthorId>& authors, Tick since);
  /// What a brick was before a run.
  Result<BrickPatch> before(const ImageRow& image);
  /// The edits that `wanted` agrees to, the newest first, `most` of them.
  Result<std::vector<EditRow>> edits(const std::function<bool(const EditRow&)>& wanted, size_t most);
  /// The first tick of which all is known; 0: all ticks.
  Result<Tick> known_since();
  /// Bytes of the pages in use.
  Result<uint64_t> bytes();
  /// Forgets the oldest tenth.
  Result<void> forget_oldest();

 private:
  struct State;
  explicit HistoryFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
