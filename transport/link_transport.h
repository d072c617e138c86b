// One end of a stream, as if its bytes came and went by a link of some delay, rate and fate: for tests, and
// for programs that are to meet such a link on one machine.
//
// Nothing is read from the stream below while the bottleneck is full, so that its other end sees the
// back-pressure of a real link. What is on its way when this end closes is lost.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "transport/link_clock.h"
#include "transport/link_pipe.h"
#include "transport/transport.h"

namespace scree {

class LinkTransport final : public Transport, public std::enable_shared_from_this<LinkTransport> {
 public:
  /// The clock is this link's alone.
  LinkTransport(std::shared_ptr<Transport> below, const LinkConfig& link, std::unique_ptr<LinkClock> clock);

  void read_some(std::span<uint8_t> into, Done done) override;
  void write_some(Buffers buffers, Done done) override;
  void finish_sending() override;
  void close() override;
  void abort() override;
  bool established() const override { return below_->established(); }
  bool encrypted() const override { return below_->encrypted(); }
  const std::string& address() const override { return below_->address(); }
  uint16_t port() const override { return below_->port(); }

 private:
  void go_on();
  bool do_some(double now_s);
  bool pull_from_writer(double now_s);
  bool send_below(double now_s);
  void sending_failed(const Moved& moved);
  bool receive_from_below(double now_s);
  bool give_to_reader(double now_s);
  bool break_if_severed();
  void fail_waiting();
  void wake_later(double now_s);
  void drop();

  std::shared_ptr<Transport> below_;
  std::unique_ptr<LinkClock> clock_;
  LinkPipe up_;
  LinkPipe down_;
  bool working_ = false;  ///< within go_on()
  bool again_ = false;    ///< go_on() was called within itself
  bool closed_ = false;

  std::vector<std::span<const uint8_t>> outgoing_;  ///< the writer's
  Done write_done_;                                 ///< null: nobody writes
  std::array<uint8_t, 4096> sent_{};                ///< came out of up_; from sent_from_ on it waits
  size_t sent_from_ = 0, sent_to_ = 0;
  bool sending_ = false;
  bool finishing_ = false;
  bool finished_ = false;

  std::span<uint8_t> into_;
  Done read_done_;  ///< null: nobody reads
  std::array<uint8_t, 4096> incoming_{};
  bool receiving_ = false;
  std::optional<StreamEnd> end_;     ///< of the stream below; told when all before it has come
  std::optional<StreamEnd> broken_;  ///< the link was cut: told to all who read and write
};

}  // namespace scree
