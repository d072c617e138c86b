#include "server/told/pipe_transport.h"

#include <algorithm>
#include <utility>

#include "server/formats/bus_codec.h"
#include "server/told/limits.h"

namespace scree {

PipeTransport::PipeTransport(std::shared_ptr<Bus> bus, std::string subject, PipeAddress address,
                             bool encrypted)
    : bus_(std::move(bus)),
      subject_(std::move(subject)),
      address_(std::move(address)),
      name_("edge " + address_.edge),
      encrypted_(encrypted) {}

bool PipeTransport::arrived(std::span<const uint8_t> bytes) {
  if (closed_ || end_) return true;
  if (unread_.size() + bytes.size() > limits::pipe_unread_bytes_max) return false;
  unread_.insert(unread_.end(), bytes.begin(), bytes.end());
  read_on();
  return true;
}

void PipeTransport::ended(StreamEnd end) {
  if (closed_ || end_) return;
  end_ = std::move(end);
  read_on();
}

void PipeTransport::read_on() {
  if (!reading_ || closed_ || (unread_.empty() && !end_)) return;
  const Done done = std::exchange(reading_, nullptr);
  if (unread_.empty()) return done(tl::unexpected(*end_));
  const size_t count = std::min(into_.size(), unread_.size());
  std::copy_n(unread_.begin(), count, into_.begin());
  unread_.erase(unread_.begin(), unread_.begin() + static_cast<std::ptrdiff_t>(count));
  done(count);
}

void PipeTransport::read_some(std::span<uint8_t> into, Done done) {
  into_ = into;
  reading_ = std::move(done);
  read_on();
}

Moved PipeTransport::send(Buffers buffers) {
  if (closed_ || end_is_sent_) return tl::unexpected(StreamEnd{false, "the pipe is closed", false});
  PipeMessage message{address_.edge_run, address_.pipe, sent_, {}, false};
  for (const auto& buffer : buffers) {
    const size_t room = limits::pipe_bytes_max - message.bytes.size();
    const auto part = buffer.first(std::min(room, buffer.size()));
    message.bytes.insert(message.bytes.end(), part.begin(), part.end());
    if (part.size() < buffer.size()) break;
  }
  if (const auto sent = bus_->send(subject_, encode(message)); !sent)
    return tl::unexpected(StreamEnd{false, sent.error().message, false});
  ++sent_;
  return message.bytes.size();
}

void PipeTransport::write_some(Buffers buffers, Done done) {
  done(send(buffers));
}

size_t PipeTransport::write_now(Buffers buffers) {
  return send(buffers).value_or(0);
}

void PipeTransport::send_end() {
  if (std::exchange(end_is_sent_, true)) return;
  static_cast<void>(
      bus_->send(subject_, encode(PipeMessage{address_.edge_run, address_.pipe, sent_, {}, true})));
}

void PipeTransport::finish_sending() {
  send_end();
}

void PipeTransport::close() {
  send_end();
  closed_ = true;
  unread_.clear();
  reading_ = nullptr;
}

}  // namespace scree
