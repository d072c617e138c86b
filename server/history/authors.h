// Who edits: persons by their sessions, and whose doing follows from what they did. One thread at a time.
// Internal to server/history.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "server/history/history_rows.h"
#include "server/world/tick_delta.h"

namespace scree {

class Authors {
 public:
  /// Somebody joined, or is known from the file.
  void add(const Author& author);
  /// Null: not known.
  const Author* find(AuthorId author) const;
  /// Those whom an administrator names: "session:17", "token:ID", "address:HASH", "undo:3", or a name, of
  /// which case does not count.
  std::vector<AuthorId> named(const std::string& by) const;
  /// As an answer names it: "Ann (session 17)".
  std::string words_of(AuthorId author) const;

  /// Whose doing an operation is: who asked for it; who made the piece that it breaks or merges; of the party
  /// that caused it the one who edited nearest before. `undo`: whose a restore is.
  AuthorId author_of(const AppliedOperation& applied, AuthorId undo);
  /// After author_of(): pieces that the operation made are its author's.
  void note(const AppliedOperation& applied, AuthorId author);

  void set_maker(PieceId piece, AuthorId author) { makers_[piece] = author; }
  void drop_maker(PieceId piece) { makers_.erase(piece); }
  const std::map<PieceId, AuthorId>& makers() const { return makers_; }

 private:
  struct Recent {
    AuthorId author = 0;
    std::vector<ChunkCoord> chunks;
  };
  AuthorId of_party(uint64_t party, const std::vector<ChunkCoord>& near) const;

  std::map<AuthorId, Author> authors_;
  std::map<PieceId, AuthorId> makers_;
  std::map<uint64_t, std::deque<Recent>> recent_;  ///< by party, the newest last
};

}  // namespace scree
