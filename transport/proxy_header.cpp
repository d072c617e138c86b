#include "transport/proxy_header.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <string_view>
#include <vector>

namespace scree {

namespace {

constexpr std::string_view text_start = "PROXY ";
/// Bytes of a header of version 1 at most, its end included.
constexpr size_t text_bytes_max = 107;
constexpr std::array<uint8_t, 12> binary_start{'\r', '\n', '\r', '\n', '\0', '\r',
                                               '\n', 'Q',  'U',  'I',  'T',  '\n'};
/// Start, version and command, family, length.
constexpr size_t binary_head_bytes = 16;

using Read = Result<std::optional<ProxyHeader>>;

/// Whether the bytes are the start of this, as far as both go.
template <typename Start>
bool begins(std::span<const uint8_t> first, const Start& start) {
  return std::equal(first.begin(),
                    first.begin() + static_cast<std::ptrdiff_t>(std::min(first.size(), start.size())),
                    start.begin(), [](uint8_t a, auto b) { return a == static_cast<uint8_t>(b); });
}

/// The address as the system writes it; empty: it is none.
std::string address_of(int family, std::string_view text) {
  std::array<uint8_t, 16> bytes{};
  std::array<char, INET6_ADDRSTRLEN> written{};
  if (inet_pton(family, std::string(text).c_str(), bytes.data()) != 1) return {};
  return inet_ntop(family, bytes.data(), written.data(), written.size());
}

std::string address_of(int family, std::span<const uint8_t> bytes) {
  std::array<char, INET6_ADDRSTRLEN> written{};
  return inet_ntop(family, bytes.data(), written.data(), written.size());
}

std::optional<uint16_t> port_of(std::string_view text) {
  uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return port;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t from = 0; from <= line.size();) {
    const size_t end = std::min(line.find(' ', from), line.size());
    words.push_back(line.substr(from, end - from));
    from = end + 1;
  }
  return words;
}

/// "PROXY TCP4 192.0.2.7 192.0.2.1 50000 4177\r\n", or "PROXY UNKNOWN …\r\n".
Read read_text(std::string_view text) {
  const size_t end = text.substr(0, text_bytes_max).find("\r\n");
  if (end == text.npos && text.size() < text_bytes_max) return std::nullopt;
  if (end == text.npos) return fail("a PROXY header of version 1 without an end");
  const auto words = words_of(text.substr(0, end));
  ProxyHeader header{end + 2, {}, 0};
  if (words.size() >= 2 && words[1] == "UNKNOWN") return header;
  if (words.size() != 6 || (words[1] != "TCP4" && words[1] != "TCP6"))
    return fail("a PROXY header of version 1 that names no TCP4, TCP6 or UNKNOWN");
  header.address = address_of(words[1] == "TCP4" ? AF_INET : AF_INET6, words[2]);
  const auto port = port_of(words[4]);
  if (header.address.empty() || !port) return fail("a PROXY header of version 1 without a client's address");
  header.port = *port;
  return header;
}

Read read_binary(std::span<const uint8_t> first) {
  if (first.size() < binary_head_bytes) return std::nullopt;
  const auto u16 = [&](size_t at) { return static_cast<uint16_t>(first[at] << 8U | first[at + 1]); };
  const size_t length = u16(14), whole = binary_head_bytes + length;
  if (whole > proxy_header_bytes_max) return fail("a PROXY header of version 2 that is too long");
  if (first[12] >> 4U != 2 || (first[12] & 0x0FU) > 1)
    return fail("a PROXY header of version 2 with an unknown version or command");
  if (first.size() < whole) return std::nullopt;
  ProxyHeader header{whole, {}, 0};
  const bool local = (first[12] & 0x0FU) == 0;
  const unsigned family = first[13] >> 4U;
  if (local || (family != 1 && family != 2)) return header;
  const size_t address_bytes = family == 1 ? 4 : 16;
  if (length < 2 * address_bytes + 4)
    return fail("a PROXY header of version 2 that is too short for its family");
  header.address =
      address_of(family == 1 ? AF_INET : AF_INET6, first.subspan(binary_head_bytes, address_bytes));
  header.port = u16(binary_head_bytes + 2 * address_bytes);
  return header;
}

}  // namespace

Read read_proxy_header(std::span<const uint8_t> first) {
  const auto known = [&](const auto& start) { return first.size() >= start.size(); };
  if (begins(first, text_start)) {
    if (!known(text_start)) return std::nullopt;
    return read_text({reinterpret_cast<const char*>(first.data()), first.size()});
  }
  if (begins(first, binary_start)) return known(binary_start) ? read_binary(first) : Read(std::nullopt);
  return ProxyHeader{};
}

}  // namespace scree
