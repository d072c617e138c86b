#include "transport/link_transport.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "shared/base/check.h"

namespace scree {

LinkTransport::LinkTransport(std::shared_ptr<Transport> below, const LinkConfig& link,
                             std::unique_ptr<LinkClock> clock)
    : below_(std::move(below)),
      clock_(std::move(clock)),
      up_(link.up, link.random_seed),
      down_(link.down, ~link.random_seed) {}

void LinkTransport::read_some(std::span<uint8_t> into, Done done) {
  CHECK(!read_done_ && !into.empty());
  into_ = into;
  read_done_ = std::move(done);
  go_on();
}

void LinkTransport::write_some(Buffers buffers, Done done) {
  CHECK(!write_done_ && !finishing_);
  outgoing_.assign(buffers.begin(), buffers.end());
  write_done_ = std::move(done);
  go_on();
}

void LinkTransport::finish_sending() {
  finishing_ = true;
  go_on();
}

/// Does all that can be done now. Handlers called from here may call this end again, and may close it.
void LinkTransport::go_on() {
  again_ = true;
  if (working_) return;
  const auto self = shared_from_this();
  working_ = true;
  const double now_s = clock_->now_s();
  while (again_ && !closed_) {
    again_ = false;
    if (break_if_severed())
      fail_waiting();
    else if (do_some(now_s))
      again_ = true;
  }
  working_ = false;
  if (!closed_ && !broken_) wake_later(now_s);
}

bool LinkTransport::do_some(double now_s) {
  return pull_from_writer(now_s) || (!closed_ && send_below(now_s)) ||
         (!closed_ && receive_from_below(now_s)) || (!closed_ && give_to_reader(now_s));
}

bool LinkTransport::pull_from_writer(double now_s) {
  if (!write_done_) return false;
  size_t taken = 0;
  for (const std::span<const uint8_t> bytes : outgoing_) {
    const size_t count = std::min(bytes.size(), up_.room(now_s));
    up_.push(bytes.first(count), now_s);
    taken += count;
    if (count < bytes.size()) break;
  }
  if (taken == 0) return false;
  std::exchange(write_done_, nullptr)(taken);
  return true;
}

bool LinkTransport::send_below(double now_s) {
  if (sending_ || finished_) return false;
  if (sent_from_ == sent_to_) {
    sent_from_ = 0;
    sent_to_ = up_.pop(sent_, now_s);
  }
  if (sent_from_ == sent_to_) {
    if (!finishing_ || !up_.empty()) return false;
    finished_ = true;
    below_->finish_sending();
    return true;
  }
  sending_ = true;
  const auto rest = std::span<const uint8_t>(sent_).first(sent_to_).subspan(sent_from_);
  below_->write_some({&rest, 1}, [self = shared_from_this()](const Moved& moved) {
    self->sending_ = false;
    if (self->closed_ || self->broken_) return;
    if (!moved) return self->sending_failed(moved);
    self->sent_from_ += *moved;
    self->go_on();
  });
  return true;
}

/// Who writes is told now or next time; who reads, by the stream below.
void LinkTransport::sending_failed(const Moved& moved) {
  sent_from_ = sent_to_ = 0;
  finished_ = true;
  if (write_done_) std::exchange(write_done_, nullptr)(moved);
  if (!closed_) go_on();
}

bool LinkTransport::receive_from_below(double now_s) {
  const size_t room = std::min(incoming_.size(), down_.room(now_s));
  if (receiving_ || end_ || room == 0) return false;
  receiving_ = true;
  below_->read_some(std::span(incoming_).first(room), [self = shared_from_this()](const Moved& moved) {
    self->receiving_ = false;
    if (self->closed_ || self->broken_) return;
    if (moved)
      self->down_.push(std::span<const uint8_t>(self->incoming_).first(*moved), self->clock_->now_s());
    else
      self->end_ = moved.error();
    self->go_on();
  });
  return true;
}

bool LinkTransport::give_to_reader(double now_s) {
  if (!read_done_) return false;
  if (const size_t count = down_.pop(into_, now_s); count > 0) {
    std::exchange(read_done_, nullptr)(count);
    return true;
  }
  if (!end_ || !down_.empty()) return false;
  std::exchange(read_done_, nullptr)(tl::unexpected(*end_));
  return true;
}

/// The cut is seen at both ends at once: here by an error, there by the connection's.
bool LinkTransport::break_if_severed() {
  const bool up = up_.severed() && !sending_ && sent_from_ == sent_to_;
  if (broken_ || (!up && !down_.severed())) return broken_.has_value();
  broken_ =
      StreamEnd{false, fmt::format("the simulated link was cut after {} bytes {}",
                                   up ? up_.popped_bytes() : down_.popped_bytes(), (up ? "up" : "down"))};
  clock_->cancel();
  below_->abort();
  return true;
}

void LinkTransport::fail_waiting() {
  if (const Done read = std::exchange(read_done_, nullptr)) read(tl::unexpected(*broken_));
  if (closed_) return;
  if (const Done write = std::exchange(write_done_, nullptr)) write(tl::unexpected(*broken_));
}

void LinkTransport::wake_later(double now_s) {
  std::optional<double> next = down_.next_s(now_s);
  if (const auto up = up_.next_s(now_s); up && (!next || *up < *next)) next = up;
  if (!next) return clock_->cancel();
  clock_->wake_at(std::max(*next, now_s), [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->go_on();
  });
}

void LinkTransport::drop() {
  closed_ = true;
  clock_->cancel();
  read_done_ = nullptr;
  write_done_ = nullptr;
}

void LinkTransport::close() {
  const auto self = shared_from_this();
  drop();
  below_->close();
}

void LinkTransport::abort() {
  const auto self = shared_from_this();
  drop();
  below_->abort();
}

}  // namespace scree
