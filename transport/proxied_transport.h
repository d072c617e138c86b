// A stream that a trusted proxy brings. It may begin with a header that names the client (proxy_header.h):
// then the stream's address is the client's, and the bytes begin behind the header. It may also be told the
// address otherwise, as by a request's field.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transport/transport.h"

namespace scree {

class ProxiedTransport final : public Transport, public std::enable_shared_from_this<ProxiedTransport> {
 public:
  /// Called when a header has named the client, before any byte behind it is read.
  using Named = std::function<void(const ProxiedTransport& stream)>;

  /// A header may come.
  ProxiedTransport(std::shared_ptr<Transport> below, Named named);
  /// None comes, and the client has this address.
  ProxiedTransport(std::shared_ptr<Transport> below, std::string address);

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override { below_->write_some(buffers, std::move(done)); }
  size_t write_now(Buffers buffers) override { return below_->write_now(buffers); }
  void send_rest() override { below_->send_rest(); }
  size_t unsent_bytes() override { return below_->unsent_bytes(); }
  void finish_sending() override { below_->finish_sending(); }
  void close() override { below_->close(); }
  void abort() override { below_->abort(); }
  bool established() const override { return below_->established(); }
  bool encrypted() const override { return below_->encrypted(); }
  const std::string& address() const override { return address_ ? *address_ : below_->address(); }
  uint16_t port() const override { return address_ ? port_ : below_->port(); }

 private:
  void sniff(std::span<uint8_t> into, Done done);
  void choose(std::span<uint8_t> into, const Done& done);
  void deliver(std::span<uint8_t> into, const Done& done);

  std::shared_ptr<Transport> below_;
  Named named_;  ///< null: no header comes any more
  std::optional<std::string> address_;
  uint16_t port_ = 0;
  std::vector<uint8_t> first_;    ///< read, and not delivered
  std::optional<StreamEnd> end_;  ///< it came within a header, or before it was known whether one comes
};

}  // namespace scree
