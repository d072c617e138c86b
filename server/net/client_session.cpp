#include "server/net/client_session.h"

#include <array>
#include <asio/buffer.hpp>
#include <chrono>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "proto/codec.h"
#include "server/net/limits.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// Buffers handed to one write.
constexpr size_t gather_max = 16;

std::string peer_of(const asio::ip::tcp::socket& socket) {
  asio::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  if (error) return "unknown peer";
  return endpoint.address().to_string() + ":" + std::to_string(endpoint.port());
}

/// What is not sent yet waits in the outbox, where newer state can still take its place, and not in the
/// kernel. A socket that takes no options still works.
void tune(asio::ip::tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::send_buffer_size(limits::socket_send_buffer_bytes), ignored);
  const int unsent_bytes = limits::socket_unsent_bytes;
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_bytes, sizeof unsent_bytes);
  const auto timeout_ms = static_cast<unsigned>(limits::stall_seconds_max * 1000.0);
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT, &timeout_ms, sizeof timeout_ms);
}

}  // namespace

ClientSession::ClientSession(asio::ip::tcp::socket socket, std::string address, uint64_t id,
                             SessionHost& host, const SessionTimes& times, double now_s)
    : socket_(std::move(socket)),
      id_(id),
      host_(host),
      times_(times),
      peer_(peer_of(socket_)),
      address_(std::move(address)),
      phase_since_s_(now_s),
      progress_s_(now_s),
      now_s_(now_s),
      acted_s_(now_s),
      messages_(limits::messages_per_second_max, limits::messages_burst_max),
      bytes_(limits::client_bytes_per_second_max, limits::client_bytes_burst_max) {
  tune(socket_);
}

void ClientSession::start() {
  read();
}

void ClientSession::read() {
  socket_.async_read_some(asio::buffer(incoming_),
                          [self = shared_from_this()](asio::error_code error, size_t bytes) {
                            if (self->phase_ == Phase::closed) return;
                            if (error)
                              self->read_failed(error == asio::error::eof, error.message());
                            else
                              self->read_done(bytes);
                          });
}

void ClientSession::read_failed(bool orderly, const std::string& why) {
  if (phase_ == Phase::refused) return close("refused before");
  peer_ended_ = true;
  if (orderly && reader_.buffered_bytes() != 0)
    return refuse({Refusal::message_cut_short, "the connection ended in the middle of a message, after " +
                                                   std::to_string(reader_.buffered_bytes()) +
                                                   " bytes of it"});
  close(orderly ? "left" : why);
}

void ClientSession::read_done(size_t bytes) {
  now_s_ = steady_now_s();
  if (phase_ != Phase::refused && !bytes_.take(now_s_, static_cast<double>(bytes)))
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
      if (!message->has_value() || !take_message(**message)) break;
    }
  }
  if (phase_ != Phase::closed) read();
}

/// False when the session was ended by it.
bool ClientSession::take_message(std::span<const uint8_t> body) {
  const auto fail_with = [&](const Refused& refused) {
    refuse(refused);
    return false;
  };
  if (!messages_.take(now_s_))
    return fail_with({Refusal::messages_per_second,
                      "more than " + std::to_string(static_cast<int>(limits::messages_per_second_max)) +
                          " messages a second (limits.messages_per_second_max)"});
  const auto message = decode_client(body);
  if (!message) return fail_with({Refusal::message_malformed, message.error().message});
  if (phase_ == Phase::hello) {
    const auto* hello = std::get_if<HelloMessage>(&*message);
    if (hello == nullptr) return fail_with({Refusal::hello_missing, "the first message must be a hello"});
    const auto welcome = host_.admit(*this, *hello);
    if (!welcome) return fail_with(welcome.error());
    phase_ = Phase::joined;
    phase_since_s_ = acted_s_ = now_s_;
    reader_.set_message_bytes_max(limits::client_message_bytes_max);
    send(ServerMessage(*welcome));
    return true;
  }
  inert_ = false;
  if (!std::holds_alternative<AckMessage>(*message)) acted_s_ = now_s_;
  const auto received = host_.receive(*this, *message);
  if (!received) return fail_with(received.error());
  return phase_ == Phase::joined;
}

void ClientSession::send(const ServerMessage& message) {
  send(std::make_shared<const std::vector<uint8_t>>(encode(message)));
}

void ClientSession::send(SharedBytes bytes) {
  if (phase_ == Phase::refused || phase_ == Phase::closed) return;
  CHECK(bytes != nullptr && bytes->size() >= length_prefix_bytes);
  if (backlog_bytes_ == 0) progress_s_ = steady_now_s();
  backlog_bytes_ += bytes->size();
  outbox_.push_back(std::move(bytes));
  CHECK_DEBUG(backlog_adds_up());
  if (backlog_bytes_ > limits::outbox_hard_bytes)
    return cut_off(Refusal::outbox_full, "read too little: more than " +
                                             std::to_string(limits::outbox_hard_bytes) +
                                             " bytes waited for it (limits.outbox_hard_bytes)");
  write();
}

void ClientSession::write() {
  if (writing_ || outbox_.empty() || phase_ == Phase::closed) return;
  writing_ = true;
  std::vector<asio::const_buffer> buffers;
  size_t skip = front_sent_bytes_;
  for (size_t i = 0; i < outbox_.size() && i < gather_max; ++i) {
    buffers.push_back(asio::buffer(*outbox_[i]) + skip);
    skip = 0;
  }
  socket_.async_write_some(buffers, [self = shared_from_this()](asio::error_code error, size_t bytes) {
    self->writing_ = false;
    if (self->phase_ == Phase::closed) return;
    if (error) return self->close(error.message());
    self->write_done(bytes);
  });
}

void ClientSession::write_done(size_t bytes) {
  progress_s_ = steady_now_s();
  CHECK(bytes <= backlog_bytes_);
  backlog_bytes_ -= bytes;
  size_t sent = front_sent_bytes_ + bytes;
  while (!outbox_.empty() && sent >= outbox_.front()->size()) {
    sent -= outbox_.front()->size();
    outbox_.pop_front();
  }
  front_sent_bytes_ = sent;
  CHECK_DEBUG(backlog_adds_up());
  if (outbox_.empty() && phase_ == Phase::refused) return finish_sending();
  write();
}

void ClientSession::refuse(const Refused& refused) {
  if (phase_ == Phase::refused || phase_ == Phase::closed) return;
  send(ServerMessage(RefusalMessage{refused.message}));
  if (phase_ == Phase::closed) return;
  phase_ = Phase::refused;
  phase_since_s_ = steady_now_s();
  host_.refused(*this, refused);
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
  asio::error_code ignored;
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

void ClientSession::close(const std::string& reason) {
  if (phase_ == Phase::closed) return;
  const auto self = shared_from_this();
  phase_ = Phase::closed;
  asio::error_code ignored;
  socket_.close(ignored);
  outbox_.clear();
  backlog_bytes_ = 0;
  host_.closed(*this, reason);
}

void ClientSession::check_time(double now_s) {
  if (phase_ == Phase::hello && now_s - phase_since_s_ > times_.hello_s)
    return refuse(
        {Refusal::hello_late, "no hello within " + std::to_string(times_.hello_s) + " s of connecting"});
  if (phase_ == Phase::refused && now_s - phase_since_s_ > times_.linger_s) return close("refused before");
  if (backlog_bytes_ != 0 && now_s - progress_s_ > times_.stall_s)
    cut_off(Refusal::reading_stalled, "read nothing for " + std::to_string(times_.stall_s) + " s");
}

void ClientSession::cut_off(Refusal reason, const std::string& words) {
  cut_for_ = reason;
  close(words);
}

bool ClientSession::may_make_room(double now_s) const {
  if (phase_ != Phase::joined) return false;
  return idle_s(now_s) >= (inert_ ? limits::inert_seconds_max : limits::idle_seconds_max);
}

}  // namespace scree
