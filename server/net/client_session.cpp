#include "server/net/client_session.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/codec.h"
#include "server/doors/limits.h"
#include "server/net/limits.h"
#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {

ClientSession::ClientSession(std::shared_ptr<Transport> transport, std::string address, uint64_t id,
                             SessionHost& host, const SessionTimes& times, double now_s)
    : transport_(std::move(transport)),
      id_(id),
      host_(host),
      times_(times),
      peer_(endpoint_text(transport_->address(), transport_->port())),
      address_(std::move(address)),
      origin_(address_),
      phase_since_s_(now_s),
      progress_s_(now_s),
      now_s_(now_s),
      acted_s_(now_s),
      messages_(limits::messages_per_second_max, limits::messages_burst_max),
      bytes_(limits::client_bytes_per_second_max, limits::client_bytes_burst_max) {}

void ClientSession::start() {
  read();
}

void ClientSession::read() {
  transport_->read_some(incoming_, [self = shared_from_this()](const Moved& moved) {
    if (self->phase_ == Phase::closed) return;
    if (moved)
      self->read_done(*moved);
    else
      self->read_failed(moved.error());
  });
}

void ClientSession::read_failed(const StreamEnd& end) {
  if (phase_ == Phase::refused) return close("refused before");
  peer_ended_ = true;
  if (!transport_->established()) {
    disconnect_reason_ = Refusal::tls_failed;
    return close(end.why);
  }
  const std::string has_leftovers = fmt::format(
      "the connection ended in the middle of a message, after {} bytes of it", reader_.buffered_bytes());
  const bool within_message = end.orderly && reader_.buffered_bytes() != 0;
  if (within_message && phase_ == Phase::hello) return refuse({Refusal::message_cut_short, has_leftovers});
  was_lost_ = true;
  if (end.broken) return disconnect(Refusal::stream_malformed, end.why);
  if (within_message) return disconnect(Refusal::message_cut_short, has_leftovers);
  close(end.orderly ? "its end of the connection is closed" : end.why);
}

void ClientSession::read_done(size_t bytes) {
  now_s_ = times_.now_s();
  heard_ = true;
  if (phase_ == Phase::hello && turned_away_) refuse(*turned_away_);
  if (phase_ != Phase::refused && !bytes_.try_spend(now_s_, static_cast<double>(bytes)))
    refuse({Refusal::bytes_per_second,
            fmt::format("more than {} bytes a second (limits.client_bytes_per_second_max)",
                        limits::client_bytes_per_second_max)});
  if (phase_ == Phase::hello || phase_ == Phase::joined) {
    reader_.push(std::span<const uint8_t>(incoming_.data(), bytes));
    while (phase_ == Phase::hello || phase_ == Phase::joined) {
      const auto message = reader_.next();
      if (!message) {
        refuse({Refusal::message_malformed, message.error().message});
        break;
      }
      if (!message->has_value() || !receive_message(**message)) break;
    }
  }
  if (phase_ != Phase::closed) read();
}

/// False when the session was ended by it.
bool ClientSession::receive_message(std::span<const uint8_t> body) {
  const auto fail_with = [&](const Refused& refused) {
    refuse(refused);
    return false;
  };
  if (!messages_.try_spend(now_s_))
    return fail_with({Refusal::messages_per_second,
                      fmt::format("more than {} messages a second (limits.messages_per_second_max)",
                                  limits::messages_per_second_max)});
  host_.count_in(body);
  const auto message = decode_client(body);
  if (!message) return fail_with({Refusal::message_malformed, message.error().message});
  if (phase_ == Phase::hello) return receive_first(*message);
  const bool is_unknown = std::holds_alternative<UnknownMessage>(*message);
  inert_ = inert_ && is_unknown;
  if (!is_unknown && !std::holds_alternative<AckMessage>(*message)) acted_s_ = now_s_;
  const auto received = host_.receive(*this, *message);
  if (!received) return fail_with(received.error());
  return phase_ == Phase::joined;
}

/// False when the session was ended by it.
bool ClientSession::receive_first(const ClientMessage& message) {
  const auto fail_with = [&](const Refused& refused) {
    refuse(refused);
    return false;
  };
  if (std::holds_alternative<AskHealthMessage>(message)) {
    only_asked_ = true;
    end_with(ServerMessage(host_.health()));
    return false;
  }
  const auto* hello = std::get_if<HelloMessage>(&message);
  if (hello == nullptr) return fail_with({Refusal::hello_missing, "the first message must be a hello"});
  const auto welcome = host_.admit(*this, *hello);
  if (!welcome) return fail_with(welcome.error());
  phase_ = Phase::joined;
  phase_since_s_ = acted_s_ = now_s_;
  reader_.set_message_bytes_max(limits::client_message_bytes_max);
  send(ServerMessage(*welcome));
  return true;
}

void ClientSession::send(const ServerMessage& message) {
  send(share(message));
}

void ClientSession::send(SharedBytes bytes) {
  queue(std::move(bytes));
  if (has_acceptable_backlog()) write();
}

void ClientSession::queue(SharedBytes bytes) {
  if (phase_ == Phase::refused || phase_ == Phase::closed) return;
  CHECK(bytes != nullptr && bytes->size() >= length_prefix_bytes);
  if (backlog_bytes_ == 0) progress_s_ = times_.now_s();
  backlog_bytes_ += bytes->size();
  host_.count_out(*bytes);
  outbox_.push_back(std::move(bytes));
  CHECK_DEBUG(backlog_adds_up());
}

bool ClientSession::has_acceptable_backlog() {
  if (phase_ == Phase::closed) return false;
  if (backlog_bytes_ <= limits::outbox_hard_bytes) return true;
  disconnect(Refusal::outbox_full,
             fmt::format("read too little: more than {} bytes waited for it (limits.outbox_hard_bytes)",
                         limits::outbox_hard_bytes));
  return false;
}

ClientSession::Gathered ClientSession::gather() const {
  Gathered gathered;
  const size_t count_max = std::min(outbox_.size(), gathered.buffers.size());
  for (size_t left = pace_.bytes_max(); left > 0 && gathered.count < count_max; ++gathered.count) {
    const auto bytes = std::span<const uint8_t>(*outbox_[gathered.count])
                           .subspan(gathered.count == 0 ? front_sent_bytes_ : 0);
    const auto part = bytes.first(std::min(left, bytes.size()));
    gathered.buffers[gathered.count] = part;
    gathered.bytes += part.size();
    left -= part.size();
  }
  return gathered;
}

void ClientSession::write() {
  if (writing_ || outbox_.empty() || phase_ == Phase::closed) return;
  writing_ = true;
  const Gathered gathered = gather();
  offered_bytes_ = gathered.bytes;
  offered_s_ = times_.now_s();
  transport_->write_some(gathered.all(), [self = shared_from_this()](const Moved& moved) {
    // The connection is over: nothing more is written. What came before its end, a goodbye perhaps, is still
    // read, and then its end.
    if (!moved) return;
    self->writing_ = false;
    if (self->phase_ != Phase::closed) self->write_done(*moved);
  });
}

void ClientSession::write_done(size_t bytes) {
  pace_.took(bytes, offered_bytes_, times_.now_s() - offered_s_);
  count_sent(bytes);
  if (outbox_.empty() && phase_ == Phase::refused) return finish_sending();
  write();
}

void ClientSession::count_sent(size_t bytes) {
  progress_s_ = times_.now_s();
  CHECK(bytes <= backlog_bytes_);
  backlog_bytes_ -= bytes;
  sent_bytes_ += bytes;
  size_t sent = front_sent_bytes_ + bytes;
  while (!outbox_.empty() && sent >= outbox_.front()->size()) {
    sent -= outbox_.front()->size();
    outbox_.pop_front();
  }
  front_sent_bytes_ = sent;
  CHECK_DEBUG(backlog_adds_up());
}

void ClientSession::send_now() {
  if (phase_ != Phase::joined) return;
  while (!writing_ && !outbox_.empty()) {
    const Gathered gathered = gather();
    const size_t taken = transport_->write_now(gathered.all());
    if (taken == 0) return;
    pace_.took(taken, gathered.bytes, 0.0);
    count_sent(taken);
  }
}

void ClientSession::settle() {
  if (!has_acceptable_backlog()) return;
  transport_->send_rest();
  write();
}

void ClientSession::refuse(const Refused& refused) {
  if (phase_ == Phase::refused || phase_ == Phase::closed) return;
  end_with(ServerMessage(RefusalMessage{refused.message, std::string(name_of(refused.reason))}));
  if (phase_ == Phase::closed) return;
  host_.refused(*this, refused);
  if (!transport_->established()) close("refused before");  // nobody could read it
}

/// The last message; what comes after it is not looked at.
void ClientSession::end_with(const ServerMessage& last) {
  send(last);
  if (phase_ == Phase::closed) return;
  phase_ = Phase::refused;
  phase_since_s_ = times_.now_s();
}

bool ClientSession::backlog_adds_up() const {
  size_t sum = 0;
  for (const SharedBytes& bytes : outbox_) sum += bytes->size();
  return sum == backlog_bytes_ + front_sent_bytes_;
}

/// Closing a socket with unread bytes resets the connection, and the client could lose the refusal: so the
/// sending side is closed first, and the socket when the client has closed it, too, or its time is over.
void ClientSession::finish_sending() {
  if (peer_ended_) return close("refused before");
  transport_->finish_sending();
}

void ClientSession::close(const std::string& reason) {
  if (phase_ == Phase::closed) return;
  const auto self = shared_from_this();
  may_go_on_ = phase_ == Phase::joined && !left_;
  phase_ = Phase::closed;
  transport_->close();
  outbox_.clear();
  backlog_bytes_ = 0;
  host_.closed(*this, reason);
}

void ClientSession::give_up_connection() {
  CHECK(phase_ == Phase::hello && outbox_.empty());
  phase_ = Phase::closed;
}

void ClientSession::leave() {
  left_ = true;
  close("left");
}

void ClientSession::check_time(double now_s) {
  if (phase_ == Phase::hello && turned_away_ && now_s - phase_since_s_ > limits::turned_away_seconds_max)
    return refuse(*turned_away_);
  if (phase_ == Phase::hello && now_s - phase_since_s_ > times_.hello_s)
    return refuse({Refusal::hello_late, fmt::format("no hello within {} s of connecting", times_.hello_s)});
  if (phase_ == Phase::refused && now_s - phase_since_s_ > times_.linger_s) return close("refused before");
  if (backlog_bytes_ != 0 && now_s - progress_s_ > times_.stall_s)
    disconnect(Refusal::reading_stalled, fmt::format("read nothing for {} s", times_.stall_s));
}

void ClientSession::disconnect(Refusal reason, const std::string& words) {
  disconnect_reason_ = reason;
  close(words);
}

bool ClientSession::may_make_room(double now_s) const {
  if (phase_ != Phase::joined) return false;
  return idle_s(now_s) >= (inert_ ? limits::inert_seconds_max : limits::idle_seconds_max);
}

}  // namespace scree
