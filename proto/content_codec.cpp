#include "proto/content_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/limits.h"

namespace scree {

std::string wire_digest(const Digest& digest) {
  return {digest.begin(), digest.end()};
}

Digest read_digest(const std::string& from, const char* what, FieldChecker& check) {
  Digest digest{};
  if (from.size() == digest.size())
    std::ranges::copy(as_span(from), digest.begin());
  else
    check.refuse(fmt::format("{} of {} bytes, not {}", what, from.size(), digest.size()));
  return digest;
}

std::optional<Digest> read_any_digest(const std::string& from, const char* what, FieldChecker& check) {
  return from.empty() ? std::nullopt : std::optional(read_digest(from, what, check));
}

void write(wire::ContentRequest& to, const AskContentMessage& from) {
  std::string wanted;
  for (const Digest& digest : from.wanted) wanted += wire_digest(digest);
  to.set_wanted(std::move(wanted));
}

AskContentMessage read(const wire::ContentRequest& from, FieldChecker& check) {
  constexpr size_t size = sizeof(Digest);
  const std::string& wanted = from.wanted();
  AskContentMessage request;
  if (wanted.size() > size * limits::contents_wanted_max)
    check.refuse(
        fmt::format("content is asked for with {} bytes of digests, over the limit of {} digests "
                    "(limits.contents_wanted_max)",
                    wanted.size(), limits::contents_wanted_max));
  else if (wanted.size() % size != 0)
    check.refuse(fmt::format("{} bytes are no digests of {}", wanted.size(), size));
  else
    for (size_t i = 0; i < wanted.size(); i += size)
      request.wanted.push_back(read_digest(wanted.substr(i, size), "digest", check));
  return request;
}

void write(wire::Content& to, const ContentMessage& from) {
  to.set_digest(wire_digest(from.digest));
  to.set_total(from.total);
  to.set_offset(from.offset);
  to.set_part(to_string(from.part));
}

ContentMessage read(const wire::Content& from, FieldChecker& check) {
  ContentMessage content;
  content.digest = read_digest(from.digest(), "digest of content", check);
  content.total = check.within(from.total(), 0, limits::content_bytes_max, "bytes of content");
  content.offset = check.within(from.offset(), 0, content.total, "offset of a part of content");
  const std::string& part = from.part();
  const size_t most = std::min<size_t>(content.total - content.offset, limits::content_part_bytes_max);
  if (part.size() > most || part.empty() != (content.total == 0))
    check.refuse(
        fmt::format("a part of content of {} bytes at {} of {}", part.size(), content.offset, content.total));
  else
    content.part.assign(part.begin(), part.end());
  return content;
}

namespace {

/// The rows up to the last that has one of these masses.
std::span<const MaterialLedger::Row> rows_with(const MaterialLedger& ledger,
                                               std::span<MassUnits MaterialLedger::Row::*const> masses) {
  std::span<const MaterialLedger::Row> rows = ledger.rows();
  const auto is_empty = [&](const MaterialLedger::Row& row) {
    return std::all_of(masses.begin(), masses.end(), [&](const auto mass) { return row.*mass == 0; });
  };
  while (!rows.empty() && is_empty(rows.back())) rows = rows.first(rows.size() - 1);
  return rows;
}

using LedgerRow = MaterialLedger::Row;
constexpr std::array in_world{&LedgerRow::terrain, &LedgerRow::pieces, &LedgerRow::dust, &LedgerRow::poured,
                              &LedgerRow::converted};
constexpr std::array in_stores{&LedgerRow::stored};

std::string pack_rows(const MaterialLedger& ledger, std::span<MassUnits LedgerRow::*const> masses) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (const LedgerRow& row : rows_with(ledger, masses))
    for (const auto mass : masses) writer.zigzag(row.*mass);
  return to_string(bytes);
}

void unpack_rows(const std::string& packed, std::span<MassUnits LedgerRow::*const> masses,
                 std::vector<LedgerRow>& rows, FieldChecker& check) {
  ByteReader reader(as_span(packed), "ledger of the materials");
  for (size_t at = 0; !reader.at_end() && !reader.failed(); ++at) {
    if (at == materials_max) {
      reader.refuse("more rows than a palette has");
      break;
    }
    if (rows.size() <= at) rows.emplace_back();
    for (const auto mass : masses)
      rows[at].*mass = reader.zigzag("mass (limits.ledger_mass_max)", limits::ledger_mass_max);
  }
  if (reader.failed()) check.refuse(reader.error().message);
}

}  // namespace

std::string pack_ledger(const MaterialLedger& ledger) {
  return pack_rows(ledger, in_world);
}

std::string pack_stored(const MaterialLedger& ledger) {
  return pack_rows(ledger, in_stores);
}

MassUnits ledger_mass(int64_t mass, FieldChecker& check) {
  if (mass >= -limits::ledger_mass_max && mass <= limits::ledger_mass_max) return mass;
  check.refuse(fmt::format("mass {} in a ledger is beyond ±{}, which no world has (limits.ledger_mass_max)",
                           mass, limits::ledger_mass_max));
  return 0;
}

MaterialLedger unpack_ledger(const std::string& packed, const std::string& stored, FieldChecker& check) {
  std::vector<LedgerRow> rows;
  unpack_rows(packed, in_world, rows, check);
  unpack_rows(stored, in_stores, rows, check);
  return MaterialLedger(std::move(rows));
}

}  // namespace scree
