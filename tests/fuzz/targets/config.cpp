// What a host or a player writes: the server's command line and its TOML file, and a client's endpoint. Lines
// up to one that is empty are arguments ('' is an empty one), the rest is the file.
//
// Holds: options that are taken are within their limits; all else is a message and an exit code.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "client/connection/endpoint_options.h"
#include "server/app/server_options.h"
#include "server/world/settings.h"
#include "shared/base/check.h"
#include "shared/base/token.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr size_t arguments_max = 32;

/// Refusals are printed, hundreds a second.
void silence() {
  std::cout.setstate(std::ios::failbit);
  std::cerr.setstate(std::ios::failbit);
}

std::vector<std::string> lines_of(std::string_view text, size_t& end) {
  std::vector<std::string> lines;
  for (end = 0; end < text.size() && lines.size() < arguments_max;) {
    const size_t line_end = std::min(text.find('\n', end), text.size());
    const std::string line(text.substr(end, line_end - end));
    end = std::min(line_end + 1, text.size());
    if (line.empty()) break;
    lines.push_back(line == "''" ? "" : line.substr(0, line.find('\0')));
  }
  return lines;
}

std::vector<const char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  return pointers;
}

void check_server(const std::vector<std::string>& arguments) {
  const std::vector<const char*> argv = pointers_to(arguments);
  const auto parsed = parse_server_options(static_cast<int>(argv.size()), argv.data());
  if (const int* code = std::get_if<int>(&parsed)) {
    CHECK(*code == 0 || *code == 2);
    return;
  }
  const LiveConfig& live = std::get<ServerOptions>(parsed).live;
  CHECK(validate(live.world).has_value());
  CHECK(live.net.admin_token.empty() || check_token(live.net.admin_token).has_value());
  WorldConfig again;
  CHECK(set_all(again, print(live.world)).has_value());
  CHECK(again.methods == live.world.methods);
}

void check_endpoint(const std::vector<std::string>& arguments) {
  CLI::App app("fuzz");
  ServerEndpoint endpoint;
  EndpointOptions options(app, endpoint);
  const std::vector<const char*> argv = pointers_to(arguments);
  try {
    app.parse(static_cast<int>(argv.size()), argv.data());
  } catch (const CLI::ParseError&) {
    return;
  }
  if (options.complete()) CHECK(endpoint.port != 0 && endpoint.token.find(' ') == std::string::npos);
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  silence();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.find("dev") != std::string_view::npos) return 0;  // the end of /dev/zero is far
  size_t end = 0;
  std::vector<std::string> arguments = lines_of(text, end);
  arguments.insert(arguments.begin(), "scree");
  check_endpoint(arguments);
  check_server(arguments);
  const ScratchFile file("config");
  file.write({data + end, size - end});
  arguments.insert(arguments.begin() + 1, {"--config", file.path()});
  check_server(arguments);
  return 0;
}
