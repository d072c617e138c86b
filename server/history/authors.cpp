#include "server/history/authors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>

#include "auth/access_token.h"
#include "server/history/limits.h"
#include "shared/base/small_letters.h"

namespace scree {

namespace {

/// The number behind a prefix; nothing where the text is another.
std::optional<uint64_t> number_behind(const std::string& text, std::string_view prefix, int base) {
  if (!text.starts_with(prefix)) return std::nullopt;
  uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data() + prefix.size(), end, number, base);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

bool is_beside(const std::vector<ChunkCoord>& a, const std::vector<ChunkCoord>& b) {
  return std::ranges::any_of(a, [&](ChunkCoord one) {
    return std::ranges::any_of(b, [&](ChunkCoord other) {
      return std::max({std::abs(one.x - other.x), std::abs(one.y - other.y), std::abs(one.z - other.z)}) <= 1;
    });
  });
}

}  // namespace

void Authors::add(const Author& author) {
  Author& known = authors_[author.id];
  const uint64_t party = author.party != 0 ? author.party : known.party;
  known = author;
  known.party = party;
}

const Author* Authors::find(AuthorId author) const {
  const auto found = authors_.find(author);
  return found == authors_.end() ? nullptr : &found->second;
}

std::vector<AuthorId> Authors::named(const std::string& by) const {
  std::vector<AuthorId> found;
  const auto session = number_behind(by, "session:", 10), token = number_behind(by, "token:", 16),
             address = number_behind(by, "address:", 16), undo = number_behind(by, "undo:", 10);
  constexpr std::string_view name_prefix = "name:";
  const std::string name = in_small_letters(by.starts_with(name_prefix) ? by.substr(name_prefix.size()) : by);
  for (const auto& [id, author] : authors_) {
    const bool meant = session   ? id == *session
                       : token   ? author.token_id == *token && *token != 0
                       : address ? author.address == *address && *address != 0
                       : undo    ? id == first_undo_author + *undo
                                 : !is_undo(id) && in_small_letters(author.name) == name;
    if (meant) found.push_back(id);
  }
  return found;
}

std::string Authors::words_of(AuthorId author) const {
  if (author == 0) return "the world itself";
  if (is_undo(author)) return fmt::format("undo {}", author - first_undo_author);
  const Author* const known = find(author);
  const std::string token =
      known == nullptr || known->token_id == 0 ? "" : ", token " + id_text(known->token_id);
  return fmt::format("{} (session {}{})", known == nullptr || known->name.empty() ? "no name" : known->name,
                     author, token);
}

AuthorId Authors::of_party(uint64_t party, const std::vector<ChunkCoord>& near) const {
  const auto found = recent_.find(party);
  if (found == recent_.end() || found->second.empty()) return party;
  const auto& recent = found->second;
  const auto nearest = std::find_if(recent.rbegin(), recent.rend(),
                                    [&](const Recent& one) { return is_beside(one.chunks, near); });
  return nearest == recent.rend() ? recent.back().author : nearest->author;
}

AuthorId Authors::author_of(const AppliedOperation& applied, AuthorId undo) {
  if (std::holds_alternative<RestoreOperation>(applied.operation)) return undo;
  if (applied.session != 0) return applied.session;
  for (const PieceId piece : pieces_ended_by(applied.operation))
    if (const auto maker = makers_.find(piece); maker != makers_.end()) return maker->second;
  return applied.party == 0 ? 0 : of_party(applied.party, applied.writes);
}

void Authors::note(const AppliedOperation& applied, AuthorId author) {
  for (const PieceId piece : applied.created) makers_[piece] = author;
  for (const PieceId piece : pieces_ended_by(applied.operation)) makers_.erase(piece);
  while (makers_.size() > limits::history_pieces_max) makers_.erase(makers_.begin());
  if (applied.session == 0 || applied.party == 0) return;
  std::deque<Recent>& recent = recent_[applied.party];
  recent.push_back({author, applied.writes});
  if (recent.size() > limits::history_recent_edits) recent.pop_front();
  Author& known = authors_[author];
  known.id = author;
  known.party = applied.party;
}

}  // namespace scree
