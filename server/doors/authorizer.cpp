#include "server/doors/authorizer.h"

#include <cmath>
#include <fmt/format.h>

#include "auth/access_token.h"
#include "shared/base/token.h"

namespace scree {

Result<void> Authorizer::open() {
  access_ = TRY(Access::load(config_, admin_token_));
  bans_ = TRY(Bans::open(config_.bans_path));
  return {};
}

tl::expected<void, Refused> Authorizer::check_admin_token(const std::string& address,
                                                          const std::string& token, double now_s) {
  if (door_.knows_as_wrong(address, token))
    return refuse(Refusal::admin_token_wrong, "this server does not know the token, as before");
  if (const double wait_s = door_.wait_for_guess_s(address, now_s); wait_s > 0.0)
    return refuse(
        Refusal::token_guesses,
        fmt::format("wrong tokens came from your address: the server checks the next one in {:.0f} s",
                    std::ceil(wait_s)));
  if (same_token(token, admin_token_)) return {};
  door_.guessed_wrong(address, token, now_s);
  return refuse(Refusal::admin_token_wrong, "this server does not know the token");
}

tl::expected<Grant, Refused> Authorizer::grant_to(const Caller& caller, const std::string& token,
                                                  const std::string& name, double now_s, uint64_t unix_s) {
  if (caller.is_owner) return Grant{.role = Role::admin, .name = name};
  if (config_.tls_required && !caller.encrypted)
    return refuse(Refusal::tls_required, "this server accepts only TLS (--tls)");
  const bool guesses = !token.empty() && has_admin_token() && !is_access_token(token);
  if (guesses) TRY(check_admin_token(caller.address, token, now_s));
  Grant grant = TRY(access_->grant(token, unix_s));
  grant.vouches_name = !grant.name.empty();
  if (!grant.vouches_name) grant.name = name;
  const auto found = bans_.find({caller.ip, grant.name, grant.token_id}, unix_s);
  // An administrator could not lift the ban of his own address.
  if (found && grant.role != Role::admin) return refuse(Refusal::banned, words_of(*found));
  return grant;
}

tl::expected<void, Refused> Authorizer::may_administer(Role role, const Caller& caller,
                                                       bool is_control) const {
  const auto admin = check_role(role, Role::admin);
  if (admin || knows_administrators()) return admin;
  if (is_control && door_.is_free(caller.address) && !caller.relayed) return {};
  const std::string_view what =
      is_control
          ? "only its own machine may control it, and only without --proxy, --web-host and --web-origin"
          : "nobody may administer it by the network";
  return refuse(
      Refusal::no_admin_token,
      fmt::format("this server was started without an admin token: {} (--admin-token-file, --token-key)",
                  what));
}

tl::expected<void, Refused> check_role(Role role, Role needed) {
  if (may_act_as(role, needed)) return {};
  return refuse(Refusal::role,
                fmt::format("that takes the role {}: this session is a {} (ask the operator for a token)",
                            name_of(needed), name_of(role)));
}

std::string words_of(const FoundBan& found) {
  return with_reason(std::string(found.target.words()) + " is banned from the server", found.ban.reason);
}

std::string with_reason(const std::string& what, const std::string& reason) {
  return reason.empty() ? what : what + ": " + reason;
}

}  // namespace scree
