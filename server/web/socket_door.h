// Which requests open a WebSocket, and why others do not. A browser does not show its page the answer to a
// handshake that failed. So the page names its attempt in the target, and asks afterwards what the server
// saw: mostly a proxy that has taken something out of the request. No sockets. Not thread-safe.
//
// A page may join when it is the server's own: its Origin is the request's Host, and a name that the server
// knows (web_names.h); or it is of a site that the operator named. A proxy may hide the Host. Then a pass
// shows the same: only a page of this site can read the answer that holds it. It is for the address that
// asked, so nobody can hand it to others.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "server/web/http_request.h"
#include "server/web/http_response.h"
#include "server/web/web_names.h"

namespace scree {

/// Who asks.
struct WebPeer {
  bool from_here = false;  ///< of this machine, a program or a proxy that does not say so
  std::string address{};   ///< as of Door
  bool vouched = false;    ///< a trusted proxy has said for whom, or under which name, it asks
};

class SocketDoor {
 public:
  explicit SocketDoor(WebNames names);

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

  WebNames names_;
  std::string secret_;
  std::deque<Attempt> attempts_;  ///< that failed, in order
};

}  // namespace scree
