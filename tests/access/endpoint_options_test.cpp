// The options by which every client is told its server: what implies what, files, and the environment.
#include "client/connection/endpoint_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

#include "proto/limits.h"
#include "tests/support/certificates.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

struct Parsed {
  ServerEndpoint endpoint;
  std::string error;  ///< empty: understood
};

Parsed parse(std::vector<std::string> arguments, const std::string& token_environment = "SCREE_TOKEN") {
  CLI::App app;
  Parsed parsed;
  EndpointOptions options(app, parsed.endpoint, token_environment);
  std::ranges::reverse(arguments);  // CLI11 takes them from the back
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    parsed.error = error.what();
    return parsed;
  }
  if (const Result<void> completed = options.complete(); !completed) parsed.error = completed.error().message;
  return parsed;
}

TEST(EndpointOptions, what_needs_no_token_reads_no_file_of_it) {
  CLI::App app;
  ServerEndpoint endpoint;
  EndpointOptions options(app, endpoint);
  app.parse("--token-file /no/such/file");
  EXPECT_FALSE(options.complete());
  options.drop_token();
  EXPECT_TRUE(options.complete());
  EXPECT_EQ(endpoint.token, "");
}

TEST(EndpointOptions, are_plain_on_this_machine_unless_said_otherwise) {
  const Parsed parsed = parse({});
  EXPECT_EQ(parsed.error, "");
  EXPECT_EQ(parsed.endpoint.host, "127.0.0.1");
  EXPECT_EQ(parsed.endpoint.port, default_port);
  EXPECT_FALSE(parsed.endpoint.tls);
  EXPECT_EQ(parsed.endpoint.token, "");
}

TEST(EndpointOptions, a_port_in_the_host_is_named_as_the_mistake_that_it_is) {
  EXPECT_EQ(parse({"--host", "127.0.0.1:5100"}).error,
            "--host: '127.0.0.1:5100' has a port in it: --host 127.0.0.1 --port 5100");
  EXPECT_EQ(parse({"--host", "::1"}).error, "");
}

TEST(EndpointOptions, what_to_trust_implies_tls) {
  EXPECT_TRUE(parse({"--tls"}).endpoint.tls);
  EXPECT_TRUE(parse({"--tls-ca", "f"}).endpoint.tls);
  EXPECT_TRUE(parse({"--tls-fingerprint", "AB"}).endpoint.tls);
  EXPECT_NE(parse({"--tls-ca", "f", "--tls-fingerprint", "AB"}).error, "");
  ::setenv("SCREE_TLS_CA", "by-environment", 1);
  const Parsed parsed = parse({});
  ::unsetenv("SCREE_TLS_CA");
  EXPECT_TRUE(parsed.endpoint.tls);
  EXPECT_EQ(parsed.endpoint.trust.ca_path, "by-environment");
}

TEST(EndpointOptions, a_token_comes_from_the_line_a_file_or_the_environment) {
  const TestFolder folder;
  std::ofstream(folder / "token") << "scree1.in-a-file\n";
  EXPECT_EQ(parse({"--token", "on-the-line"}).endpoint.token, "on-the-line");
  EXPECT_EQ(parse({"--token-file", folder / "token"}).endpoint.token, "scree1.in-a-file");
  EXPECT_NE(parse({"--token", "a", "--token-file", "b"}).error, "");
  EXPECT_TRUE(holds(parse({"--token-file", folder / "none"}).error, "cannot be read"));
  EXPECT_TRUE(holds(parse({"--token", "two words"}).error, "without spaces"));
  EXPECT_TRUE(
      holds(parse({"--token", std::string(limits::access_token_bytes_max + 1, 'x')}).error, "at most 512"));
  ::setenv("SCREE_ADMIN_TOKEN_FILE", (folder / "token").c_str(), 1);
  const Parsed parsed = parse({}, "SCREE_ADMIN_TOKEN");
  const Parsed other = parse({});
  ::unsetenv("SCREE_ADMIN_TOKEN_FILE");
  EXPECT_EQ(parsed.endpoint.token, "scree1.in-a-file");
  EXPECT_EQ(other.endpoint.token, "") << "an administrator's token is for the administrator's program";
}

TEST(EndpointOptions, a_socket_needs_neither_address_nor_token_and_its_variable_is_the_weakest) {
  const auto parse_admin = [](std::vector<std::string> arguments) {
    CLI::App app;
    Parsed parsed;
    EndpointOptions options(app, parsed.endpoint, "SCREE_ADMIN_TOKEN", EndpointNaming::or_socket);
    std::ranges::reverse(arguments);
    app.parse(arguments);
    if (const auto completed = options.complete(); !completed) parsed.error = completed.error().message;
    return parsed;
  };
  EXPECT_EQ(parse_admin({}).endpoint.socket, "");
  EXPECT_EQ(parse_admin({"--socket", "s"}).endpoint.socket, "s");
  for (const char* const beside :
       {"--host=h", "--port=1", "--tls", "--tls-ca=f", "--token=t", "--token-file=f"})
    EXPECT_TRUE(holds(parse_admin({"--socket", "s", beside}).error, "--socket has no use for --")) << beside;
  ::setenv("SCREE_HOST", "by-environment", 1);
  ::setenv("SCREE_ADMIN_TOKEN_FILE", "/no/such/file", 1);
  const Parsed beside_variables = parse_admin({"--socket", "s"});
  ::setenv("SCREE_ADMIN_SOCKET", "by-environment", 1);
  const Parsed by_host = parse_admin({});
  ::unsetenv("SCREE_HOST");
  ::unsetenv("SCREE_ADMIN_TOKEN_FILE");
  const Parsed alone = parse_admin({}), by_port = parse_admin({"--port", "1"}), other = parse({});
  ::unsetenv("SCREE_ADMIN_SOCKET");
  EXPECT_EQ(beside_variables.error, "");
  EXPECT_EQ(beside_variables.endpoint.socket, "s");
  EXPECT_EQ(by_host.endpoint.socket, "");
  EXPECT_EQ(alone.endpoint.socket, "by-environment");
  EXPECT_EQ(by_port.endpoint.socket, "");
  EXPECT_EQ(other.endpoint.socket, "") << "the socket is for the administrator's program";
}

TEST(EndpointOptions, one_option_names_a_server_where_there_may_be_none) {
  const auto parse_server = [](const std::string& server) {
    CLI::App app;
    Parsed parsed;
    EndpointOptions options(app, parsed.endpoint, "SCREE_TOKEN", EndpointNaming::server);
    std::vector<std::string> arguments;
    if (!server.empty()) arguments = {server, "--server"};
    app.parse(arguments);
    EXPECT_EQ(options.names_server(), !server.empty());
    if (const auto completed = options.complete(); !completed) parsed.error = completed.error().message;
    return parsed;
  };
  const auto place = [&](const std::string& server) {
    const Parsed parsed = parse_server(server);
    return parsed.error.empty() ? parsed.endpoint.host + " " + std::to_string(parsed.endpoint.port)
                                : parsed.error;
  };
  const std::string usual = std::to_string(default_port);
  EXPECT_EQ(place(""), "127.0.0.1 " + usual);
  EXPECT_EQ(place("hill.example"), "hill.example " + usual);
  EXPECT_EQ(place("hill.example:4000"), "hill.example 4000");
  EXPECT_EQ(place("[::1]:4000"), "::1 4000");
  EXPECT_EQ(place("[::1]"), "::1 " + usual);
  EXPECT_EQ(place("::1"), "::1 " + usual);
  EXPECT_TRUE(holds(place("hill:0"), "a whole number, 1 to 65535"));
  EXPECT_TRUE(holds(place("hill:"), "the port of 'hill:'"));
  EXPECT_TRUE(holds(place(":4000"), "names no host"));
  EXPECT_TRUE(holds(place("[::1:4000"), "has no ]"));
}

}  // namespace
}  // namespace scree
