#include "server/agones/side_car.h"

#include <curl/curl.h>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>

#include "server/agones/limits.h"
#include "shared/base/check.h"

namespace scree {
namespace {

using Json = nlohmann::json;

constexpr long http_ok = 200, http_not_found = 404, http_not_implemented = 501;

/// What the side-car answers is nobody's: its status says all.
size_t forget(char* /*bytes*/, size_t size, size_t count, void* /*nobody*/) {
  return size * count;
}

}  // namespace

struct SideCar::Handle {
  Handle() {
    static std::once_flag begun;
    std::call_once(begun, [] { CHECK_EQ(::curl_global_init(CURL_GLOBAL_DEFAULT), CURLE_OK); });
    curl = ::curl_easy_init();
    CHECK(curl != nullptr);
    headers = ::curl_slist_append(nullptr, "Content-Type: application/json");
    // Messages that say "Expect: 100-continue" wait for an answer first.
    headers = ::curl_slist_append(headers, "Expect:");
    set(CURLOPT_HTTPHEADER, headers);
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_NOPROXY, "*");
    set(CURLOPT_PROTOCOLS_STR, "http");
    set(CURLOPT_TIMEOUT_MS, limits::agones_request_ms);
    set(CURLOPT_WRITEFUNCTION, &forget);
  }
  ~Handle() {
    ::curl_easy_cleanup(curl);
    ::curl_slist_free_all(headers);
  }
  template <typename Value>
  void set(CURLoption option, Value value) {
    CHECK_EQ(::curl_easy_setopt(curl, option, value), CURLE_OK);
  }

  CURL* curl = nullptr;
  curl_slist* headers = nullptr;
};

SideCar::SideCar(uint16_t port) : port_(port), handle_(std::make_unique<Handle>()) {}
SideCar::~SideCar() = default;

Result<long> SideCar::ask(const char* method, const std::string& path, const std::string& body) {
  const std::string url = fmt::format("http://127.0.0.1:{}{}", port_, path);
  handle_->set(CURLOPT_URL, url.c_str());
  handle_->set(CURLOPT_CUSTOMREQUEST, method);
  handle_->set(CURLOPT_POSTFIELDSIZE, static_cast<long>(body.size()));
  handle_->set(CURLOPT_POSTFIELDS, body.c_str());
  if (const CURLcode code = ::curl_easy_perform(handle_->curl); code != CURLE_OK)
    return fail(fmt::format("{} {}: {}", method, url, ::curl_easy_strerror(code)));
  long status = 0;
  CHECK_EQ(::curl_easy_getinfo(handle_->curl, CURLINFO_RESPONSE_CODE, &status), CURLE_OK);
  return status;
}

Result<void> SideCar::tell(const char* method, const std::string& path, const std::string& body) {
  const long status = TRY(ask(method, path, body));
  if (status == http_ok) return {};
  return fail(fmt::format("{} {}: the side-car answers {}", method, path, status));
}

Result<void> SideCar::ready() {
  return tell("POST", "/ready", "{}");
}

Result<void> SideCar::health() {
  return tell("POST", "/health", "{}");
}

Result<void> SideCar::allocate() {
  return tell("POST", "/allocate", "{}");
}

// Numbers of 64 bits are texts in JSON of protocol buffers.
Result<void> SideCar::reserve(uint32_t seconds) {
  return tell("POST", "/reserve", Json{{"seconds", std::to_string(seconds)}}.dump());
}

Result<void> SideCar::shut_down() {
  return tell("POST", "/shutdown", "{}");
}

Result<void> SideCar::set_label(const std::string& key, const std::string& value) {
  return tell("PUT", "/metadata/label", Json{{"key", key}, {"value", value}}.dump());
}

Result<bool> SideCar::set_counter(const std::string& name, uint64_t count, uint64_t capacity) {
  const Json body{{"count", std::to_string(count)}, {"capacity", std::to_string(capacity)}};
  const std::string path = "/v1beta1/counters/" + name;
  const long status = TRY(ask("PATCH", path, body.dump()));
  if (status == http_ok) return true;
  if (status == http_not_found || status == http_not_implemented) return false;
  return fail(fmt::format("PATCH {}: the side-car answers {}", path, status));
}

}  // namespace scree
