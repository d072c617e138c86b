// What a carve is on the wire: our operation, and its changed bricks and pieces compressed by zstd.
#include <fmt/format.h>
#include <zstd.h>

#include "bench/support/scenes.h"
#include "proto/codec.h"
#include "proto/operation_codec.h"
#include "shared/base/check.h"
#include "shared/base/quantile.h"
#include "shared/base/timing.h"
#include "shared/operation/operation.h"
#include "studies/peers/beside.h"

namespace scree {

namespace {

constexpr int usual_level = 3, high_level = 19;
constexpr uint32_t seeds = 64;
constexpr float radius_m = 2.0F;

/// zstd with its contexts kept, as who compresses often has it.
class Zstd {
 public:
  Zstd() : compressor_(ZSTD_createCCtx()), decompressor_(ZSTD_createDCtx()) {}
  ~Zstd() {
    ZSTD_freeCCtx(compressor_);
    ZSTD_freeDCtx(decompressor_);
  }
  Zstd(const Zstd&) = delete;
  Zstd& operator=(const Zstd&) = delete;

  std::vector<uint8_t> packed(std::span<const Code> codes, int level) {
    std::vector<uint8_t> bytes(ZSTD_compressBound(codes.size()));
    const size_t size =
        ZSTD_compressCCtx(compressor_, bytes.data(), bytes.size(), codes.data(), codes.size(), level);
    CHECK(ZSTD_isError(size) == 0U);
    bytes.resize(size);
    return bytes;
  }
  void unpack(std::span<const uint8_t> bytes, std::span<Code> codes) {
    const size_t size =
        ZSTD_decompressDCtx(decompressor_, codes.data(), codes.size(), bytes.data(), bytes.size());
    CHECK_EQ(size, codes.size());
  }

 private:
  ZSTD_CCtx* compressor_;
  ZSTD_DCtx* decompressor_;
};

/// The sizes of one carve.
struct Sizes {
  double operation = 0.0, chunk_codec = 0.0;
  double each_brick = 0.0, one_frame = 0.0, one_frame_high = 0.0, pieces = 0.0;
  double encode_us = 0.0, compress_us = 0.0;  ///< terrain and pieces
  double apply_us = 0.0, unpack_us = 0.0;
};

struct Totals {
  std::vector<Sizes> carves;
  bool same_terrain = true;

  double median_of(double Sizes::*part) const {
    std::vector<double> values;
    for (const Sizes& each : carves) values.push_back(each.*part);
    return quantile(values, 0.5);
  }
};

size_t frame_bytes(const CarveOperation& carve, uint64_t hash) {
  FrameMessage frame;
  frame.tick = 1;
  frame.operations.emplace_back(carve);
  frame.has_check = true;
  frame.check = static_cast<uint32_t>(hash);
  return encode(ServerMessage(std::move(frame))).size();
}

std::vector<Code> codes_of_bricks(Field& field, const std::vector<BrickCoord>& bricks) {
  std::vector<Code> codes;
  for (const BrickCoord coord : bricks) {
    const Brick& brick = field.brick(coord);
    codes.insert(codes.end(), brick.codes.begin(), brick.codes.end());
  }
  return codes;
}

/// The peer: all changed bricks in one frame, and each piece's codes in one of its own.
void pack(Field& field, const PieceTable& pieces, const Applied& applied, Zstd& zstd, Sizes& sizes) {
  Stopwatch stopwatch;
  const std::vector<uint8_t> bricks = zstd.packed(codes_of_bricks(field, applied.changed), usual_level);
  std::vector<std::vector<uint8_t>> volumes;
  for (const CreatedPiece& created : applied.created)
    volumes.push_back(zstd.packed(pieces.at(created.id)->window.codes, usual_level));
  sizes.compress_us = stopwatch.lap_ms() * 1e3;
  sizes.one_frame = static_cast<double>(bricks.size());
  for (const auto& volume : volumes) sizes.pieces += static_cast<double>(volume.size());
  const std::vector<Code> codes = codes_of_bricks(field, applied.changed);
  sizes.one_frame_high = static_cast<double>(zstd.packed(codes, high_level).size());
  for (size_t at = 0; at < codes.size(); at += brick_voxels)
    sizes.each_brick +=
        static_cast<double>(zstd.packed(std::span(codes).subspan(at, brick_voxels), usual_level).size());

  MapField client(field.source());
  std::vector<Code> read(codes.size());
  stopwatch.lap_ms();
  zstd.unpack(bricks, read);
  for (size_t i = 0; i < applied.changed.size(); ++i) {
    Brick brick;
    std::copy_n(read.begin() + static_cast<ptrdiff_t>(i) * brick_voxels, brick_voxels, brick.codes.begin());
    client.set_brick(applied.changed[i], brick);
  }
  for (size_t i = 0; i < volumes.size(); ++i) {
    std::vector<Code> volume(pieces.at(applied.created[i].id)->window.codes.size());
    zstd.unpack(volumes[i], volume);
  }
  sizes.unpack_us = stopwatch.lap_ms() * 1e3;
  CHECK(client.hash() == field.hash());
}

Totals carve_all(int carves) {
  Totals totals;
  Zstd zstd;
  const TerrainSource terrain;
  ScatteredBlows blows(terrain, 40.0F, radius_m, seeds, 3);
  for (int i = 0; i < carves; ++i) {
    const CarveRequest blow = blows.next();
    const CarveOperation carve{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, 1};
    // A client that looks at the place has its ground already.
    MapField server(terrain), client(terrain);
    for (MapField* field : {&server, &client})
      gather(*field, band_box(in_voxels(blow.shape, terrain.voxel_size_m)).grown(chunk_size));
    PieceTable pieces, seen;
    const Applied applied = apply(carve, server, pieces);
    Sizes sizes;
    Stopwatch stopwatch;
    sizes.operation = static_cast<double>(frame_bytes(carve, server.hash()));
    sizes.encode_us = stopwatch.lap_ms() * 1e3;
    apply(carve, client, seen);
    sizes.apply_us = stopwatch.lap_ms() * 1e3;
    totals.same_terrain =
        totals.same_terrain && client.hash() == server.hash() && seen.size() == pieces.size();
    std::vector<BrickPatch> patches;
    for (const BrickCoord coord : applied.changed) patches.push_back({coord, server.brick(coord)});
    sizes.chunk_codec = static_cast<double>(encode_bricks(std::span<const BrickPatch>(patches)).size());
    pack(server, pieces, applied, zstd, sizes);
    totals.carves.push_back(sizes);
  }
  return totals;
}

void add_run(const Totals& totals, PeerFindings& findings) {
  const auto put = [&](const char* name, const char* label, const char* what, double noise_percent,
                       double ours, double theirs) {
    Comparison& figure = findings.figure(name, what, noise_percent);
    figure.label = label;
    figure.ours.push_back(ours);
    figure.theirs.push_back(theirs);
  };
  const auto median = [&](double Sizes::*part) { return totals.median_of(part); };
  put("carve_bytes", "carve, bytes",
      "a carve and its pieces on the wire, bytes: operation against bricks and pieces", 0.0,
      median(&Sizes::operation), median(&Sizes::one_frame) + median(&Sizes::pieces));
  put("terrain_bytes", "", "the terrain's part alone, bytes: operation against bricks in one frame", 0.0,
      median(&Sizes::operation), median(&Sizes::one_frame));
  put("bricks_bytes", "bricks, bytes",
      "the changed bricks, bytes: Scree's codec against a zstd frame a brick", 0.0,
      median(&Sizes::chunk_codec), median(&Sizes::each_brick));
  put("bricks_level_19_bytes", "",
      "the changed bricks, bytes: Scree's codec (level 3) against zstd's level 19", 0.0,
      median(&Sizes::chunk_codec), median(&Sizes::one_frame_high));
  put("encode_us", "", "the sender's work on a carve and its pieces, µs", 40.0, median(&Sizes::encode_us),
      median(&Sizes::compress_us));
  put("receive_us", "receiving", "the receiver's work, µs: carrying the carve out against unpacking it", 20.0,
      median(&Sizes::apply_us), median(&Sizes::unpack_us));
}

}  // namespace

PeerFindings beside_zstd(const PeerOptions& options) {
  PeerFindings findings;
  findings.peer = "zstd " ZSTD_VERSION_STRING ", bricks";
  findings.name = "zstd";
  const int carves = options.quick ? 5 : 40;
  findings.conditions = {fmt::format(
      "{} balls of 2 m are struck out of fresh hills of 0.25 m voxels, each into 64 pieces; figures are "
      "medians over them. Bricks are 8³ codes of one byte; what is compressed are the bricks that the "
      "carve changed, without their places, and each piece's box of codes. zstd runs at level 3 unless "
      "another one is named, with its contexts kept. Scree's bytes are those of a whole frame with its "
      "tick and its check.",
      carves)};
  findings.conditions.push_back(
      "The operation is small because the receiver computes the carve again, by the same kernels: its work "
      "is the price, and the last row says it. A receiver of bricks gets no masses, seeds or hulls by them.");
  for (int run = 0; run < options.runs; ++run) {
    const Totals totals = carve_all(carves);
    add_run(totals, findings);
    findings.check("same_terrain", totals.same_terrain,
                   "who applied the operation has the hash and the pieces of who sent it");
    options.progress(static_cast<double>(run + 1) / options.runs);
  }
  return findings;
}

}  // namespace scree
