// What a client keeps of a world: bounded, in files that may be damaged in any way, and never wrong.
#include "client/cache/chunk_cache.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "client/cache/cache_folder.h"
#include "client/cache/limits.h"
#include "client/cache/tile_folder.h"
#include "crypto/sha256.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"
#include "tests/support/test_folder.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr size_t plenty = size_t{1} << 24U;
constexpr uint64_t a_world = 0x0123456789ABCDEFULL;
constexpr const char* a_server = "127.0.0.1:4177";

/// A field with edits, one of them painted, and a cache that has them.
struct Carved {
  TickSource source{flat_terrain};
  ChunkCache cache{plenty};

  Carved() {
    source.step({source.carve({1.0F, -0.5F, 1.0F}, 1.5F, 4), source.carve({12.0F, 0.0F, 1.0F}, 1.0F, 1),
                 source.carve({40.0F, 0.0F, 1.0F}, 1.0F, 1)});
    source.field().set_materials(source.field().edited_bricks(chunks().front()).front(),
                                 all_of(material::ice));
    store();
  }
  void store() {
    for (const ChunkCoord chunk : chunks()) cache.store(source.field(), chunk);
  }
  std::vector<ChunkCoord> chunks() { return source.field().edited_chunks(); }
};

uint64_t hash_of(const std::vector<BrickPatch>& bricks) {
  uint64_t hash = 0;
  for (const BrickPatch& patch : bricks) hash += brick_hash(patch.coord, patch.brick, patch.materials);
  return hash;
}

/// Every chunk that the cache hands out is the field's.
size_t expect_right_or_nothing(ChunkCache& cache, Field& field) {
  const OfferMessage offer = cache.offer({}, 1000.0F, voxel_m);
  for (size_t i = 0; i < offer.chunks.size(); ++i) {
    EXPECT_EQ(offer.hashes[i], short_hash(field.chunk_hash(offer.chunks[i])));
    EXPECT_EQ(hash_of(cache.find(offer.chunks[i])), field.chunk_hash(offer.chunks[i]));
  }
  return offer.chunks.size();
}

TEST(ChunkCache, hands_out_what_it_was_given_and_knows_what_it_has_already) {
  Carved carved;
  EXPECT_EQ(expect_right_or_nothing(carved.cache, carved.source.field()), carved.chunks().size());
  EXPECT_FALSE(carved.cache.store(carved.source.field(), carved.chunks().front()));
  EXPECT_FALSE(carved.cache.store(carved.source.field(), {100, 100, 100})) << "no edits there";
  carved.source.step({carved.source.carve({1.0F, -1.0F, 1.0F}, 2.0F, 1)});
  carved.store();
  EXPECT_EQ(expect_right_or_nothing(carved.cache, carved.source.field()), carved.chunks().size());
}

TEST(ChunkCache, offers_what_is_near_and_not_held_in_order) {
  Carved carved;
  const OfferMessage near = carved.cache.offer({1.0F, 0.0F, 1.0F}, 6.0F, voxel_m);
  EXPECT_GT(near.chunks.size(), 0U);
  EXPECT_LT(near.chunks.size(), carved.chunks().size());
  EXPECT_TRUE(std::ranges::is_sorted(near.chunks));
  const OfferMessage rest =
      carved.cache.offer({1.0F, 0.0F, 1.0F}, 1000.0F, voxel_m, {near.chunks.begin(), near.chunks.end()});
  EXPECT_EQ(rest.chunks.size() + near.chunks.size(), carved.chunks().size());
}

TEST(ChunkCache, drops_what_was_used_longest_ago_above_its_bound) {
  Carved carved;
  const std::vector<CachedChunk> all = carved.cache.all();
  ASSERT_GE(all.size(), 3U);
  const ChunkCoord oldest = all.front().chunk, next = all[1].chunk;
  ChunkCache small(carved.cache.bytes());
  small.load(all);
  EXPECT_FALSE(small.find(oldest).empty());  // used now
  carved.source.step({carved.source.carve({-100.0F, 0.0F, 1.0F}, 1.0F, 1)});
  ASSERT_TRUE(small.store(carved.source.field(), carved.chunks().front()));
  EXPECT_LE(small.bytes(), carved.cache.bytes());
  EXPECT_TRUE(small.find(next).empty());
  EXPECT_FALSE(small.find(oldest).empty());
  ChunkCache none(0);
  none.load(all);
  EXPECT_EQ(none.chunks(), 0U);
}

TEST(ChunkCache, bricks_without_their_hash_or_of_another_chunk_are_dropped) {
  Carved carved;
  std::vector<CachedChunk> all = carved.cache.all();
  std::swap(all[0].bricks, all[1].bricks);
  all[2].hash += 1;
  ChunkCache cache(plenty);
  cache.load(all);
  EXPECT_TRUE(cache.find(all[0].chunk).empty());
  EXPECT_EQ(expect_right_or_nothing(cache, carved.source.field()), all.size() - 3);
  EXPECT_EQ(cache.chunks(), all.size() - 3);
}

class CacheFolderTest : public ::testing::Test {
 protected:
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder / "cache")) found.push_back(entry.path());
    return found;
  }
  std::vector<char> content(const fs::path& file) const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const fs::path& file, const std::vector<char>& bytes) const {
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  /// What is offered of the file as it is now.
  size_t expect_harmless() {
    const auto cached = in.read(a_server, std::nullopt);
    ChunkCache cache(plenty);
    if (cached) cache.load(cached->chunks);
    return expect_right_or_nothing(cache, carved.source.field());
  }

  const TestFolder folder;
  Carved carved;
  CacheFolder in{folder / "cache", plenty};
};

TEST_F(CacheFolderTest, what_is_written_is_read_by_world_or_as_the_last_of_an_address) {
  EXPECT_FALSE(in.read(a_server, std::nullopt));
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  ASSERT_EQ(files().size(), 1U);
  const auto last = in.read(a_server, std::nullopt);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->world, a_world);
  EXPECT_EQ(last->voxel_size_m, voxel_m);
  EXPECT_EQ(last->chunks.size(), carved.chunks().size());
  EXPECT_TRUE(in.read(a_server, a_world));
  EXPECT_FALSE(in.read(a_server, a_world + 1));
  EXPECT_FALSE(in.read("127.0.0.1:4178", std::nullopt)) << "another server's";
  EXPECT_EQ(expect_harmless(), carved.chunks().size());
}

TEST_F(CacheFolderTest, a_file_cut_short_anywhere_gives_what_is_right_of_it) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const fs::path file = files().front();
  const std::vector<char> whole = content(file);
  size_t most = 0;
  for (size_t size = 0; size < whole.size(); size += 1 + size / 24) {
    put(file, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    const size_t offered = expect_harmless();
    EXPECT_GE(offered, most);
    most = offered;
  }
  EXPECT_GT(most, 0U);
  EXPECT_LT(most, carved.chunks().size());
}

TEST_F(CacheFolderTest, a_wrong_byte_anywhere_never_gives_a_wrong_chunk) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const fs::path file = files().front();
  const std::vector<char> whole = content(file);
  for (size_t at = 0; at < whole.size(); at += 1 + at / 24) {
    for (const char flip : {'\x01', '\x80'}) {
      std::vector<char> damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      put(file, damaged);
      expect_harmless();
    }
  }
}

TEST_F(CacheFolderTest, a_file_of_another_world_under_this_ones_name_is_none) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const fs::path ours = files().front();
  in.write(a_server, {a_world + 1, voxel_m, carved.cache.all()});
  for (const fs::path& file : files())
    if (file != ours) fs::rename(file, ours);
  EXPECT_FALSE(in.read(a_server, a_world));
}

TEST_F(CacheFolderTest, a_file_larger_than_the_bound_is_not_read) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const uintmax_t bytes = fs::file_size(files().front());
  EXPECT_TRUE(CacheFolder(folder / "cache", bytes).read(a_server, a_world));
  EXPECT_FALSE(CacheFolder(folder / "cache", bytes - 1).read(a_server, a_world));
}

TEST_F(CacheFolderTest, all_files_are_bounded_and_the_ones_written_longest_ago_go_first) {
  const CachedWorld cached{a_world, voxel_m, carved.cache.all()};
  in.write("a:1", cached);
  const uintmax_t bytes = fs::file_size(files().front());
  fs::last_write_time(files().front(), fs::file_time_type::clock::now() - std::chrono::hours(2));
  in.write("b:1", cached);
  put(folder / "cache/thesis.chunks", std::vector<char>(4 * bytes));
  const CacheFolder narrow(folder / "cache", 2 * bytes + bytes / 2);
  narrow.write("c:1", cached);
  EXPECT_FALSE(narrow.read("a:1", std::nullopt));
  EXPECT_TRUE(narrow.read("b:1", std::nullopt));
  EXPECT_TRUE(narrow.read("c:1", std::nullopt));
  EXPECT_TRUE(fs::exists(folder / "cache/thesis.chunks")) << "another's file";
}

TEST_F(CacheFolderTest, tiles_of_grounds_and_chunks_are_bounded_together_by_their_age) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const fs::path chunks = files().front();
  const TileFolder tiles(folder / "cache");
  const auto older = [](const fs::path& file, int hours) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  std::vector<Digest> digests;
  for (uint8_t i = 0; i < 3; ++i) {
    const std::vector<uint8_t> bytes(100, i);
    digests.push_back(sha256(bytes));
    tiles.write(digests.back(), bytes);
    older(folder / ("cache/" + hex_of(digests.back()) + tile_extension), 4 - i);
  }
  older(chunks, 1);
  ASSERT_TRUE(tiles.read(digests[0])) << "the first is used now";
  CacheFolder(folder / "cache", fs::file_size(chunks) + 250).bound();
  EXPECT_TRUE(tiles.read(digests[0]));
  EXPECT_FALSE(tiles.read(digests[1])) << "it is the oldest";
  EXPECT_TRUE(tiles.read(digests[2]));
  EXPECT_TRUE(fs::exists(chunks));
}

TEST_F(CacheFolderTest, a_file_that_was_never_finished_is_not_read_and_goes_in_time) {
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  const fs::path dead = files().front().string() + ".1.2.unfinished";
  put(dead, {'x'});
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  EXPECT_TRUE(fs::exists(dead)) << "another client may be writing it";
  fs::last_write_time(dead, fs::file_time_type::clock::now() - std::chrono::hours(2));
  in.write(a_server, {a_world, voxel_m, carved.cache.all()});
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_EQ(expect_harmless(), carved.chunks().size());
}

TEST_F(CacheFolderTest, a_folder_that_cannot_be_written_is_as_none) {
  put(folder / "file", {'x'});
  const CacheFolder nowhere(folder / "file", plenty);
  nowhere.write(a_server, {a_world, voxel_m, carved.cache.all()});
  EXPECT_FALSE(nowhere.read(a_server, std::nullopt));
}

}  // namespace
}  // namespace scree
