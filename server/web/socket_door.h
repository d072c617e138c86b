// Which requests open a WebSocket, and why others do not. A browser does not show its page the answer to a
// handshake that failed. So the page names its attempt in the target, and asks afterwards what the server
// saw: mostly a proxy that has taken something out of the request. No sockets. Not thread-safe.
//
// A page may join when it is the server's own: its Origin is the request's Host, or a site that the operator
// named. A proxy may hide the Host. Then a pass shows the same: only a page of this site can read the answer
// that holds it. It is for the address that asked, so nobody can hand it to others.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/web/http_request.h"
#include "server/web/http_response.h"

namespace scree {

/// Who asks.
struct WebPeer {
  bool from_here = false;  ///< a program on this machine, and no proxy in between
  std::string address{};   ///< as of Door
};

class SocketDoor {
 public:
  /// `origins`: as in WebConfig.
  explicit SocketDoor(std::vector<std::string> origins);

  /// The answer to a handshake.
  HttpResponse open(const HttpRequest& request, const WebPeer& peer);
  /// The answer to a page whose handshake failed.
  HttpResponse tell(const HttpRequest& request, const WebPeer& peer) const;
  /// A handshake failed for this reason, a text that may be shown (shared/base/text.h). `foreign`: the page
  /// did not show that it is of this site.
  void note(const HttpRequest& request, const std::string& words, bool foreign = false);

 private:
  struct Attempt {
    std::string name;
    std::string words;
    bool foreign = false;
  };

  bool may_join(const HttpRequest& request, const WebPeer& peer) const;
  std::string pass_for(const std::string& address) const;

  std::vector<std::string> origins_;
  std::string secret_;
  std::deque<Attempt> attempts_;  ///< that failed, in order
};

/// Whether a text is an origin as browsers write it: scheme, host, and a port other than the scheme's own.
bool is_origin(std::string_view text);

/// Whether a Host is this machine's for certain: a number, localhost, or the machine's own name. Any other
/// name that leads from here to here may be one that a page made to do so (DNS rebinding), or a proxy's.
bool is_own_host(std::string_view host);

}  // namespace scree
