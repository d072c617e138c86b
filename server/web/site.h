// What the server answers to HTTP requests by itself: the page's files, its health, the handshake of a
// WebSocket. No sockets. Not thread-safe.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/web/http_request.h"
#include "server/web/http_response.h"
#include "server/web/web_files.h"

namespace scree {

class Site {
 public:
  /// `origins`: as in WebConfig. `files` is not null.
  Site(std::shared_ptr<const WebFiles> files, std::vector<std::string> origins)
      : files_(std::move(files)), origins_(std::move(origins)) {}

  /// From now on.
  void set_files(std::shared_ptr<const WebFiles> files) { files_ = std::move(files); }
  /// `from_here`: the request came from this machine.
  HttpResponse answer(const HttpRequest& request, bool from_here) const;

 private:
  HttpResponse open_websocket(const HttpRequest& request, bool from_here) const;
  HttpResponse file(const HttpRequest& request) const;
  bool may_join(const HttpRequest& request, bool from_here) const;

  std::shared_ptr<const WebFiles> files_;
  std::vector<std::string> origins_;
};

/// Whether a text is an origin as browsers write it: scheme, host, and a port other than the scheme's own.
bool is_origin(std::string_view text);

/// Whether a Host is this machine's for certain: a number, localhost, or the machine's own name. Any other
/// name that leads from here to here may be one that a page made to do so (DNS rebinding), or a proxy's.
bool is_own_host(std::string_view host);

}  // namespace scree
