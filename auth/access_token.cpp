#include "auth/access_token.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include "auth/base64url.h"
#include "auth/limits.h"
#include "proto/byte_stream.h"
#include "proto/limits.h"
#include "shared/base/regular_file.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Names the format, so that no signature of anything else can be taken for a token's.
constexpr std::string_view prefix = "scree1.";

std::vector<uint8_t> bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

Result<void> check_text(const std::string& text, size_t bytes_max, const char* what) {
  if (text.size() > bytes_max)
    return fail(fmt::format("{} has {} bytes, over the limit of {}", what, text.size(), bytes_max));
  if (const auto fault = fault_of_text(text)) return fail(fmt::format("{} {}", what, *fault));
  return {};
}

Result<void> check(const AccessToken& token) {
  if (token.id == 0) return fail("a token's id is not 0");
  TRY(check_text(token.name, limits::person_name_bytes_max, "the name"));
  TRY(check_text(token.team, limits::person_name_bytes_max, "the team's name"));
  return check_text(token.world, limits::world_name_bytes_max, "the world's name");
}

void write_text(ByteWriter& writer, const std::string& text) {
  writer.u8(static_cast<uint8_t>(text.size()));
  for (const char c : text) writer.u8(static_cast<uint8_t>(c));
}

std::string read_text(ByteReader& reader, const char* what) {
  const auto bytes = reader.read_bytes(reader.u8(what, UINT8_MAX), what);
  return {bytes.begin(), bytes.end()};
}

Result<AccessToken> read_payload(std::span<const uint8_t> payload) {
  ByteReader reader(payload, "the token");
  AccessToken token;
  token.role = reader.kind<Role>("role");
  token.id = reader.u64("id");
  token.issued_s = reader.varint("time of issue");
  token.expires_s = reader.varint("time of expiry");
  token.name = read_text(reader, "name");
  token.world = read_text(reader, "world");
  if (!reader.at_end()) token.team = read_text(reader, "team");
  reader.finish();
  if (reader.failed()) return tl::unexpected(reader.error());
  TRY(check(token));
  return token;
}

}  // namespace

Result<std::string> sign(const AccessToken& token, const SigningKey& key) {
  TRY(check(token));
  std::vector<uint8_t> bytes = bytes_of(prefix);
  ByteWriter writer(bytes);
  writer.u8(static_cast<uint8_t>(token.role));
  writer.u64(token.id);
  writer.varint(token.issued_s);
  writer.varint(token.expires_s);
  write_text(writer, token.name);
  write_text(writer, token.world);
  if (!token.team.empty()) write_text(writer, token.team);
  const Signature signature = key.sign(bytes);
  bytes.insert(bytes.end(), signature.begin(), signature.end());
  return std::string(prefix) + to_base64url(std::span(bytes).subspan(prefix.size()));
}

bool is_access_token(std::string_view text) {
  return text.starts_with(prefix);
}

Result<ReadToken> read_access_token(std::string_view text) {
  if (text.size() > limits::access_token_bytes_max)
    return fail(fmt::format("a token has at most {} characters (limits.access_token_bytes_max)",
                            limits::access_token_bytes_max));
  if (!is_access_token(text))
    return fail("this is not an access token: access tokens begin with '" + std::string(prefix) + "'");
  const auto bytes = from_base64url(text.substr(prefix.size()));
  if (!bytes || bytes->size() < signature_bytes) return fail("the token is damaged: was all of it copied?");
  const std::span<const uint8_t> payload = std::span(*bytes).first(bytes->size() - signature_bytes);
  auto token = read_payload(payload);
  if (!token) return fail("the token is damaged: " + token.error().message);
  ReadToken read;
  read.token = std::move(*token);
  read.signed_bytes = bytes_of(prefix);
  read.signed_bytes.insert(read.signed_bytes.end(), payload.begin(), payload.end());
  std::ranges::copy(std::span(*bytes).last(signature_bytes), read.signature.begin());
  return read;
}

std::string id_text(uint64_t id) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (size_t i = text.size(); i-- > 0; id >>= 4U) text[i] = digits[id & 15U];
  return text;
}

Result<uint64_t> read_id(std::string_view text) {
  uint64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
  if (text.size() != 16 || error != std::errc() || end != text.data() + text.size())
    return fail("'" + std::string(text) + "' is not the id of a token: an id has 16 hex digits");
  return id;
}

Result<std::vector<uint64_t>> read_revoked(const std::string& path) {
  // It is read again while the server runs, which must not wait for a pipe's other end.
  if (const auto small = check_is_small_file(path, limits::revoked_bytes_max); !small)
    return fail("the list of revoked tokens cannot be read: " + small.error().message);
  std::ifstream file(path);
  if (!file) return fail("the list of revoked tokens " + path + " cannot be read");
  std::vector<uint64_t> ids;
  size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string where = fmt::format("{}, line {}: ", path, ++number);
    line.resize(std::min(line.find('#'), line.size()));
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const size_t last = line.find_last_not_of(" \t\r");
    const auto id = read_id(std::string_view(line).substr(first, last + 1 - first));
    if (!id) return fail(where + id.error().message);
    if (ids.size() == limits::revoked_tokens_max)
      return fail(fmt::format(
          "{}there are more than {} ids (limits.revoked_tokens_max); remove ids of expired tokens", where,
          limits::revoked_tokens_max));
    ids.push_back(*id);
  }
  std::ranges::sort(ids);
  return ids;
}

}  // namespace scree
