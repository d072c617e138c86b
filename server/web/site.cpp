#include "server/web/site.h"

#include <fmt/format.h>

#include "server/web/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

bool has_etag(std::string_view listed, std::string_view etag) {
  return listed == "*" || listed.find(etag) != listed.npos;
}

HttpResponse without_page() {
  return words(404,
               "This is a Scree server without its page. Build the page with ./scree web, or name the folder "
               "where it lies (--web DIR). The viewers reach the server on this port, too.");
}

HttpResponse without_administration() {
  return words(
      404,
      "This server's page was built without the part for administrators, because npm had not the modules "
      "for it. ./scree web builds it where npm reaches its registry; ./scree admin does the same.");
}

}  // namespace

HttpResponse Site::answer(const HttpRequest& request, const WebPeer& peer) {
  if (request.path == "/session") return socket_door_.open(request, peer);
  if (request.method == HttpMethod::other) {
    HttpResponse no = words(405, "this server answers GET and HEAD");
    no.fields.emplace_back("Allow", "GET, HEAD");
    return no;
  }
  if (request.path == "/session.json") return socket_door_.tell(request, peer);
  return file(request);
}

/// A trusted proxy says the name that the browser used, where it asks by another one.
std::optional<HttpResponse> Site::refuse_host(const HttpRequest& request, const WebPeer& peer) const {
  const bool is_renamed = peer.vouched && !request.forwarded_host.empty();
  const std::string& host = is_renamed ? request.forwarded_host : request.host;
  if (names_.knows_host(host) || (peer.vouched && !names_.names_hosts())) return std::nullopt;
  const std::string name = showable(name_of_host(host), limits::host_bytes_max);
  return refusal(
      421, Refusal::host_foreign,
      fmt::format(
          "This is a Scree server, and it does not know the name \"{0}\" as its own.\n\n"
          "You may reach it by its address in numbers, such as http://192.0.2.7:4177/, or as localhost from "
          "its own machine.\n\n"
          "If you host it: start it with --web-host {0}, or in a container with the variable "
          "SCREE_WEB_HOST={0}. The server asks for that because anybody can give a name of his own your "
          "server's address, and let his page play on your server by your browser (DNS rebinding).",
          name));
}

/// Whether the path's end is one of this site's own, or the path is a single word, as of a folder.
bool Site::below_another_path(std::string_view path) const {
  const size_t last = path.rfind('/');
  if (last == path.npos) return false;
  if (last == 0) return path.size() > 1 && path.find('.') == path.npos;
  const std::string end(path.substr(last));
  return end == "/session" || files_->find(end) != nullptr;
}

HttpResponse Site::file(const HttpRequest& request) const {
  const WebFile* const found = files_->find(request.path);
  if (found == nullptr && !files_->has_page() &&
      (request.path == "/" || request.path == "/status" || request.path == "/admin"))
    return without_page();
  if (found == nullptr && request.path == "/admin") return without_administration();
  if (found == nullptr)
    return words(404, below_another_path(request.path)
                          ? "there is no such file: a proxy that serves this page under a path has to take "
                            "that path away (docs/host.md)"
                          : "there is no such file");
  const bool gzip = request.accepts_gzip && found->gzip != nullptr;
  HttpResponse response;
  response.is_file = true;
  response.fields = {{"Content-Type", found->type},
                     {"ETag", found->etag},
                     {"Cache-Control", found->immutable ? "public, max-age=31536000, immutable" : "no-cache"},
                     {"Vary", "Accept-Encoding"}};
  if (has_etag(request.if_none_match, found->etag)) {
    response.status = 304;
    return response;
  }
  if (gzip) response.fields.emplace_back("Content-Encoding", "gzip");
  response.body = gzip ? found->gzip : found->bytes;
  return response;
}

}  // namespace scree
