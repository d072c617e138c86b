// A stream over a connected socket of the system, of whatever family.
#pragma once

#include <asio/generic/stream_protocol.hpp>
#include <memory>
#include <string>

#include "transport/transport.h"

namespace scree {

/// The other side.
struct SocketPeer {
  std::string address = "unknown";
  uint16_t port = 0;
};

class SocketTransport : public Transport, public std::enable_shared_from_this<SocketTransport> {
 public:
  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override;
  size_t unsent_bytes() override;
  void finish_sending() override;
  void close() override;
  void abort() override;
  bool established() const override { return true; }
  bool encrypted() const override { return false; }
  const std::string& address() const override { return peer_.address; }
  uint16_t port() const override { return peer_.port; }

 protected:
  using Socket = asio::generic::stream_protocol::socket;

  /// The socket is connected.
  SocketTransport(Socket socket, SocketPeer peer) : socket_(std::move(socket)), peer_(std::move(peer)) {}

 private:
  Socket socket_;
  /// The error of the first write that failed. The kernel tells once that a connection is lost; who reads
  /// after it was told to a write sees the end of a stream that ended in order.
  asio::error_code broke_;
  SocketPeer peer_;
};

}  // namespace scree
