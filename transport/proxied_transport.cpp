#include "transport/proxied_transport.h"

#include <algorithm>

#include "shared/base/check.h"
#include "transport/proxy_header.h"

namespace scree {

namespace {

/// Bytes that are read at once while a header may come.
constexpr size_t sniffed_bytes = 256;

}  // namespace

ProxiedTransport::ProxiedTransport(std::shared_ptr<Transport> below, Named named)
    : below_(std::move(below)), named_(std::move(named)) {
  CHECK(named_ != nullptr);
}

ProxiedTransport::ProxiedTransport(std::shared_ptr<Transport> below, std::string address)
    : below_(std::move(below)), address_(std::move(address)) {}

void ProxiedTransport::read_some(std::span<uint8_t> into, Done done) {
  CHECK(!into.empty());
  if (named_) return sniff(into, std::move(done));
  if (!first_.empty()) return deliver(into, done);
  if (end_) return done(tl::unexpected(*end_));
  below_->read_some(into, std::move(done));
}

void ProxiedTransport::sniff(std::span<uint8_t> into, Done done) {
  const size_t read = first_.size();
  first_.resize(read + sniffed_bytes);
  below_->read_some(std::span(first_).subspan(read),
                    [self = shared_from_this(), into, read, done = std::move(done)](const Moved& moved) {
                      self->first_.resize(read + (moved ? *moved : 0));
                      if (!moved) self->end_ = moved.error();
                      self->choose(into, done);
                    });
}

void ProxiedTransport::choose(std::span<uint8_t> into, const Done& done) {
  auto header = read_proxy_header(first_);
  if (!header) {
    named_ = nullptr;
    first_.clear();
    end_ = StreamEnd{false, header.error().message, true};
    return done(tl::unexpected(*end_));
  }
  if (!*header && !end_) return sniff(into, done);
  const Named named = std::exchange(named_, nullptr);
  if (*header) first_.erase(first_.begin(), first_.begin() + static_cast<std::ptrdiff_t>((*header)->bytes));
  if (*header && !(*header)->address.empty()) {
    address_ = std::move((*header)->address);
    port_ = (*header)->port;
    named(*this);
  }
  read_some(into, done);
}

void ProxiedTransport::deliver(std::span<uint8_t> into, const Done& done) {
  const size_t count = std::min(into.size(), first_.size());
  std::copy_n(first_.begin(), count, into.begin());
  first_.erase(first_.begin(), first_.begin() + static_cast<std::ptrdiff_t>(count));
  done(count);
}

}  // namespace scree
