#include "server/net/talk.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "server/net/limits.h"
#include "shared/base/text.h"

namespace scree {
namespace {

/// Without spaces around it.
std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

Talk::Talk(bool chat) : chat_(chat), all_lines_(limits::lines_per_second_all, limits::lines_burst_all) {}

void Talk::join(uint64_t session, uint64_t party, const std::string& name, Role role) {
  const RateLimit lines(limits::lines_per_second_max, limits::lines_burst_max);
  persons_.insert_or_assign(session, Entry{party, name, role, lines, 0});
  ++version_;
}

void Talk::leave(uint64_t session) {
  if (persons_.erase(session) > 0) ++version_;
}

bool Talk::may_say(Entry& speaker, double now_s) {
  if (!speaker.lines.try_spend(now_s)) return false;
  std::erase_if(parties_,
                [&](const auto& entry) { return now_s - entry.second.said_s >= limits::lines_memory_s; });
  const RateLimit whole(limits::lines_per_second_party, limits::lines_burst_party);
  PartyLines& party = parties_.try_emplace(speaker.party, PartyLines{whole, now_s}).first->second;
  party.said_s = now_s;
  return party.lines.try_spend(now_s);
}

std::optional<Talk::Heard> Talk::say(uint64_t session, const std::string& text, double now_s) {
  const auto answer = [](std::string words) { return Heard{{0, "", std::move(words)}, false}; };
  if (!chat_) return answer("chat is off on this server (--chat)");
  const auto speaker = persons_.find(session);
  if (speaker == persons_.end()) return std::nullopt;
  std::string line = trimmed(showable(text, limits::line_bytes_max));
  if (line.empty()) return std::nullopt;
  if (!may_say(speaker->second, now_s))
    return answer(
        fmt::format("more than {} lines at once, or more than {} a second, or too many from your address or "
                    "token: this line was not sent",
                    limits::lines_burst_max, limits::lines_per_second_max));
  if (!all_lines_.try_spend(now_s)) return answer("too many people write at once: this line was not sent");
  return Heard{{session, speaker->second.name, std::move(line)}, true};
}

std::vector<uint64_t> Talk::untold(double now_s) const {
  std::vector<uint64_t> sessions;
  if (now_s < next_list_s_) return sessions;
  for (const auto& [session, entry] : persons_)
    if (entry.told != version_) sessions.push_back(session);
  return sessions;
}

PersonsMessage Talk::list() const {
  PersonsMessage message;
  message.chat = chat_;
  for (const auto& [session, entry] : persons_) {
    if (message.persons.size() == limits::persons_max) break;
    message.persons.push_back({session, entry.name, entry.role});
  }
  message.more = static_cast<uint32_t>(persons_.size() - message.persons.size());
  return message;
}

void Talk::told(uint64_t session, double now_s) {
  persons_.at(session).told = version_;
  const bool many = persons_.size() > limits::persons_max;
  next_list_s_ = now_s + (many ? limits::persons_many_interval_s : limits::persons_interval_s);
}

std::vector<uint64_t> Talk::everybody() const {
  std::vector<uint64_t> sessions;
  for (const auto& [session, entry] : persons_) sessions.push_back(session);
  return sessions;
}

}  // namespace scree
