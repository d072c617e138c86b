// What a game's rules and persons show and tell a bot.
#include <fmt/format.h>

#include "client/bot/bot.h"
#include "client/bot/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Bytes for a log: as text, as far as they are such.
std::string in_words(const std::vector<uint8_t>& bytes) {
  return showable({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, limits::bot_heard_shown_bytes);
}

}  // namespace

void Bot::receive_rules(const ServerMessage& message) {
  RulesReport& rules = report_.rules;
  std::visit(Overloaded{[&](const SignsMessage& signs) {
                          ++rules.signs;
                          log("signs", fmt::format("{} signs", signs.signs.size()));
                        },
                        [&](const CuesMessage& cues) { rules.cues += cues.cues.size(); },
                        [&](const ChannelMessage& data) {
                          ++rules.messages;
                          if (rules.heard.size() < limits::bot_heard_max) rules.heard.push_back(data);
                          log("message", fmt::format("{}: {}", data.channel, in_words(data.bytes)));
                        },
                        [&](const SaidMessage& line) {
                          ++rules.lines;
                          if (rules.said.size() < limits::bot_heard_max) rules.said.push_back(line);
                          const std::string who = line.session == 0 ? "server" : line.name;
                          log("said", showable(who + ": " + line.text, limits::bot_heard_shown_bytes));
                        },
                        [](const auto&) {}},
             message);
}

/// From the first frame on.
bool Bot::heard_enough() const {
  if (config_.hears_s == 0.0) return true;
  return std::chrono::duration<double>(Clock::now() - first_frame_at_).count() >= config_.hears_s;
}

}  // namespace scree
