// The names under which a server may be reached by HTTP, and what a request shows of its way here. A value.
//
// A browser tells pages of different names apart, and nothing else. So a foreign page whose name leads to
// this server's address (DNS rebinding) could ask it, and open WebSockets, as if it were the server's own
// page: from within a network or a machine that its author does not reach. A request therefore needs a Host
// that nobody else can own: an address in numbers, a name of this machine, or one that the operator has
// named.
#pragma once

#include <string>
#include <string_view>

#include "server/web/http_request.h"
#include "server/web/web_config.h"
#include "shared/base/result.h"

namespace scree {

class WebNames {
 public:
  WebNames() = default;
  explicit WebNames(const WebConfig& config) : hosts_(config.hosts), origins_(config.origins) {}

  /// Whether the server answers to this Host: an address in numbers, localhost, the machine's own name (also
  /// with .local), a name of WebConfig::hosts, or that of a site of WebConfig::origins. The port is not
  /// looked at. A request without a Host is no browser's.
  bool knows_host(std::string_view host) const;
  /// Likewise of a page's site, without regard of WebConfig::origins.
  bool knows_site(std::string_view origin) const;
  /// Whether the operator lets pages of this site join.
  bool is_named_site(std::string_view origin) const;
  /// Whether the operator has named any host: then a trusted proxy passes on no other.
  bool names_hosts() const { return !hosts_.empty(); }

 private:
  std::vector<std::string> hosts_;
  std::vector<std::string> origins_;
};

/// The name of a Host, without port, brackets and the last dot; empty: brackets do not end it.
std::string_view name_of_host(std::string_view host);
/// A loopback address, or localhost: no other machine is reached by it.
bool is_loopback_host(std::string_view host);
/// The machine's own name; empty: it has none.
std::string own_host_name();

/// Whether the page of this origin is of the site that the Host names. A proxy in between may speak TLS for
/// the server, so that schemes differ.
bool is_of_host(std::string_view origin, std::string_view host);

/// Whether a request shows that it came through a proxy, or from a foreign page: it has fields that proxies
/// add, is of HTTP/1.0, names another host than this machine, or its page is not of its host. A program on
/// this machine that asks it by a loopback address shows none of that.
bool shows_strangers(const HttpRequest& request);

/// What is wrong with a name for WebConfig::hosts.
Result<void> check_host_name(std::string_view name);

/// Whether a text is an origin as browsers write it: scheme, host, and a port other than the scheme's own.
bool is_origin(std::string_view text);

/// Whether two names are the same, whatever the case of their letters.
bool is_same_name(std::string_view a, std::string_view b);

}  // namespace scree
