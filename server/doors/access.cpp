#include "server/doors/access.h"

#include <algorithm>
#include <asio/ip/address.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "proto/limits.h"
#include "server/doors/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/token.h"

namespace scree {

namespace {

Result<void> check_together(const AccessConfig& config, const std::string& admin_token) {
  const bool has_certificate = !config.tls_certificate_path.empty();
  if (has_certificate != !config.tls_key_path.empty())
    return fail("a TLS certificate and its key come together (--tls-cert, --tls-key)");
  if (config.tls_required && !has_certificate)
    return fail("TLS cannot be required without a certificate (--tls-required, --tls-cert)");
  if (!config.token_revoked_path.empty() && config.token_key_path.empty())
    return fail("a list of revoked tokens needs the key of tokens (--token-revoked, --token-key)");
  if (!config.anonymous && config.token_key_path.empty() && admin_token.empty())
    return fail(
        "nobody could join: there is neither a key of tokens nor an admin token (--anonymous none, "
        "--token-key, --admin-token-file)");
  if (config.world.size() > limits::world_name_bytes_max)
    return fail(
        fmt::format("the world's name has at most {} bytes (--world-name)", limits::world_name_bytes_max));
  return {};
}

std::string may_of(Role role) {
  std::string may;
  for (const Role each : all_kinds<Role>)
    if (may_act_as(role, each)) may += (may.empty() ? "" : ", ") + std::string(traits_of(each).may);
  return may;
}

}  // namespace

Result<std::shared_ptr<const Access>> Access::load(const AccessConfig& config,
                                                   const std::string& admin_token) {
  TRY(check_together(config, admin_token));
  std::shared_ptr<Access> access(new Access);
  access->anonymous_ = config.anonymous;
  access->world_ = config.world;
  access->admin_token_ = admin_token;
  if (!config.tls_certificate_path.empty()) {
    auto tls = TRY(TlsServerContext::load(config.tls_certificate_path, config.tls_key_path));
    access->tls_ = std::move(tls);
  }
  if (!config.token_key_path.empty()) {
    auto key = TRY(VerifyingKey::read(config.token_key_path));
    access->key_ = std::move(key);
  }
  if (!config.token_revoked_path.empty()) {
    auto revoked = TRY(read_revoked(config.token_revoked_path));
    access->revoked_ = std::move(revoked);
  }
  return access;
}

/// A token that cannot be used is refused, so that nobody looks on where he thinks that he may build. A
/// server that takes none at all does not look at them.
tl::expected<Grant, Refused> Access::grant(const std::string& token, uint64_t now_s) const {
  if (!token.empty() && !admin_token_.empty() && same_token(token, admin_token_)) return Grant{Role::admin};
  if (!token.empty() && key_) {
    const auto read = read_access_token(token);
    if (!read) return refuse(Refusal::token_malformed, read.error().message);
    return grant_to(*read, now_s);
  }
  if (!token.empty() && !admin_token_.empty()) {
    if (is_access_token(token))
      return refuse(Refusal::token_foreign, "this server accepts no access tokens (--token-key)");
    return refuse(Refusal::admin_token_wrong, "this server does not know the token");
  }
  if (!anonymous_)
    return refuse(Refusal::token_missing, "this server requires an access token: ask its operator for one");
  return Grant{*anonymous_};
}

tl::expected<Grant, Refused> Access::grant_to(const ReadToken& read, uint64_t now_s) const {
  const AccessToken& token = read.token;
  if (!read.is_by(*key_))
    return refuse(Refusal::token_foreign,
                  "the token was not signed by this server's key: is it for another server?");
  if (!token.world.empty() && token.world != world_)
    return refuse(Refusal::token_world,
                  fmt::format("the token is for the world '{}', and this one is {}", token.world,
                              world_.empty() ? "without a name" : "'" + world_ + "'"));
  const Grant grant{.role = token.role,
                    .token_id = token.id,
                    .expires_s = token.expires_s,
                    .name = token.name,
                    .team = token.team};
  TRY(still_holds(grant, now_s));
  return grant;
}

tl::expected<void, Refused> Access::still_holds(const Grant& grant, uint64_t now_s) const {
  if (grant.token_id != 0 && is_revoked(grant.token_id))
    return refuse(Refusal::token_revoked, "the token " + id_text(grant.token_id) + " was revoked");
  if (grant.expires_s != 0 && grant.expires_s <= now_s)
    return refuse(Refusal::token_expired, "the token has expired: ask for a new one");
  return {};
}

bool Access::is_revoked(uint64_t id) const {
  return std::ranges::binary_search(revoked_, id);
}

namespace {

bool is_own(const StoreName& store) {
  return store.kind == StoreKind::own;
}

/// Everybody digs and places by the own store, and may give what is in it to all.
Role role_of(const DigRequest& dig) {
  return is_own(dig.store) ? Role::carver : Role::director;
}
Role role_of(const PlaceRequest& place) {
  if (!is_own(place.store)) return Role::director;
  return place.solid ? Role::builder : Role::carver;
}
Role role_of(const TransferRequest& transfer) {
  return is_own(transfer.from) && transfer.to == worlds_store() ? Role::carver : Role::director;
}

}  // namespace

Role role_for(const Request& request) {
  return std::visit(Overloaded{[](const CarveRequest&) { return Role::carver; },
                               [](const FillRequest&) { return Role::builder; },
                               [](const PaintRequest&) { return Role::builder; },
                               [](const SettingsRequest&) { return Role::admin; },
                               [](const LeaveRequest&) { return Role::viewer; },
                               [](const AddPropRequest&) { return Role::director; },
                               [](const RemovePropRequest&) { return Role::director; },
                               [](const MovePropRequest&) { return Role::director; },
                               [](const PushRequest& push) {
                                 const float most = limits::carver_push_max_n_s;
                                 const bool is_small =
                                     glm::dot(push.impulse_n_s, push.impulse_n_s) <= most * most;
                                 return is_small ? Role::carver : Role::director;
                               },
                               [](const BreakRequest&) { return Role::carver; },
                               [](const BlastRequest&) { return Role::carver; },
                               [](const AddJointRequest&) { return Role::director; },
                               [](const RemoveJointRequest&) { return Role::director; },
                               [](const SetMotorRequest&) { return Role::director; },
                               [](const CutOutRequest&) { return Role::director; },
                               [](const ReleaseRequest&) { return Role::director; },
                               [](const StandRequest&) { return Role::carver; },
                               [](const WalkRequest&) { return Role::carver; },
                               [](const AddPieceRequest&) { return Role::director; },
                               [](const SetRegionRequest&) { return Role::director; },
                               [](const RemoveRegionRequest&) { return Role::director; },
                               [](const DigRequest& dig) { return role_of(dig); },
                               [](const PlaceRequest& place) { return role_of(place); },
                               [](const TransferRequest& transfer) { return role_of(transfer); },
                               [](const RulesRequest&) { return Role::admin; },  // whom the world refuses
                               [](const RestoreRequest&) { return Role::admin; }},
                    request);
}

std::vector<std::string> open_doors(const AccessConfig& config, const std::string& bind) {
  asio::error_code error;
  const auto address = asio::ip::make_address(bind, error);
  if (error || address.is_loopback()) return {};
  std::vector<std::string> open;
  if (config.anonymous)
    open.push_back(fmt::format("anyone who reaches {} may {} without a token (--anonymous, --token-key)",
                               bind, may_of(*config.anonymous)));
  if (config.tls_certificate_path.empty())
    open.push_back(
        "all traffic, tokens included, can be read and changed on its way (--tls-cert, --tls-key)");
  else if (!config.tls_required)
    open.push_back(
        "clients may connect without TLS, and their traffic can be read on its way (--tls-required)");
  return open;
}

}  // namespace scree
