#include "server/web/http_connection.h"

#include <algorithm>

#include "server/web/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::string_view end_of_head = "\r\n\r\n";

}  // namespace

HttpConnection::HttpConnection(std::shared_ptr<Transport> stream, uint64_t id, HttpHost& host,
                               const HttpTimes& times, double now_s)
    : stream_(std::move(stream)), id_(id), host_(host), times_(times), now_s_(now_s), since_s_(now_s) {}

void HttpConnection::start(std::span<const uint8_t> arrived) {
  buffer_.assign(arrived.begin(), arrived.end());
  parse_head();
}

void HttpConnection::read() {
  stream_->read_some(incoming_, [self = shared_from_this()](const Moved& moved) {
    if (self->phase_ == Phase::over) return;
    if (moved) return self->read_done(*moved);
    self->close();
  });
}

void HttpConnection::read_done(size_t bytes) {
  if (phase_ == Phase::lingering) return read();
  CHECK(phase_ == Phase::head);
  if (!begun_) since_s_ = now_s_;
  begun_ = true;
  buffer_.append(reinterpret_cast<const char*>(incoming_.data()), bytes);
  parse_head();
}

/// Empty lines before a request are passed over (RFC 9112, 2.2).
void HttpConnection::parse_head() {
  if (searched_ == 0) buffer_.erase(0, buffer_.find_first_not_of("\r\n"));
  const size_t found = buffer_.find(end_of_head, searched_);
  if (found == std::string::npos) {
    searched_ = buffer_.size() - std::min(buffer_.size(), end_of_head.size() - 1);
    if (buffer_.size() < limits::http_head_bytes_max) return read();
  }
  head_bytes_ = found == std::string::npos ? buffer_.size() : found + end_of_head.size();
  if (found == std::string::npos || head_bytes_ > limits::http_head_bytes_max)
    return respond(refusal(431, Refusal::http_too_long, "the head of a request has 8 KiB at most"), false,
                   false);
  const auto request = parse_http_head(std::string_view(buffer_).substr(0, head_bytes_));
  if (!request) return respond(refusal(400, Refusal::http_malformed, request.error().message), false, false);
  respond(host_.answer(*this, *request), request->method == HttpMethod::head, request->keep_alive);
}

void HttpConnection::respond(HttpResponse response, bool head_only, bool keep_alive) {
  phase_ = Phase::answering;
  since_s_ = now_s_;
  response_ = std::move(response);
  head_only_ = head_only || response_.body == nullptr;
  keep_alive_ = keep_alive && !response_.ends;
  response_head_ = head_of(response_, keep_alive_);
  sent_ = 0;
  waits_ = false;
  write();
}

/// Bytes of head and body, from the first on, that may have been sent by now.
size_t HttpConnection::sendable() const {
  const size_t head = response_head_.size();
  const size_t whole = head + (head_only_ ? 0 : response_.body->size());
  if (!response_.is_file) return whole;
  const size_t room = std::min(host_.file_room(*this), limits::http_write_bytes_max);
  return std::min(whole, std::max(sent_, head) + room);
}

void HttpConnection::write() {
  const std::string_view body = head_only_ ? std::string_view() : std::string_view(*response_.body);
  if (sent_ == response_head_.size() + body.size()) return written();
  const size_t end = sendable();
  waits_ = end == sent_;
  if (waits_) return;
  const auto part_of = [&](std::string_view text, size_t before) {
    const size_t from = std::min(text.size(), sent_ - std::min(sent_, before));
    const size_t to = std::min(text.size(), end - std::min(end, before));
    return std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()).subspan(from, to - from);
  };
  const std::array buffers = {part_of(response_head_, 0), part_of(body, response_head_.size())};
  const bool in_body = buffers[0].empty();
  const Transport::Buffers left =
      std::span(buffers).subspan(in_body ? 1 : 0, in_body || buffers[1].empty() ? 1 : 2);
  stream_->write_some(left, [self = shared_from_this()](const Moved& moved) {
    if (self->phase_ == Phase::over) return;
    if (!moved) return self->close();
    self->sent_ += *moved;
    self->since_s_ = self->now_s_;
    self->host_.sent(*self, *moved);
    self->write();
  });
}

void HttpConnection::go_on() {
  if (phase_ != Phase::answering || !waits_) return;
  since_s_ = now_s_;  // it was not the client that was late
  write();
}

void HttpConnection::written() {
  host_.answered(response_, sent_);
  if (response_.is_upgrade()) return open_websocket();
  response_ = {};
  if (!keep_alive_) return linger();
  phase_ = Phase::head;
  since_s_ = now_s_;
  buffer_.erase(0, head_bytes_);
  begun_ = !buffer_.empty();
  searched_ = 0;
  parse_head();
}

void HttpConnection::open_websocket() {
  phase_ = Phase::over;
  const auto bytes = reinterpret_cast<const uint8_t*>(buffer_.data());
  host_.opened_websocket(*this, stream_, std::span(bytes, buffer_.size()).subspan(head_bytes_));
}

/// Closing a socket with unread bytes resets the connection, and the client could lose the answer: so the
/// sending side is closed first, and the socket when the client has closed it, too, or its time is over.
void HttpConnection::linger() {
  phase_ = Phase::lingering;
  since_s_ = now_s_;
  buffer_.clear();
  stream_->finish_sending();
  read();
}

void HttpConnection::close() {
  if (phase_ == Phase::over) return;
  const auto self = shared_from_this();
  phase_ = Phase::over;
  stream_->close();
  host_.ended(*this);
}

void HttpConnection::check_time(double now_s) {
  now_s_ = now_s;
  const double passed_s = now_s - since_s_;
  const bool idle = is_idle();
  if (phase_ == Phase::lingering && passed_s > times_.linger_s) return close();
  if (phase_ == Phase::head && idle && passed_s > times_.idle_s) return close();
  if (phase_ == Phase::head && !idle && passed_s > times_.head_s) {
    host_.disconnect(*this, Refusal::http_late);
    return close();
  }
  if (phase_ == Phase::answering && !waits_ && passed_s > times_.stall_s) {
    host_.disconnect(*this, Refusal::reading_stalled);
    close();
  }
}

}  // namespace scree
