#include "transport/sniffing_transport.h"

#include <algorithm>

#include "shared/base/check.h"
#include "transport/tls_transport.h"

namespace scree {

static_assert(http_greeting_bytes <= tls_greeting_bytes);

bool is_http_greeting(std::span<const uint8_t> first) {
  CHECK(first.size() >= http_greeting_bytes);
  return std::ranges::all_of(first.first(http_greeting_bytes),
                             [](uint8_t byte) { return byte >= 'A' && byte <= 'Z'; });
}

SniffingTransport::SniffingTransport(std::shared_ptr<Transport> below,
                                     std::shared_ptr<const TlsServerContext> tls, HttpHandoff http)
    : chosen_(std::move(below)), tls_(std::move(tls)), http_(std::move(http)) {}

void SniffingTransport::read_some(std::span<uint8_t> into, Done done) {
  CHECK(into.size() >= tls_greeting_bytes && !given_);
  if (end_) return done(tl::unexpected(*end_));
  if (decided_ && first_bytes_ == 0) return chosen_->read_some(into, std::move(done));
  sniff(into, std::move(done));
}

void SniffingTransport::sniff(std::span<uint8_t> into, Done done) {
  chosen_->read_some(std::span(first_).subspan(first_bytes_),
                     [self = shared_from_this(), into, done = std::move(done)](const Moved& moved) {
                       if (!moved && self->first_bytes_ == 0) return done(moved);
                       if (moved)
                         self->first_bytes_ += *moved;
                       else
                         self->end_ = moved.error();
                       self->choose(into, done);
                     });
}

void SniffingTransport::choose(std::span<uint8_t> into, Done done) {
  decided_ = decided_ || end_;
  if (!decided_ && first_bytes_ < tls_greeting_bytes) return sniff(into, std::move(done));
  const std::span<const uint8_t> first = std::span(first_).first(first_bytes_);
  first_bytes_ = 0;
  if (!decided_ && tls_ && is_tls_greeting(first)) {
    chosen_ = std::make_shared<TlsTransport>(std::move(chosen_), TlsEngine(std::move(tls_)), first);
    decided_ = http_ == nullptr;
    return read_some(into, std::move(done));
  }
  if (!decided_ && http_ && is_http_greeting(first)) {
    decided_ = given_ = true;
    return std::exchange(http_, nullptr)(chosen_, first);
  }
  decided_ = true;
  std::ranges::copy(first, into.begin());
  done(first.size());
}

void SniffingTransport::write_some(Buffers buffers, Done done) {
  decided_ = true;
  chosen_->write_some(buffers, std::move(done));
}

}  // namespace scree
