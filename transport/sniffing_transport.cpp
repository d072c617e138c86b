#include "transport/sniffing_transport.h"

#include <algorithm>

#include "shared/base/check.h"
#include "transport/tls_transport.h"

namespace scree {

SniffingTransport::SniffingTransport(std::shared_ptr<Transport> below,
                                     std::shared_ptr<const TlsServerContext> tls)
    : chosen_(std::move(below)), tls_(std::move(tls)) {
  CHECK(tls_ != nullptr);
}

void SniffingTransport::read_some(std::span<uint8_t> into, Done done) {
  CHECK(into.size() >= tls_greeting_bytes);
  if (decided_ && first_bytes_ == 0) return chosen_->read_some(into, std::move(done));
  sniff(into, std::move(done));
}

void SniffingTransport::sniff(std::span<uint8_t> into, Done done) {
  chosen_->read_some(std::span(first_).subspan(first_bytes_),
                     [self = shared_from_this(), into, done = std::move(done)](const Moved& moved) {
                       if (!moved) return done(moved);
                       self->first_bytes_ += *moved;
                       self->choose(into, done);
                     });
}

void SniffingTransport::choose(std::span<uint8_t> into, Done done) {
  if (!decided_ && first_bytes_ < tls_greeting_bytes) return sniff(into, std::move(done));
  const std::span<const uint8_t> first = std::span(first_).first(first_bytes_);
  first_bytes_ = 0;
  if (!decided_ && is_tls_greeting(first)) {
    decided_ = true;
    chosen_ = std::make_shared<TlsTransport>(std::move(chosen_), TlsEngine(std::move(tls_)), first);
    return chosen_->read_some(into, std::move(done));
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
