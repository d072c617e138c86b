#include "client/connection/come_again.h"

#include <algorithm>

namespace scree {

namespace {

/// The person has to do something first: take another program, another token, or talk to somebody.
constexpr std::string_view lasting[] = {
    "protocol_version",
    "tls_required",
    "token_missing",
    "token_malformed",
    "token_foreign",
    "token_world",
    "token_expired",
    "token_revoked",
    "admin_token_wrong",
    "kicked",
    "banned",
    "hello_missing",
    "hello_repeated",
    "message_malformed",
    "interest_invalid",
    "edge",
    token_in_clear,
};

}  // namespace

bool may_come_again(std::string_view refusal) {
  return std::ranges::find(lasting, refusal) == std::ranges::end(lasting);
}

}  // namespace scree
