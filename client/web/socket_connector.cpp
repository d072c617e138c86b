#include "client/web/socket_connector.h"

#include <cmath>
#include <utility>

#include "client/connection/limits.h"
#include "proto/codec.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

using Clock = std::chrono::steady_clock;

/// The channel of a socket whose welcome has come.
class SocketChannel final : public ServerChannel {
 public:
  explicit SocketChannel(PageSocket& socket) : socket_(socket), welcome_(*socket.intake().welcome()) {}
  ~SocketChannel() override {
    if (!over_) socket_.close({{"closed here"}, {}});
  }

  const WelcomeMessage& welcome() const override { return welcome_; }
  std::vector<Received> poll() override;
  void await(std::chrono::milliseconds /*within*/) override {}
  void send(const ClientMessage& message) override { socket_.send(message); }
  bool connected() const override { return !socket_.is_closed(); }
  ConnectionEnd end() const override { return socket_.end(); }
  ConnectionCounters counters() const override { return socket_.counters(); }
  void leave() override {
    socket_.send(GoodbyeMessage{});
    over_ = true;  // the page closes the socket with itself, once this is sent
  }

 private:
  PageSocket& socket_;
  WelcomeMessage welcome_;
  bool over_ = false;
};

std::vector<Received> SocketChannel::poll() {
  std::vector<Received> taken;
  const double begun_s = steady_now_s();
  while (steady_now_s() - begun_s < limits::page_decode_s) {
    std::optional<Received> next = socket_.next();
    if (!next) break;
    taken.push_back(std::move(*next));
  }
  socket_.check_silence(Clock::now());
  return taken;
}

}  // namespace

PageSocket::Wish PageSocket::pop_wish() {
  if (std::exchange(must_close_, false)) return Wish::close;
  if (state_ != State::wanted) return Wish::nothing;
  state_ = State::opening;
  return Wish::open;
}

void PageSocket::opened() {
  if (state_ == State::opening) state_ = State::open;
}

void PageSocket::closed(const std::string& why) {
  if (state_ != State::opening && state_ != State::open) return;
  const bool was_open = state_ == State::open;
  state_ = State::closed;
  must_close_ = false;
  if (!why.empty()) {
    end_ = {{why}, {}};
  } else {
    end_ = {{was_open ? "the server closed the connection" : "cannot connect; is the server running?"}, {}};
  }
}

void PageSocket::received(std::span<const uint8_t> bytes) {
  if (state_ != State::open || bytes.empty()) return;
  heard_ = Clock::now();
  counters_.received_bytes += bytes.size();
  unread_bytes_ += bytes.size();
  if (unread_bytes_ > limits::page_unread_bytes_max)
    return close({{"this page is too slow: " + std::to_string(unread_bytes_ >> 20U) +
                   " MiB wait to be read (limits.page_unread_bytes_max)"},
                  {}});
  arrived_.push_back({{bytes.begin(), bytes.end()}, heard_});
}

std::vector<uint8_t> PageSocket::drain_outgoing() {
  if (state_ != State::open) return {};
  return std::exchange(outgoing_, {});
}

void PageSocket::open(const std::vector<ClientMessage>& first) {
  CHECK(is_closed());
  const bool must_close = must_close_;
  *this = {};
  must_close_ = must_close;
  state_ = State::wanted;
  for (const ClientMessage& message : first) send(message);
}

void PageSocket::close(const ConnectionEnd& end) {
  if (is_closed()) return;
  must_close_ = state_ != State::wanted;
  state_ = State::closed;
  end_ = end;
}

void PageSocket::send(const ClientMessage& message) {
  if (is_closed()) return;
  const std::vector<uint8_t> bytes = encode(message);
  counters_.sent_bytes += bytes.size();
  ++counters_.sent_messages;
  if (outgoing_.size() + bytes.size() > limits::unsent_bytes_max)
    return close({{"data cannot be sent: " + std::to_string(outgoing_.size()) +
                   " bytes wait (limits.unsent_bytes_max)"},
                  {}});
  outgoing_.insert(outgoing_.end(), bytes.begin(), bytes.end());
}

std::optional<Received> PageSocket::next() {
  while (true) {
    auto next = intake_.next();
    if (!next) {
      arrived_.clear();
      unread_bytes_ = 0;
      close(next.error());
      end_ = next.error();  // what the server said last tells more than that it then closed
      return std::nullopt;
    }
    if (*next) {
      if (intake_.welcome()) ++counters_.received_messages;
      return Received{std::move((*next)->message), (*next)->bytes, pushed_at_};
    }
    if (arrived_.empty()) return std::nullopt;
    intake_.push(arrived_.front().bytes);
    pushed_at_ = arrived_.front().at;
    unread_bytes_ -= arrived_.front().bytes.size();
    arrived_.pop_front();
  }
}

ConnectionCounters PageSocket::counters() const {
  ConnectionCounters counters = counters_;
  counters.messages_unknown = intake_.unknown();
  counters.waiting_messages = arrived_.size();
  counters.waiting_bytes = unread_bytes_;
  return counters;
}

void PageSocket::check_silence(Clock::time_point now) {
  if (state_ != State::open || !intake_.sends_frames() || !arrived_.empty()) return;
  const double silent_s = std::chrono::duration<double>(now - heard_).count();
  if (silent_s > limits::silent_seconds_max)
    close({{"the connection was lost: the server has been silent for " +
            std::to_string(std::lround(silent_s)) + " s"},
           {}});
}

void SocketConnector::begin(Rejoin& rejoin, const HelloMessage& hello, double now_s) {
  CHECK(!busy_);
  Rejoin::Opening opening = rejoin.open(where_, hello);
  opening.hello.token = token_;
  std::vector<ClientMessage> first{std::move(opening.hello)};
  first.insert(first.end(), opening.then.begin(), opening.then.end());
  socket_.open(first);
  busy_ = true;
  until_s_ = now_s + patience_s_;
}

std::optional<Connector::Attempt> SocketConnector::poll(double now_s) {
  if (!busy_) return std::nullopt;
  const std::optional<Received> first = socket_.next();  // only a welcome can be
  if (!first && !socket_.is_closed() && now_s > until_s_)
    socket_.close({{"no answer within " + std::to_string(std::lround(patience_s_)) + " s"}, {}});
  if (!first && !socket_.is_closed()) return std::nullopt;
  busy_ = false;
  Attempt attempt;
  if (first) {
    attempt.channel = std::make_unique<SocketChannel>(socket_);
  } else {
    attempt.end = {{where_ + ": " + socket_.end().message}, socket_.end().refusal};
  }
  return attempt;
}

}  // namespace scree
