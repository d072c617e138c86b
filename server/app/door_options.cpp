#include "server/app/door_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <unistd.h>

#include "auth/access_token.h"
#include "auth/new_secret.h"
#include "server/doors/limits.h"
#include "shared/base/option_check.h"
#include "shared/base/token.h"

namespace scree {

namespace {

constexpr const char* nobody = "none";

void declare_access(CLI::App& app, AccessConfig& access) {
  CLI::Option* certificate =
      app.add_option("--tls-cert", access.tls_certificate_path,
                     "PEM file of the certificate, followed by its chain; lets clients connect by TLS");
  CLI::Option* key =
      app.add_option("--tls-key", access.tls_key_path, "PEM file of the certificate's private key");
  certificate->needs(key);
  key->needs(certificate);
  app.add_flag("--tls-required", access.tls_required, "refuses connections without TLS")->needs(certificate);
  CLI::Option* tokens = app.add_option("--token-key", access.token_key_path,
                                       "public key that verifies access tokens (scree token key makes it)");
  app.add_option("--token-revoked", access.token_revoked_path, "file of the revoked tokens, one id a line")
      ->needs(tokens);
  app.add_option("--world-name", access.world,
                 "this world's name, for tokens that are valid in one world only, and on --nats");
  app.add_option("--bans", access.bans_path, "file that keeps bans; without it, bans end with the server");
}

}  // namespace

void DoorOptions::declare(CLI::App& app, NetConfig& net) {
  declare_admin(app, net);
  declare_access(app, net.access);
  app.add_option("--anonymous", anonymous_,
                 "role of clients without a token: viewer, carver, builder or none (refused); default: "
                 "builder, or none with --token-key")
      ->check(CLI::IsMember(std::vector<std::string>{"viewer", "carver", "builder", nobody}));
  declare_limits(app, net);
}

void DoorOptions::declare_admin(CLI::App& app, NetConfig& net) {
  CLI::Option* token =
      app.add_option("--admin-token", net.admin_token,
                     "token of administrators, who change settings, kick and ban; --admin-token-file is "
                     "safer, because other users can see command lines");
  CLI::Option* file =
      app.add_option("--admin-token-file", token_path_, "file whose first line is the admin token")
          ->excludes(token);
  app.add_flag("--make-admin-token", makes_token_,
               "makes the --admin-token-file with a new token if it is missing")
      ->needs(file);
  app.add_option("--admin-socket", net.admin_socket,
                 "file of a Unix socket, made at the start, by which this server's user and root are "
                 "administrators without a token (scree-admin --socket)");
}

/// Who is let in by address, and whose word counts for it.
void DoorOptions::declare_limits(CLI::App& app, NetConfig& net) {
  app.add_option(
      "--proxy", proxies_,
      "ADDRESS or ADDRESS/BITS of proxies that are trusted to name their clients, by PROXY headers "
      "or X-Forwarded-For; repeatable");
  app.add_option(
      "--metrics-network", metrics_networks_,
      "ADDRESS or ADDRESS/BITS of programs that may read /metrics without a token, beside those of "
      "this machine; repeatable");
  bounded(app.add_option("--connections-per-address", net.door.connections_max,
                         "connections that one address may hold; this machine's own have no limit"),
          whole_within(1, limits::door_connections_most))
      ->capture_default_str();
  bounded(app.add_option("--connects-per-second", net.door.connects_per_second,
                         "connections that one address may open a second, on average"),
          {limits::door_connects_least, limits::door_connects_most})
      ->capture_default_str();
  declare_bytes_out(app);
}

void DoorOptions::declare_bytes_out(CLI::App& app) {
  bounded(app.add_option("--bytes-out", bytes_out_mb_,
                         "megabytes a second to all clients together; above, chunks, tiles, ground and files "
                         "of the page wait; 0: no limit"),
          {0.0, limits::bytes_out_most_mb})
      ->capture_default_str();
  bounded(app.add_option("--bytes-out-per-address", bytes_out_per_address_mb_,
                         "likewise, to one address; this machine's own have no limit"),
          {0.0, limits::bytes_out_most_mb})
      ->capture_default_str();
}

void DoorOptions::complete(NetConfig& net, bool may_make_token) {
  check_bans(net.access.bans_path);
  complete_token(net, may_make_token);
  // Who has a key for tokens wants them.
  if (anonymous_.empty() && !net.access.token_key_path.empty()) anonymous_ = nobody;
  if (!anonymous_.empty()) net.access.anonymous = kind_named<Role>(anonymous_);  // none: no role
  complete_limits(net);
}

/// Otherwise the first ban would fail, long after the start. A new file takes the place of the old one, so
/// the folder has to be writable.
void DoorOptions::check_bans(const std::string& path) {
  if (path.empty()) return;
  const std::string folder = std::filesystem::absolute(path).parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw CLI::ValidationError(
        "--bans", "bans cannot be kept: " + folder + " cannot be written: " + std::strerror(errno));
}

/// The token is looked at where mistakes in options are.
void DoorOptions::complete_token(NetConfig& net, bool may_make_token) {
  std::error_code ignored;
  const bool makes_now = makes_token_ && !std::filesystem::exists(token_path_, ignored);
  if (makes_now && !may_make_token) return;
  if (makes_now) {
    if (const auto made = write_new_secret(token_path_); !made)
      throw CLI::ValidationError("--make-admin-token", made.error().message);
    token_made_ = token_path_;
  }
  if (!token_path_.empty()) {
    Result<std::string> read = read_token(token_path_);
    const bool is_missing = !std::filesystem::exists(token_path_, ignored) && !ignored;
    if (!read)
      throw CLI::ValidationError("--admin-token-file",
                                 read.error().message + (is_missing ? " (--make-admin-token makes it)" : ""));
    net.admin_token = std::move(*read);
  }
  if (net.admin_token.empty()) return;
  if (is_access_token(net.admin_token))
    throw CLI::ValidationError(
        "--admin-token",
        "this is an access token, which --token-key verifies; an admin token is a secret of its own "
        "(--make-admin-token)");
  if (Result<void> good = check_token(net.admin_token); !good)
    throw CLI::ValidationError("--admin-token", good.error().message);
}

void DoorOptions::complete_limits(NetConfig& net) const {
  auto proxies = Proxies::parse(proxies_);
  if (!proxies) throw CLI::ValidationError("--proxy", proxies.error().message);
  net.proxies = std::move(*proxies);
  auto readers = read_networks(metrics_networks_);
  if (!readers) throw CLI::ValidationError("--metrics-network", readers.error().message);
  net.metrics_readers = std::move(*readers);
  net.bytes_out = {bytes_out_per_address_mb_ * bytes_per_mb, bytes_out_mb_ * bytes_per_mb};
  // Who may hold many may open them at once.
  net.door.connects_burst = std::max(net.door.connects_burst, static_cast<double>(net.door.connections_max));
}

}  // namespace scree
