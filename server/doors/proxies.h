// The proxies that the operator trusts to say for whom they speak: by a PROXY header
// (transport/proxy_header.h) or by X-Forwarded-For. What others say of that is not looked at. A value.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/doors/ip_network.h"
#include "shared/base/result.h"

namespace scree {

class Proxies {
 public:
  /// Networks as ADDRESS/BITS, or single addresses, of IPv4 or IPv6.
  static Result<Proxies> parse(const std::vector<std::string>& networks);

  bool empty() const { return networks_.empty(); }
  bool contains(std::string_view ip) const;
  /// Whom a trusted proxy at `sender` speaks for, by its X-Forwarded-For: each proxy adds the address that it
  /// saw at the right, so the client is the rightmost that is no trusted proxy's. Further left anybody may
  /// write anything. `sender` itself when the field names nobody, or its right end is no address.
  std::string client_of(std::string_view forwarded_for, const std::string& sender) const;

 private:
  std::vector<IpNetwork> networks_;
};

}  // namespace scree
