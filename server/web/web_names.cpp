#include "server/web/web_names.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <climits>
#include <fmt/format.h>
#include <unistd.h>

#include "server/web/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Without the port that its scheme means anyhow.
std::string_view without_default_port(std::string_view host, std::string_view scheme) {
  const std::string_view port = scheme == "https" ? ":443" : ":80";
  return host.ends_with(port) ? host.substr(0, host.size() - port.size()) : host;
}

/// The host, with its port, of an origin or another address of a page; empty: it is neither http nor https.
std::string_view host_of_origin(std::string_view origin) {
  const size_t end = origin.find("://");
  if (end == origin.npos) return {};
  const std::string_view scheme = origin.substr(0, end);
  return scheme == "http" || scheme == "https" ? origin.substr(end + 3) : std::string_view();
}

bool is_v4(const std::string& name) {
  in_addr address{};
  return inet_pton(AF_INET, name.c_str(), &address) == 1;
}

bool is_v6(const std::string& name) {
  in6_addr address{};
  return inet_pton(AF_INET6, name.c_str(), &address) == 1;
}

/// Such names never leave the machine that asks for them (RFC 6761, 6.3).
bool is_localhost(std::string_view name) {
  constexpr std::string_view below = ".localhost";
  return is_same_name(name, below.substr(1)) ||
         (name.size() > below.size() && is_same_name(name.substr(name.size() - below.size()), below));
}

bool is_own_name(std::string_view name) {
  const std::string own = own_host_name();
  return !own.empty() && (is_same_name(name, own) || is_same_name(name, own + ".local"));
}

/// An address in numbers has one owner, and no name that another page could have.
bool is_number(std::string_view host) {
  const std::string name(name_of_host(host));
  return host.starts_with('[') ? is_v6(name) : is_v4(name);
}

}  // namespace

bool is_same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

std::string_view name_of_host(std::string_view host) {
  if (host.starts_with('[')) {
    const size_t end = std::min(host.find(']'), host.size() - 1);
    const std::string_view behind = host.substr(end + 1);
    return host[end] == ']' && (behind.empty() || behind.starts_with(':')) ? host.substr(1, end - 1)
                                                                           : std::string_view();
  }
  const std::string_view name = host.substr(0, host.find(':'));
  return name.ends_with('.') ? name.substr(0, name.size() - 1) : name;
}

std::string own_host_name() {
  std::array<char, HOST_NAME_MAX + 1> own{};
  return gethostname(own.data(), own.size() - 1) == 0 ? std::string(own.data()) : std::string();
}

bool is_loopback_host(std::string_view host) {
  const std::string name(name_of_host(host));
  if (host.starts_with('[')) return is_v6(name) && (name == "::1" || name == "0:0:0:0:0:0:0:1");
  return is_localhost(name) || (is_v4(name) && name.starts_with("127."));
}

bool WebNames::knows_host(std::string_view host) const {
  if (host.empty() || is_number(host)) return true;
  const std::string_view name = name_of_host(host);
  if (name.empty()) return false;
  if (is_localhost(name) || is_own_name(name)) return true;
  const auto is_it = [&](std::string_view known) { return is_same_name(name_of_host(known), name); };
  return std::ranges::any_of(hosts_, is_it) ||
         std::ranges::any_of(origins_, [&](const auto& site) { return is_it(host_of_origin(site)); });
}

bool WebNames::knows_site(std::string_view origin) const {
  const std::string_view host = host_of_origin(origin);
  return !host.empty() && knows_host(host);
}

bool WebNames::is_named_site(std::string_view origin) const {
  return std::ranges::any_of(origins_, [&](const auto& site) { return is_same_name(site, origin); });
}

bool is_of_host(std::string_view origin, std::string_view host) {
  const std::string_view site = host_of_origin(origin);
  if (site.empty() || host.empty()) return false;
  const std::string_view scheme = origin.substr(0, origin.find("://"));
  return is_same_name(without_default_port(site, scheme), without_default_port(host, scheme));
}

bool shows_strangers(const HttpRequest& request) {
  return request.relayed || !is_loopback_host(request.host) ||
         (request.origin && !is_of_host(*request.origin, request.host));
}

Result<void> check_host_name(std::string_view name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  const auto is_well_formed = [&] {
    for (std::string_view rest = name; !rest.empty();) {
      const std::string_view label = rest.substr(0, rest.find('.'));
      if (label.empty() || !std::ranges::all_of(label, fits)) return false;
      rest = rest.substr(std::min(label.size() + 1, rest.size()));
    }
    return !name.empty() && !name.ends_with('.') && name.size() <= limits::host_bytes_max;
  };
  if (is_well_formed() || is_v6(std::string(name))) return {};
  return fail(
      fmt::format("'{}' is not the name of a host: write it without http://, port and path, in the letters "
                  "that browsers send (xn--… for others than a to z)",
                  showable(name, limits::host_bytes_max)));
}

bool is_origin(std::string_view text) {
  for (const std::string_view scheme : {"http", "https"}) {
    const std::string start = std::string(scheme) + "://";
    if (!text.starts_with(start)) continue;
    const std::string_view host = text.substr(start.size());
    return !host.empty() && host.find_first_of("/?#@ *") == host.npos &&
           without_default_port(host, scheme).size() == host.size();
  }
  return false;
}

}  // namespace scree
