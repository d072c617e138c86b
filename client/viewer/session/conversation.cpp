#include "client/viewer/session/conversation.h"

#include "client/viewer/base/limits.h"
#include "proto/person_name.h"

namespace scree {

void Conversation::apply(const SaidMessage& said, double now_s) {
  if (lines_.size() >= limits::lines_kept_max) lines_.pop_front();
  const std::string speaker = said.session == 0 ? "server" : called(said.session, said.name);
  lines_.push_back({speaker + ": " + said.text, now_s});
}

std::vector<std::string> Conversation::lines(double now_s, bool all) const {
  std::vector<std::string> shown;
  for (const Line& line : lines_)
    if (all || now_s < line.at_s + limits::line_shown_s) shown.push_back(line.text);
  return shown;
}

}  // namespace scree
