// A server's end of a stream whose client chooses between plain bytes and TLS: its first bytes tell. Whoever
// is written to before its first bytes came is written to plainly, and stays so.
#pragma once

#include <array>
#include <memory>

#include "crypto/tls_engine.h"
#include "transport/transport.h"

namespace scree {

class SniffingTransport final : public Transport, public std::enable_shared_from_this<SniffingTransport> {
 public:
  SniffingTransport(std::shared_ptr<Transport> below, std::shared_ptr<const TlsServerContext> tls);

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override { return decided_ ? chosen_->write_now(buffers) : 0; }
  void send_rest() override { chosen_->send_rest(); }
  size_t unsent_bytes() override { return chosen_->unsent_bytes(); }
  void finish_sending() override { chosen_->finish_sending(); }
  void close() override { chosen_->close(); }
  void cut() override { chosen_->cut(); }
  bool established() const override { return chosen_->established(); }
  bool encrypted() const override { return chosen_->encrypted(); }
  const std::string& address() const override { return chosen_->address(); }
  uint16_t port() const override { return chosen_->port(); }

 private:
  void sniff(std::span<uint8_t> into, Done done);
  void choose(std::span<uint8_t> into, Done done);

  std::shared_ptr<Transport> chosen_;  ///< the one below, until TLS is put over it
  std::shared_ptr<const TlsServerContext> tls_;
  std::array<uint8_t, tls_greeting_bytes> first_{};
  size_t first_bytes_ = 0;
  bool decided_ = false;
};

}  // namespace scree
