// A stream over another one, through an engine: TLS, WebSocket. A handshake, if there is one, begins with the
// first read or write; both wait for it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "shared/base/stream_engine.h"
#include "transport/limits.h"
#include "transport/transport.h"

namespace scree {

class LayeredTransport : public Transport, public std::enable_shared_from_this<LayeredTransport> {
 public:
  /// `arrived`: bytes that were read from `below` already.
  LayeredTransport(std::shared_ptr<Transport> below, std::unique_ptr<StreamEngine> engine,
                   std::span<const uint8_t> arrived = {});

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  size_t write_now(Buffers buffers) override;
  void send_rest() override;
  size_t unsent_bytes() override {
    return below_->unsent_bytes() + plain_.size() + unsent_.size() - unsent_from_;
  }
  void finish_sending() override;
  void close() override;
  void abort() override;
  bool established() const override { return engine_->established(); }
  bool encrypted() const override { return below_->encrypted(); }
  const std::string& address() const override { return below_->address(); }
  uint16_t port() const override { return below_->port(); }

 private:
  void stage(Buffers buffers);
  void go_on();
  void pass_on();
  void send();
  void sent(const Moved& moved);
  void receive();
  void received(const Moved& moved);
  void deliver();
  void break_off(const Error& error);
  void fail_waiting();
  void drop();

  std::shared_ptr<Transport> below_;
  std::unique_ptr<StreamEngine> engine_;
  std::optional<StreamEnd> end_;  ///< nothing more arrives, for this reason
  bool broken_ = false;           ///< by an error of the engine
  bool closed_ = false;

  std::span<uint8_t> into_;
  Done read_done_;  ///< null: nobody reads
  std::array<uint8_t, limits::layer_read_bytes> incoming_{};
  bool receiving_ = false;

  std::vector<uint8_t> plain_;  ///< taken from the writer, not through the engine yet
  size_t staged_bytes_ = 0;
  Done write_done_;              ///< null: nobody writes
  std::vector<uint8_t> unsent_;  ///< from the engine, handed to `below_` from unsent_from_ on
  size_t unsent_from_ = 0;
  bool sending_ = false;
  bool finishing_ = false;
};

}  // namespace scree
