// What the server answers to HTTP requests by itself: the page's files, and the handshake of a WebSocket. No
// sockets. Not thread-safe.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/web/http_request.h"
#include "server/web/http_response.h"
#include "server/web/socket_door.h"
#include "server/web/web_files.h"
#include "server/web/web_names.h"

namespace scree {

class Site {
 public:
  /// `files` is not null.
  Site(std::shared_ptr<const WebFiles> files, const WebNames& names)
      : files_(std::move(files)), names_(names), socket_door_(names) {}

  /// From now on.
  void set_files(std::shared_ptr<const WebFiles> files) { files_ = std::move(files); }
  HttpResponse answer(const HttpRequest& request, const WebPeer& peer);
  /// The answer to a request under a name that the server does not know; nothing: it knows it.
  std::optional<HttpResponse> refuse_host(const HttpRequest& request, const WebPeer& peer) const;
  /// A handshake that was to be answered by 101 is refused for this reason.
  void note_refused(const HttpRequest& request, const std::string& words) {
    socket_door_.note(request, words);
  }

 private:
  HttpResponse file(const HttpRequest& request) const;
  bool below_another_path(std::string_view path) const;

  std::shared_ptr<const WebFiles> files_;
  WebNames names_;
  SocketDoor socket_door_;
};

}  // namespace scree
