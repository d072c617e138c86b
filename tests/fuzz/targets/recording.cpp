// Recordings: rows of any bytes with right checksums, or a file of any bytes; read, played and verified.
//
// Rows: the first byte is odd, then come records of a table, a tick and a packet. Frames get the ticks 1, 2,
// … by themselves, so that a recording stays whole when the fuzzer adds or drops some.
//
// Holds: what cannot be read is an error; all else is played and verified to its end.
#include <array>

#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/database.h"
#include "server/store/schema.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/fuzz_input.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr Tick ticks_max = 16;
constexpr std::array<const char*, 7> tables = {
    "header", "frames", "events", "commands", "keyframe_states", "keyframe_pieces", "state_moments"};

void write_rows(FuzzInput& input, const std::string& path) {
  auto database = Database::create(path);
  CHECK(database.has_value());
  CHECK(database->execute("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;").has_value());
  CHECK(database->execute(schema::create_tables()).has_value());
  std::array<Statement, tables.size()> inserts;
  for (size_t i = 0; i < tables.size(); ++i)
    inserts[i] = std::move(*database->prepare("REPLACE" + schema::insert_into(tables[i]).substr(6)));
  for (Tick frames = 0; !input.at_end() && frames < ticks_max;) {
    const uint32_t table = input.below(tables.size());
    const uint64_t tick = input.byte();
    const auto data = input.packet();
    CHECK(database->put(inserts[table], table == 1 ? ++frames : tick, data).has_value());
  }
}

void read_all(const std::string& path) {
  auto reader = RecordingReader::open(path);
  if (!reader) {
    CHECK(!reader.error().message.empty());
    return;
  }
  if ((*reader)->last_tick() > ticks_max) return;
  for (Tick tick = 1; tick <= (*reader)->last_tick(); ++tick) {
    (void)(*reader)->frame(tick);
    (void)(*reader)->commands(tick);
    (void)(*reader)->keyframe_before(tick);
  }
  const auto report = verify(**reader);
  if (report) CHECK(report->agrees() == report->difference.empty());
}

void play(const std::string& path, Tick from) {
  auto source = ReplaySource::open(path, from);
  if (!source || (*source)->last_tick() > ticks_max) return;
  for (;;) {
    const auto delta = (*source)->next();
    if (!delta || *delta == nullptr) break;
    CHECK((*delta)->tick <= (*source)->last_tick());
  }
  if ((*source)->seek((*source)->last_tick())) (void)(*source)->next();
}

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  const bool rows = input.flag();
  const Tick from = input.byte();
  const ScratchFile file("recording");
  if (rows)
    write_rows(input, file.path());
  else
    file.write(input.rest());
  read_all(file.path());
  play(file.path(), 0);
  if (from != 0) play(file.path(), from);
  return 0;
}
