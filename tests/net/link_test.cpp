// Simulated links in simulated time: bytes come in order, when they may and as many as may; links that are
// cut or silent; and the text that describes them.
#include <gtest/gtest.h>
#include <numeric>

#include "shared/base/random.h"
#include "tests/support/holds.h"
#include "tests/support/simulated_time.h"
#include "transport/limits.h"
#include "transport/link_transport.h"

namespace scree {
namespace {

std::vector<uint8_t> counted_bytes(size_t count) {
  std::vector<uint8_t> bytes(count);
  std::iota(bytes.begin(), bytes.end(), uint8_t{0});
  return bytes;
}

TEST(LinkPipes, bytes_take_the_delay_and_the_time_of_the_rate) {
  LinkPipe pipe({.delay_s = 0.5, .rate_bytes_per_s = 1200.0, .buffer_bytes = 6000}, 1);
  const std::vector<uint8_t> bytes = counted_bytes(3600);
  pipe.push(bytes, 10.0);
  EXPECT_EQ(pipe.room(10.0), 2400U);
  EXPECT_EQ(pipe.room(11.0), 3600U);
  std::vector<uint8_t> out(3600);
  EXPECT_EQ(pipe.next_s(10.0), 10.5) << "half of the buffer is free then";
  EXPECT_EQ(pipe.pop(out, 11.49), 0U);
  EXPECT_EQ(pipe.pop(out, 11.51), 1200U);
  EXPECT_EQ(pipe.pop(std::span(out).subspan(1200), 13.6), 2400U);
  EXPECT_EQ(out, bytes);
  EXPECT_TRUE(pipe.empty());
  EXPECT_FALSE(pipe.next_s(14.0));
}

TEST(LinkPipes, jitter_delays_and_never_reorders) {
  LinkPipe pipe({.delay_s = 0.1, .jitter_s = 0.05}, 7);
  const std::vector<uint8_t> bytes = counted_bytes(100);
  std::vector<uint8_t> out;
  std::set<double> ways_s;
  double pushed_s = 0.0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    pipe.push(std::span(bytes).subspan(i, 1), pushed_s = 0.2 * static_cast<double>(i));
    const double arrives_s = pipe.next_s(pushed_s).value();
    ways_s.insert(arrives_s - pushed_s);
    uint8_t byte = 0;
    EXPECT_EQ(pipe.pop({&byte, 1}, arrives_s), 1U);
    out.push_back(byte);
  }
  EXPECT_EQ(out, bytes);
  EXPECT_GE(*ways_s.begin(), 0.1 - 1e-9);
  EXPECT_LE(*ways_s.rbegin(), 0.15 + 1e-9);
  EXPECT_GT(*ways_s.rbegin() - *ways_s.begin(), 0.03);
}

TEST(LinkPipes, nothing_passes_after_the_cut_or_the_silence) {
  std::vector<uint8_t> out(100);
  LinkPipe cut({.cut_bytes = 10}, 1);
  EXPECT_EQ(cut.room(0.0), 10U);
  cut.push(counted_bytes(10), 0.0);
  EXPECT_EQ(cut.room(5.0), 0U);
  EXPECT_FALSE(cut.severed()) << "its last bytes are on their way";
  EXPECT_EQ(cut.pop(out, 5.0), 10U);
  EXPECT_TRUE(cut.severed());
  LinkPipe silent({.half_open_bytes = 10}, 1);
  silent.push(counted_bytes(10), 0.0);
  EXPECT_EQ(silent.pop(out, 5.0), 10U);
  EXPECT_EQ(silent.room(5.0), 0U);
  EXPECT_FALSE(silent.severed());
  EXPECT_FALSE(silent.next_s(5.0));
}

/// Sends all of `outgoing`, and keeps what arrives.
struct LinkTalker {
  std::shared_ptr<Transport> stream;
  std::vector<uint8_t> outgoing;
  size_t sent = 0;
  std::vector<uint8_t> arrived{};
  std::array<uint8_t, 700> buffer{};
  std::string end{}, write_end{};

  void start() {
    read();
    if (!outgoing.empty()) write();
  }
  void read() {
    stream->read_some(buffer, [this](const Moved& moved) {
      if (!moved) return void(end = (moved.error().orderly ? "orderly: " : "broken: ") + moved.error().why);
      arrived.insert(arrived.end(), buffer.begin(), buffer.begin() + static_cast<ptrdiff_t>(*moved));
      read();
    });
  }
  void write() {
    const std::span<const uint8_t> rest = std::span<const uint8_t>(outgoing).subspan(sent);
    const std::span<const uint8_t> halves[] = {rest.first(rest.size() / 2), rest.subspan(rest.size() / 2)};
    stream->write_some(halves, [this](const Moved& moved) {
      if (!moved) return void(write_end = moved.error().why);
      sent += *moved;
      if (sent < outgoing.size()) write();
    });
  }
};

/// A link over a stream in memory, with somebody at both ends.
struct Linked {
  SimulatedTime time;
  std::shared_ptr<MemoryStream> near = std::make_shared<MemoryStream>(1500);
  std::shared_ptr<MemoryStream> far = std::make_shared<MemoryStream>(1500);
  LinkTalker here, there;

  Linked(const LinkConfig& link, size_t up_bytes, size_t down_bytes)
      : here{std::make_shared<LinkTransport>(near, link, time.clock()), counted_bytes(up_bytes)},
        there{far, counted_bytes(down_bytes)} {
    MemoryStream::join(near, far);
    there.start();
    here.start();
  }
  ~Linked() {
    here.stream->close();
    there.stream->close();
  }
};

LinkConfig both(const LinkWay& way, uint64_t random_seed = 1) {
  return {way, way, random_seed};
}

TEST(LinkTransports, give_out_what_was_put_in) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    Linked linked(
        both({.delay_s = 0.05, .jitter_s = 0.03, .rate_bytes_per_s = 20000.0, .buffer_bytes = 3000}, seed),
        40'000, 60'000);
    linked.time.run_until(0.04);
    EXPECT_TRUE(linked.here.arrived.empty() && linked.there.arrived.empty());
    linked.time.run_until(1.0);
    EXPECT_NEAR(static_cast<double>(linked.here.arrived.size()), 19'000.0, 1500.0) << "at the link's rate";
    EXPECT_LE(linked.there.sent, linked.here.arrived.size() + 3000 + 1500 + 2 * 1200 + 1600)
        << "who sends is held back";
    linked.time.run_until(4.0);
    EXPECT_EQ(linked.there.arrived, linked.here.outgoing) << seed;
    EXPECT_EQ(linked.here.arrived, linked.there.outgoing) << seed;
    linked.there.stream->finish_sending();
    linked.here.stream->finish_sending();
    linked.time.run_until(5.0);
    EXPECT_EQ(linked.here.end, "orderly: the other side ended it");
    EXPECT_EQ(linked.there.end, "orderly: the other side ended it");
  }
}

TEST(LinkTransports, are_cut_at_any_byte_either_way_and_say_so) {
  for (uint64_t bytes = 0; bytes <= 3000; bytes += bytes < 20 ? 1 : 149) {
    LinkConfig link = both({.delay_s = 0.01});
    link.up.cut_bytes = bytes;
    Linked up(link, 4000, 100);
    up.time.run_until(1.0);
    EXPECT_EQ(up.there.arrived.size(), bytes);
    EXPECT_TRUE(
        holds(up.here.end, "broken: the simulated link was cut after " + std::to_string(bytes) + " bytes up"))
        << up.here.end;
    EXPECT_EQ(up.there.end, "broken: reset");
    link = both({.delay_s = 0.01});
    link.down.cut_bytes = bytes;
    Linked down(link, 100, 4000);
    down.time.run_until(1.0);
    EXPECT_EQ(down.here.arrived.size(), bytes);
    EXPECT_TRUE(holds(down.here.end, std::to_string(bytes) + " bytes down")) << down.here.end;
  }
}

TEST(LinkTransports, that_fall_silent_tell_nobody_and_hold_the_sender_back) {
  LinkConfig link = both({.delay_s = 0.01});
  link.up.half_open_bytes = link.down.half_open_bytes = 2000;
  Linked linked(link, 10'000, 10'000);
  linked.time.run_until(1000.0);
  EXPECT_EQ(linked.here.arrived.size(), 2000U);
  EXPECT_EQ(linked.there.arrived.size(), 2000U);
  EXPECT_EQ(linked.here.sent, 2000U);
  EXPECT_LE(linked.there.sent, 2000U + 1500U);
  EXPECT_TRUE(linked.here.end.empty() && linked.there.end.empty() && linked.here.write_end.empty());
}

TEST(LinkText, describes_both_directions_or_one) {
  const auto link =
      read_link("delay=50ms,jitter=0.02s,rate=1Mbit,buffer=16kB,down.rate=100kbit,up.cut=2000,seed=7");
  ASSERT_TRUE(link) << link.error().message;
  EXPECT_DOUBLE_EQ(link->up.delay_s, 0.05);
  EXPECT_DOUBLE_EQ(link->down.delay_s, 0.05);
  EXPECT_DOUBLE_EQ(link->down.jitter_s, 0.02);
  EXPECT_DOUBLE_EQ(link->up.rate_bytes_per_s, 125000.0);
  EXPECT_DOUBLE_EQ(link->down.rate_bytes_per_s, 12500.0);
  EXPECT_EQ(buffer_of(link->up), 16000U);
  EXPECT_EQ(link->up.cut_bytes, 2000U);
  EXPECT_FALSE(link->down.cut_bytes);
  EXPECT_EQ(link->random_seed, 7U);
  EXPECT_EQ(*read_link("seed=7,up.cut=2000,down.rate=100kbit,buffer=16kB,rate=1Mbit,jitter=20ms,delay=50ms"),
            *link)
      << "in any order";
  EXPECT_EQ(*read_link(""), LinkConfig{});
  EXPECT_EQ(read_link("half-open=5kB")->down.half_open_bytes, 5000U);
  EXPECT_EQ(buffer_of(read_link("rate=1Mbit")->up), static_cast<size_t>(125000.0 * limits::link_buffer_s));
}

TEST(LinkText, what_is_wrong_is_named_with_the_way_to_write_it) {
  const auto error = [](const char* text) {
    const auto link = read_link(text);
    return link ? std::string() : link.error().message;
  };
  EXPECT_TRUE(holds(error("dely=3ms"), "no 'dely'"));
  EXPECT_TRUE(holds(error("dely=3ms"), "delay, jitter, rate, buffer, cut, half-open, seed"));
  EXPECT_TRUE(holds(error("delay=3"), "a time as 50ms or 0.2s, at most 10s, not '3'"));
  EXPECT_TRUE(holds(error("delay"), "not by 'delay'"));
  EXPECT_TRUE(holds(error("delay=1ms,,"), "not by ''"));
  EXPECT_TRUE(holds(error("delay=1ms,"), "not by ''")) << "nothing follows the comma";
  EXPECT_TRUE(holds(error("delay=1ms,rate=1Mbit,delay=2ms"), "two values for its delay"));
  EXPECT_TRUE(holds(error("up.cut=1,up.cut=2"), "two values for its up.cut"));
  EXPECT_TRUE(holds(error("down.seed=3"), "one seed for both ways: write seed=3, not 'down.seed=3'"));
  EXPECT_TRUE(holds(error("rate=10001Mbit"), "1kbit to 10000Mbit, not '10001Mbit'"));
  EXPECT_TRUE(holds(error("cut=1e13"), "at most 1000000MB"));
  EXPECT_TRUE(holds(error("down.up.rate=1Mbit"), "no 'up.rate'"));
  for (const char* wrong :
       {"delay=-1ms", "delay=11s", "jitter=nan", "rate=0kbit",      "rate=5",    "buffer=1",     "buffer=2MB",
        "cut=-1",     "cut=x",     "cut=0.5",    "buffer=2.0001kB", "seed=x",    "seed=-1",      "seed=",
        "=3",         "=",         "seed=1.5",   "left.delay=3ms",  "up.seed=3", "rate=1e99Mbit"})
    EXPECT_NE(error(wrong), "") << wrong;
}

}  // namespace
}  // namespace scree
