// What the server and its host change of a NetHost while it runs: who may come in, the page, and what
// sessions may.
#include <utility>

#include "server/net/net_host.h"
#include "shared/base/check.h"

namespace scree {

void NetHost::set_access(std::shared_ptr<const Access> access) {
  CHECK(network_thread_.is_the_same());
  authorizer_.set_access(std::move(access));
  administration_.read_bans_again();
  log_access(authorizer_.access());
  end_lapsed_grants(sessions_, authorizer_.access());
}

void NetHost::send(uint64_t session, const ServerMessage& message) {
  administration_.note_answered(session, message);
  if (const SessionEntry* const entry = sessions_.find(session)) entry->session->send(message);
}

void NetHost::set_role(uint64_t session, Role role) {
  SessionEntry* const entry = sessions_.find(session);
  if (entry == nullptr) return;
  entry->grant.role = role;
  talk_.set_role(session, role);
}

void NetHost::kick(uint64_t session, const std::string& reason) {
  const SessionEntry* const entry = sessions_.find(session);
  if (entry == nullptr) return;
  const auto kicked = entry->session;  // which leaves the table
  kicked->refuse({Refusal::kicked, reason});
}

void NetHost::set_files(std::shared_ptr<const WebFiles> files) {
  CHECK(network_thread_.is_the_same());
  web_.set_files(std::move(files));
}

}  // namespace scree
