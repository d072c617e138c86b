// What the server answers to HTTP requests by itself: the page's files, and the handshake of a WebSocket. No
// sockets. Not thread-safe.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/web/http_request.h"
#include "server/web/http_response.h"
#include "server/web/socket_door.h"
#include "server/web/web_files.h"

namespace scree {

class Site {
 public:
  /// `origins`: as in WebConfig. `files` is not null.
  Site(std::shared_ptr<const WebFiles> files, std::vector<std::string> origins)
      : files_(std::move(files)), socket_door_(std::move(origins)) {}

  /// From now on.
  void set_files(std::shared_ptr<const WebFiles> files) { files_ = std::move(files); }
  HttpResponse answer(const HttpRequest& request, const WebPeer& peer);
  /// A handshake that was to be answered by 101 is refused for this reason.
  void note_refused(const HttpRequest& request, const std::string& words) {
    socket_door_.note(request, words);
  }

 private:
  HttpResponse file(const HttpRequest& request) const;
  bool below_another_path(std::string_view path) const;

  std::shared_ptr<const WebFiles> files_;
  SocketDoor socket_door_;
};

}  // namespace scree
