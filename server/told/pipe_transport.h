// A stream of bytes between an edge and the simulating server over the bus, in the place of a socket: one
// person's connection. What is written is sent at once, in messages that are numbered; a missing one ends the
// stream. All calls are on the network thread, but for write_now() (Transport).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/bus/bus.h"
#include "transport/transport.h"

namespace scree {

/// The messages of one pipe to an edge.
struct PipeAddress {
  std::string edge;
  uint64_t edge_run = 0;
  uint64_t pipe = 0;
};

class PipeTransport final : public Transport {
 public:
  /// `subject`: of messages to the edge.
  PipeTransport(std::shared_ptr<Bus> bus, std::string subject, PipeAddress address, bool encrypted);

  // ---- from the bus
  /// The next message's bytes; false: too many wait.
  [[nodiscard]] bool arrived(std::span<const uint8_t> bytes);
  /// Nothing more comes.
  void ended(StreamEnd end);
  /// The number of the message that is to come next.
  uint64_t next_number() const { return received_; }
  void note_received() { ++received_; }
  bool is_closed() const { return closed_; }

  // ---- Transport
  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override;
  void finish_sending() override;
  void close() override;
  void abort() override { close(); }
  bool established() const override { return true; }
  bool encrypted() const override { return encrypted_; }
  const std::string& address() const override { return name_; }
  uint16_t port() const override { return 0; }

 private:
  void read_on();
  Moved send(Buffers buffers);
  void send_end();

  const std::shared_ptr<Bus> bus_;
  const std::string subject_;
  const PipeAddress address_;
  const std::string name_;
  const bool encrypted_;
  uint64_t received_ = 0, sent_ = 0;  ///< messages
  std::vector<uint8_t> unread_;
  std::optional<StreamEnd> end_;
  std::span<uint8_t> into_;
  Done reading_;  ///< empty: nobody reads
  bool closed_ = false;
  bool end_is_sent_ = false;
};

}  // namespace scree
