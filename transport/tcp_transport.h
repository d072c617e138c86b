// Plain TCP. Sends without delay (TCP_NODELAY).
#pragma once

#include <asio/ip/tcp.hpp>
#include <memory>

#include "transport/transport.h"

namespace scree {

class TcpTransport final : public Transport, public std::enable_shared_from_this<TcpTransport> {
 public:
  /// The socket is connected.
  explicit TcpTransport(asio::ip::tcp::socket socket);

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override;
  size_t unsent_bytes() override;
  void finish_sending() override;
  void close() override;
  void abort() override;
  bool established() const override { return true; }
  bool encrypted() const override { return false; }
  const std::string& address() const override { return address_; }
  uint16_t port() const override { return port_; }

 private:
  asio::ip::tcp::socket socket_;
  /// The error of the first write that failed. The kernel tells once that a connection is lost; who reads
  /// after it was told to a write sees the end of a stream that ended in order.
  asio::error_code broke_;
  std::string address_ = "unknown";
  uint16_t port_ = 0;
};

}  // namespace scree
