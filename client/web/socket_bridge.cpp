#include "client/web/socket_bridge.h"

#include <algorithm>
#include <vector>

#include "client/web/bridge.h"
#include "client/web/limits.h"

namespace scree {
namespace {

/// Bytes that the page writes, and reads.
struct Buffers {
  std::vector<uint8_t> incoming, outgoing;
};

Buffers& buffers() {
  static Buffers only;
  return only;
}

}  // namespace

PageSocket& page_socket() {
  static PageSocket only;
  return only;
}

}  // namespace scree

using namespace scree;

int scree_socket_wish() {
  switch (page_socket().pop_wish()) {
    case PageSocket::Wish::nothing:
      return 0;
    case PageSocket::Wish::open:
      return 1;
    case PageSocket::Wish::close:
      return 2;
  }
  return 0;
}

void scree_socket_opened() {
  page_socket().opened();
}

void scree_socket_closed(const char* why) {
  page_socket().closed(why);
}

uint8_t* scree_incoming(uint32_t bytes) {
  buffers().incoming.resize(std::min<size_t>(bytes, limits::page_message_bytes_max));
  return bytes <= buffers().incoming.size() ? buffers().incoming.data() : nullptr;
}

void scree_received(uint32_t bytes) {
  if (bytes <= buffers().incoming.size()) page_socket().received(std::span(buffers().incoming).first(bytes));
}

uint32_t scree_outgoing() {
  buffers().outgoing = page_socket().drain_outgoing();
  return static_cast<uint32_t>(buffers().outgoing.size());
}

const uint8_t* scree_outgoing_bytes() {
  return buffers().outgoing.data();
}
