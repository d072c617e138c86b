#include "server/host/host_hooks.h"

#include <algorithm>
#include <utility>

#include "proto/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::string_view host_name_prefix = "game:";
static_assert(host_name_prefix.size() + host_name_bytes_max <= limits::refusal_name_bytes_max);

bool is_host_name(std::string_view name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return name.size() <= host_name_bytes_max && std::ranges::all_of(name, fits);
}

bool leaves(const Request& request) {
  return std::holds_alternative<LeaveRequest>(request);
}

}  // namespace

TickCommands::TickCommands(std::vector<Command> commands)
    : commands_(std::move(commands)), given_(commands_.size()), refusals_(commands_.size()) {}

void TickCommands::refuse(size_t index, std::string words, std::string_view name) {
  CHECK_LT(index, commands_.size());
  CHECK(!leaves(commands_[index].body), "a session that leaves cannot be refused");
  CHECK(!words.empty(), "a refusal without words reads as if the request was carried out");
  CHECK(is_host_name(name), "a refusal's name has at most 27 of a-z, 0-9 and _");
  refusals_[index] = HostRefusal{std::move(words), std::string(name)};
}

void TickCommands::change(size_t index, Request body) {
  CHECK_LT(index, commands_.size());
  CHECK(!leaves(commands_[index].body) && !leaves(body),
        "only the network side reports the end of a session");
  commands_[index].body = std::move(body);
}

void TickCommands::add(Request body, uint32_t request) {
  CHECK(!leaves(body), "only the network side reports the end of a session");
  commands_.push_back({0, request, std::move(body)});
  refusals_.emplace_back();
}

void TickCommands::add(Request body, uint32_t request, const std::string& rules, uint64_t party) {
  add(std::move(body), request);
  commands_.back().asker = {Role::admin, rules, {}};
  commands_.back().party = party;
}

std::vector<Reply> TickCommands::refused() const {
  std::vector<Reply> replies;
  for (size_t i = 0; i < commands_.size(); ++i) {
    if (!refusals_[i]) continue;
    Reply reply{commands_[i].session, commands_[i].request, refusals_[i]->words, 0};
    reply.reason = Refusal::host;
    reply.host_name = refusals_[i]->name;
    replies.push_back(std::move(reply));
  }
  return replies;
}

std::vector<Command> TickCommands::let_through() const {
  std::vector<Command> through;
  for (size_t i = 0; i < commands_.size(); ++i)
    if (!refusals_[i]) through.push_back(commands_[i]);
  return through;
}

}  // namespace scree
