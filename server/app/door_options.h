// The options of scree-server by which its operator says who may come in, and how many: administrators,
// tokens, TLS, bans, proxies, limits of addresses, and what goes out to them.
#pragma once

#include <string>
#include <vector>

#include "server/doors/limits.h"
#include "server/net/net_server.h"

namespace CLI {
class App;
}

namespace scree {

class DoorOptions {
 public:
  /// Outlives the parsing, as `net` does.
  void declare(CLI::App& app, NetConfig& net);
  /// After the parsing: reads the admin token's file, or makes it, where it may. Throws CLI::ValidationError.
  void complete(NetConfig& net, bool may_make_token = true);

  const std::string& token_path() const { return token_path_; }
  bool makes_token() const { return makes_token_; }
  /// The file of an admin token that complete() has made; empty: none.
  const std::string& token_made() const { return token_made_; }

 private:
  static constexpr double bytes_per_mb = 1.0e6;

  void declare_admin(CLI::App& app, NetConfig& net);
  void declare_limits(CLI::App& app, NetConfig& net);
  void declare_bytes_out(CLI::App& app);
  static void check_bans(const std::string& path);
  void complete_token(NetConfig& net, bool may_make_token);
  void complete_limits(NetConfig& net) const;

  std::string token_path_;
  bool makes_token_ = false;
  std::string token_made_;
  std::string anonymous_;  ///< empty: by what else is given
  std::vector<std::string> proxies_;
  std::vector<std::string> metrics_networks_;
  double bytes_out_mb_ = limits::bytes_out_all / bytes_per_mb;
  double bytes_out_per_address_mb_ = limits::bytes_out_per_address / bytes_per_mb;
};

}  // namespace scree
