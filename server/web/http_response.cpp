#include "server/web/http_response.h"

#include <array>
#include <ctime>
#include <string_view>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr std::pair<int, std::string_view> reasons[] = {
    {101, "Switching Protocols"},
    {200, "OK"},
    {304, "Not Modified"},
    {307, "Temporary Redirect"},
    {400, "Bad Request"},
    {401, "Unauthorized"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {421, "Misdirected Request"},
    {426, "Upgrade Required"},
    {429, "Too Many Requests"},
    {431, "Request Header Fields Too Large"},
    {503, "Service Unavailable"},
};

std::string_view reason_of(int status) {
  for (const auto& [code, reason] : reasons)
    if (code == status) return reason;
  CHECK(false && "a status without a reason");
}

/// Cross-origin isolation gives the page threads; wasm-unsafe-eval lets it compile WebAssembly, and nothing
/// else. Sound and pictures that the page makes itself are blobs and data.
constexpr std::string_view fields_of_all =
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cross-Origin-Embedder-Policy: require-corp\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
    "img-src 'self' data: blob:; connect-src 'self'; worker-src 'self' blob:; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n";

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 40> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc)};
}

}  // namespace

HttpResponse words(int status, const std::string& line) {
  return {.status = status,
          .fields = {{"Content-Type", "text/plain; charset=utf-8"}, {"Cache-Control", "no-store"}},
          .body = std::make_shared<const std::string>(line + "\n")};
}

HttpResponse refusal(int status, Refusal reason, const std::string& line) {
  HttpResponse response = words(status, line);
  response.ends = true;
  response.refused = reason;
  return response;
}

std::string head_of(const HttpResponse& response, bool keep_alive) {
  std::string head =
      "HTTP/1.1 " + std::to_string(response.status) + " " + std::string(reason_of(response.status)) + "\r\n";
  for (const auto& [name, value] : response.fields)
    head.append(name).append(": ").append(value).append("\r\n");
  if (!response.is_upgrade()) {
    head.append("Date: ").append(date_now()).append("\r\n").append(fields_of_all);
    head.append(keep_alive ? "Connection: keep-alive\r\n" : "Connection: close\r\n");
    if (response.status != 304) {
      const size_t bytes = response.body ? response.body->size() : 0;
      head.append("Content-Length: ").append(std::to_string(bytes)).append("\r\n");
    }
  }
  return head.append("\r\n");
}

}  // namespace scree
