// The connections that speak HTTP: the page, status.json, /metrics, and the way from a request to a
// WebSocket. On the network thread.
//
// Connections have numbers as sessions do. Each holds a place at the door, which it gives back when it ends;
// a WebSocket takes number and place with it. A trusted proxy's connection may carry the requests of many
// persons: each request is of the address that it names, and a WebSocket's place at the door is that one's.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/doors/authorizer.h"
#include "server/doors/door.h"
#include "server/net/host_log.h"
#include "server/net/net_server.h"
#include "server/net/outsider.h"
#include "server/net/visitor.h"
#include "server/web/http_connection.h"
#include "server/web/site.h"

namespace scree {

/// The owner of the HTTP connections.
class WebHost {
 public:
  virtual ~WebHost() = default;
  /// A request has opened a WebSocket: the stream is the host's.
  virtual void begin_websocket(std::shared_ptr<Transport> stream, const Visitor& from, uint64_t id) = 0;
  /// What status.json shows, as of now.
  virtual NetFigures status_figures() = 0;
  virtual HealthMessage health() = 0;
  /// Connections or counts have changed.
  virtual void web_changed() = 0;
};

class WebConnections final : public HttpHost {
 public:
  /// All arguments must outlive this object. `counts`: requests and refusals are counted there.
  WebConnections(const NetConfig& config, Authorizer& authorizer, Door& door, BytesOut& bytes_out,
                 NetStats& counts, HostLog& log, WebHost& host)
      : config_(config),
        authorizer_(authorizer),
        door_(door),
        bytes_out_(bytes_out),
        counts_(counts),
        log_(log),
        host_(host) {}

  /// Reads the page's files, if HTTP is spoken at all.
  Result<void> open();
  bool speaks_http() const { return site_ != nullptr; }
  void set_files(std::shared_ptr<const WebFiles> files);

  /// A connection has spoken HTTP. `arrived`: what was read of it already.
  void begin(uint64_t id, const Visitor& from, std::shared_ptr<Transport> stream,
             std::span<const uint8_t> arrived);
  /// Ends what took too long. Call a few times a second.
  void check_time(double now_s);
  /// Lists those that are charged for what they are sent.
  void list_receivers(std::vector<BytesOut::Receiver>& receivers);
  /// Goes on with files that waited for room in a budget.
  void go_on();
  /// Closes all connections; requests of later ones are refused.
  void stop();

  size_t size() const { return connections_.size(); }
  /// Those that the door turned away.
  size_t turned_away() const;
  /// Adds all of them to a list. A browser whose connection waits without a request opens another one when it
  /// needs to.
  void list_outsiders(std::vector<Outsider>& outsiders) const;
  /// Closes this connection, which must be there; unless it is idle it counts as cut off. False: there is
  /// none of that number.
  bool make_room(uint64_t id);

 private:
  struct Entry {
    std::shared_ptr<HttpConnection> connection;
    Visitor from;
    /// The client's IP address, of the request that opens a WebSocket; empty: the connection's own.
    std::string client_ip{};
    /// Charged for the answers; nothing before the first one.
    std::optional<std::string> charged{};

    ByteAccount bytes_out{};

    BytesOut::Receiver receiver() { return {*charged, &bytes_out}; }
  };
  using Connections = std::map<uint64_t, Entry>;
  /// Who asks, by a trusted proxy's word.
  struct Asker {
    std::string ip;
    std::string address;  ///< as of Door: whose limits hold
    WebPeer peer{};
    bool is_many = false;  ///< a trusted proxy that names nobody
  };

  HttpResponse answer(const HttpConnection& from, const HttpRequest& request) override;
  size_t file_room(const HttpConnection& connection) const override;
  void sent(const HttpConnection& connection, size_t bytes) override;
  void answered(const HttpResponse& response, size_t bytes) override;
  void opened_websocket(HttpConnection& from, std::shared_ptr<Transport> stream,
                        std::span<const uint8_t> arrived) override;
  void disconnect(const HttpConnection& connection, Refusal reason) override;
  void ended(HttpConnection& connection) override;
  std::optional<HttpResponse> treat_as_stranger(Entry& entry, const HttpRequest& request);
  void note_proxy_here();
  Asker asker_of(const HttpConnection& from, const HttpRequest& request) const;
  void charge_to(Entry& entry, const Asker& asker);
  void end_charges(Entry& entry);
  HttpResponse answer_site(Entry& entry, const Asker& asker, const HttpRequest& request);
  HttpResponse answer_health(const HttpRequest& request);
  HttpResponse status_json(const Asker& asker, const HttpRequest& request);
  HttpResponse metrics(const HttpConnection& from, const Asker& asker, const HttpRequest& request);
  tl::expected<void, Refused> may_see_status(const Asker& asker, const HttpRequest& request);
  tl::expected<void, Refused> may_see_metrics(const HttpConnection& from, const Asker& asker,
                                              const HttpRequest& request);
  tl::expected<void, Refused> check_administrator(const Asker& asker, const HttpRequest& request);

  const NetConfig& config_;
  Authorizer& authorizer_;
  Door& door_;
  BytesOut& bytes_out_;
  NetStats& counts_;
  HostLog& log_;
  WebHost& host_;
  std::unique_ptr<Site> site_;  ///< null: HTTP is not spoken
  Connections connections_;
  bool stopping_ = false;
  bool has_proxy_here_ = false;  ///< one that nobody has named, and that pages have come by
};

}  // namespace scree
