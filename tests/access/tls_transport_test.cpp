// TLS over a stream that moves any number of bytes at a time: what goes in at one end comes out at the other,
// both ways at once; ends are told.
#include "transport/tls_transport.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/certificates.h"
#include "transport/limits.h"

namespace scree {
namespace {

/// One end of a link without sockets; bytes move when carry() says so.
class LinkEnd final : public Transport {
 public:
  void read_some(std::span<uint8_t> into, Done done) override {
    into_ = into;
    read_done_ = std::move(done);
  }
  void write_some(Buffers buffers, Done done) override {
    bytes_ = buffers.front();
    write_done_ = std::move(done);
  }
  size_t write_now(Buffers buffers) override {
    EXPECT_FALSE(write_done_);
    const auto some = buffers.front().first(std::min(buffers.front().size(), takes_now));
    now_.insert(now_.end(), some.begin(), some.end());
    return some.size();
  }
  void finish_sending() override { finished_ = true; }
  void close() override { read_done_ = write_done_ = nullptr; }
  void abort() override { close(); }
  bool established() const override { return true; }
  bool encrypted() const override { return false; }
  const std::string& address() const override { return address_; }
  uint16_t port() const override { return 0; }

  /// Moves at most so many bytes to the other end, if one writes and the other reads; how many.
  size_t carry(LinkEnd& to, size_t bytes_max) {
    if (!now_.empty() && to.read_done_) {
      const size_t count = std::min({bytes_max, now_.size(), to.into_.size()});
      std::copy_n(now_.begin(), count, to.into_.begin());
      now_.erase(now_.begin(), now_.begin() + static_cast<ptrdiff_t>(count));
      std::exchange(to.read_done_, nullptr)(count);
      return count;
    }
    if (finished_ && !write_done_ && to.read_done_) {
      std::exchange(to.read_done_, nullptr)(tl::unexpected(StreamEnd{true, "end"}));
      return 0;
    }
    if (!write_done_ || !to.read_done_) return 0;
    const size_t count = std::min({bytes_max, bytes_.size(), to.into_.size()});
    std::copy_n(bytes_.begin(), count, to.into_.begin());
    const Done written = std::exchange(write_done_, nullptr);
    const Done read = std::exchange(to.read_done_, nullptr);
    written(count);
    read(count);
    return count;
  }

  size_t takes_now = 0;  ///< at most so many bytes at once

 private:
  std::vector<uint8_t> now_;  ///< taken by write_now(), and on the way
  std::span<uint8_t> into_;
  std::span<const uint8_t> bytes_;
  Done read_done_;
  Done write_done_;
  bool finished_ = false;
  std::string address_ = "nowhere";
};

/// Sends all of `outgoing`, and keeps what arrives.
struct Talker {
  std::shared_ptr<Transport> stream;
  std::vector<uint8_t> outgoing;
  size_t sent = 0;
  std::vector<uint8_t> arrived{};
  std::array<uint8_t, 5000> buffer{};
  std::optional<StreamEnd> end{};

  void read() {
    stream->read_some(buffer, [this](const Moved& moved) {
      if (!moved) {
        end = moved.error();
        return;
      }
      arrived.insert(arrived.end(), buffer.begin(), buffer.begin() + static_cast<ptrdiff_t>(*moved));
      read();
    });
  }
  void write() {
    const std::span<const uint8_t> rest = std::span<const uint8_t>(outgoing).subspan(sent);
    const std::span<const uint8_t> halves[] = {rest.first(rest.size() / 2), rest.subspan(rest.size() / 2)};
    stream->write_some(halves, [this](const Moved& moved) {
      ASSERT_TRUE(moved);
      sent += *moved;
      if (sent < outgoing.size()) write();
    });
  }
};

TEST(TlsTransports, give_out_what_was_put_in_however_the_bytes_below_are_cut) {
  const TestFolder folder;
  TestCertificate("DNS:localhost").write(folder / "certificate", folder / "key");
  const auto server = *TlsServerContext::load(folder / "certificate", folder / "key");
  const auto client = *TlsClientContext::make({folder / "certificate", ""});
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    const auto noise = [&](size_t count) {
      std::vector<uint8_t> bytes(count);
      for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.below(256));
      return bytes;
    };
    const auto near = std::make_shared<LinkEnd>(), far = std::make_shared<LinkEnd>();
    Talker here{std::make_shared<TlsTransport>(near, TlsEngine(client, "localhost")), noise(70'000)};
    Talker there{std::make_shared<TlsTransport>(far, TlsEngine(server)), noise(90'000)};
    for (Talker* talker : {&here, &there}) {
      talker->read();
      talker->write();
    }
    const auto done = [&] { return here.arrived.size() == 90'000 && there.arrived.size() == 70'000; };
    for (int steps = 0; steps < 200'000 && !done(); ++steps) {
      near->carry(*far, 1 + random.below(seed < 4 ? 40 : 20'000));
      far->carry(*near, 1 + random.below(seed < 4 ? 40 : 20'000));
    }
    EXPECT_EQ(here.arrived, there.outgoing) << seed;
    EXPECT_EQ(there.arrived, here.outgoing) << seed;
    EXPECT_FALSE(here.end || there.end) << seed;
    there.stream->finish_sending();
    for (int steps = 0; steps < 100 && !here.end; ++steps) far->carry(*near, 7);
    ASSERT_TRUE(here.end) << seed;
    EXPECT_TRUE(here.end->orderly) << seed;
    for (Talker* talker : {&here, &there}) talker->stream->close();
  }
}

TEST(TlsTransports, send_at_once_as_much_as_the_link_takes_and_the_rest_in_its_order) {
  const TestFolder folder;
  TestCertificate("DNS:localhost").write(folder / "certificate", folder / "key");
  const auto near = std::make_shared<LinkEnd>(), far = std::make_shared<LinkEnd>();
  Talker here{std::make_shared<TlsTransport>(
                  near, TlsEngine(*TlsClientContext::make({folder / "certificate", ""}), "localhost")),
              {}};
  const auto server = std::make_shared<TlsTransport>(
      far, TlsEngine(*TlsServerContext::load(folder / "certificate", folder / "key")));
  std::vector<uint8_t> wanted;
  const auto write_now = [&](size_t count) {
    std::vector<uint8_t> bytes(count);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(wanted.size() + (&byte - bytes.data()) * 7);
    const std::span<const uint8_t> all(bytes);
    const size_t taken = server->write_now({&all, 1});
    EXPECT_LE(taken, count);
    wanted.insert(wanted.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(taken));
    server->send_rest();
    return taken;
  };
  EXPECT_EQ(write_now(100), 0U) << "before the handshake nothing goes";
  here.read();
  std::array<uint8_t, 64> at_server{};
  server->read_some(at_server, [](const Moved&) {});
  const auto carry = [&](int steps) {
    for (int step = 0; step < steps; ++step) {
      near->carry(*far, 1000);
      far->carry(*near, 1000);
    }
  };
  carry(100);
  ASSERT_TRUE(server->established());
  far->takes_now = 100'000;
  EXPECT_EQ(write_now(700), 700U);
  EXPECT_EQ(write_now(100'000), tls_record_bytes) << "one record";
  far->takes_now = 300;
  EXPECT_EQ(write_now(5000), 5000U);
  EXPECT_EQ(write_now(10), 0U) << "the rest of the last ones goes first";
  carry(100);
  EXPECT_EQ(here.arrived, wanted);
  far->takes_now = 0;
  EXPECT_EQ(write_now(2000), 2000U);
  carry(100);
  EXPECT_EQ(here.arrived, wanted);
  for (Transport* end : {here.stream.get(), static_cast<Transport*>(server.get())}) end->close();
}

TEST(TlsTransports, tell_both_who_read_and_who_write_that_the_handshake_failed) {
  const TestFolder folder;
  TestCertificate("DNS:localhost").write(folder / "certificate", folder / "key");
  const auto near = std::make_shared<LinkEnd>(), far = std::make_shared<LinkEnd>();
  const auto client =
      std::make_shared<TlsTransport>(near, TlsEngine(*TlsClientContext::make({}), "localhost"));
  const auto server = std::make_shared<TlsTransport>(
      far, TlsEngine(*TlsServerContext::load(folder / "certificate", folder / "key")));
  std::array<uint8_t, 64> buffer{};
  std::string read_end, write_end, server_end;
  const std::span<const uint8_t> bytes(buffer);
  client->write_some({&bytes, 1},
                     [&](const Moved& moved) { write_end = moved ? "written" : moved.error().why; });
  client->read_some(buffer, [&](const Moved& moved) { read_end = moved ? "read" : moved.error().why; });
  std::array<uint8_t, 64> at_server{};
  server->read_some(at_server, [&](const Moved& moved) { server_end = moved ? "read" : moved.error().why; });
  for (int steps = 0; steps < 100; ++steps) {
    near->carry(*far, 1000);
    far->carry(*near, 1000);
  }
  EXPECT_NE(read_end.find("self-signed"), std::string::npos) << read_end;
  EXPECT_EQ(write_end, read_end);
  EXPECT_NE(server_end.find("unknown ca"), std::string::npos) << server_end << ": the client said why";
  EXPECT_FALSE(client->established());
}

}  // namespace
}  // namespace scree
