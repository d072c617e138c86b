// What a server's own reader says of a request. A page leaves it out: it has no reader of what clients send.
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "client/library/handle.h"
#include "proto/codec.h"

namespace scree {

std::string fault_of(const Request& request) {
  return std::visit(
      [](const auto& asked) -> std::string {
        using Asked = std::decay_t<decltype(asked)>;
        if constexpr (std::is_same_v<Asked, SettingsRequest> || std::is_same_v<Asked, LeaveRequest> ||
                      std::is_same_v<Asked, RulesRequest>) {
          return "this is no request of clients";
        } else {
          const std::vector<uint8_t> bytes = encode(ClientMessage(RequestMessage<Asked>{asked, 1}));
          const auto read = decode_client(std::span(bytes).subspan(length_prefix_bytes));
          return read ? std::string() : read.error().message;
        }
      },
      request);
}

}  // namespace scree
