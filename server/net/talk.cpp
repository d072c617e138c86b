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

Talk::Talk(bool chat)
    : chat_(chat),
      all_lines_(limits::lines_per_second_all, limits::lines_per_second_all * limits::lines_burst_s) {}

double Talk::lines_per_second() const {
  const double persons = std::max(1.0, static_cast<double>(persons_.size()));
  return std::max(limits::lines_per_second_all, limits::lines_heard_per_second / persons);
}

void Talk::join(uint64_t session, uint64_t party, const std::string& name, Role role) {
  const RateLimit lines(limits::lines_per_second_max, limits::lines_burst_max);
  persons_.insert_or_assign(session, Entry{party, name, role, lines, 0});
  ++version_;
}

void Talk::rename(uint64_t session, const std::string& name) {
  const auto found = persons_.find(session);
  if (found == persons_.end()) return;
  found->second.name = name;
  ++version_;
}

void Talk::set_role(uint64_t session, Role role) {
  const auto found = persons_.find(session);
  if (found == persons_.end()) return;
  found->second.role = role;
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
  const double share = lines_per_second() / static_cast<double>(parties_.size());
  party.lines.change(std::min(limits::lines_per_second_party, share),
                     std::clamp(share * limits::lines_burst_s, 1.0, limits::lines_burst_party));
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
  all_lines_.change(lines_per_second(), lines_per_second() * limits::lines_burst_s);
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
  const auto add = [&](const auto& one) {
    if (message.persons.size() < limits::persons_max)
      message.persons.push_back({one.first, one.second.name, one.second.role});
  };
  if (persons_.size() <= limits::persons_max) {
    std::ranges::for_each(persons_, add);
  } else {
    // One of each party first, so that nobody hides the others by being many.
    std::map<uint64_t, size_t> turns;
    std::map<size_t, std::vector<uint64_t>> by_turn;
    for (const auto& [session, entry] : persons_) by_turn[turns[entry.party]++].push_back(session);
    for (const auto& [turn, sessions] : by_turn)
      for (const uint64_t session : sessions) add(*persons_.find(session));
    std::ranges::sort(message.persons, {}, &Person::session);
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
