// Materials of a server's world: given as a file, shown and changed by administrators, recorded, kept, and
// refused where they are not those of the world.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "client/admin/admin.h"
#include "content/builtin_palette.h"
#include "crypto/sha256.h"
#include "server/app/live_server.h"
#include "server/app/saved_world.h"
#include "server/app/server_options.h"
#include "server/world/settings.h"
#include "shared/material/rubble.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/png_bytes.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

const std::string materials_token = "a-token-of-some-length";

std::string refusal(const Palette& palette, const SettingValue& setting) {
  MaterialNumbers numbers;
  const auto done = set_material(palette, numbers, setting);
  EXPECT_EQ(done.has_value(), !numbers.empty());
  return done ? "" : done.error().message;
}

// ---- as settings

TEST(MaterialSettings, print_what_they_were_set_to) {
  WorldConfig config;
  for (const auto& [name, value] : {std::pair{"material.rock.strength", "12.5"},
                                    {"material.brick.bearing.pressed", "3000000"},
                                    {"material.snow.look.colour.red", "0.1"},
                                    {"material.glass.sound.damping_s", "0.005"}}) {
    ASSERT_TRUE(set(config, {name, value})) << name;
    EXPECT_EQ(print(config.material_numbers).size(), config.material_numbers.size());
  }
  WorldConfig again;
  ASSERT_TRUE(set_all(again, print(config)));
  EXPECT_EQ(again, config);
  const auto palette = palette_with(config.palette, config.material_numbers);
  EXPECT_EQ(palette->row(*palette->named("brick")).bearing.pressed_pa, 3.0e6F);
  EXPECT_EQ(*palette, *palette_with(config.palette, print(config)));
  ASSERT_TRUE(set(config, {"material.rock.strength", "default"}));
  EXPECT_FALSE(config.material_numbers.contains("rock.strength"));
}

TEST(MaterialSettings, a_mistake_names_row_member_bounds_and_the_nearest_name) {
  const Palette& palette = builtin_palette();
  EXPECT_EQ(refusal(palette, {"material.rock.strength", "12"}), "");
  EXPECT_TRUE(
      holds(refusal(palette, {"material.brik.strength", "12"}), "no material 'brik'; did you mean brick?"));
  EXPECT_TRUE(holds(refusal(palette, {"material.brick.strenght", "12"}), "did you mean strength?"));
  EXPECT_TRUE(holds(refusal(palette, {"material.brick.density", "30000"}),
                    "brick: density 30000 is over 25000 kg/m3"));
  for (const char* value : {"", "much", "nan", "inf", "1e99", "12 ", "-1"})
    EXPECT_TRUE(holds(refusal(palette, {"material.brick.density", value}), "brick: density")) << value;
  EXPECT_TRUE(holds(refusal(palette, {"material.brick", "12"}), "material.ROW.MEMBER"));
  EXPECT_FALSE(refusal(palette, {"material.brick.name", "12"}).empty());
  EXPECT_FALSE(refusal(palette, {"material.brick.breaks", "even"}).empty());
}

TEST(MaterialSettings, that_are_the_palette_s_own_are_not_listed) {
  WorldConfig config;
  const auto own = std::to_string(config.palette->row(*config.palette->named("brick")).strength_m_s);
  ASSERT_TRUE(set(config, {"material.brick.strength", "11.5"}));
  EXPECT_EQ(config.material_numbers.size(), 1U);
  ASSERT_TRUE(set(config, {"material.brick.strength", own}));
  EXPECT_TRUE(config.material_numbers.empty());
}

TEST(MaterialSettings, are_bounded) {
  WorldConfig config;
  size_t set_ones = 0;
  std::string refused;
  for (const std::string_view row : config.palette->names())
    for (const char* member : {"density", "friction", "strength", "seed_density", "bearing.pressed",
                               "bearing.hanging", "bearing.sideways", "bearing.bending", "sound.pitch"}) {
      const std::string value = std::string(member) == "density" ? "2001" : "1.375";
      const auto done = set(config, {"material." + std::string(row) + "." + member, value});
      set_ones += done ? 1 : 0;
      if (!done) refused = done.error().message;
    }
  EXPECT_EQ(set_ones, limits::material_settings_max);
  EXPECT_TRUE(holds(refused, "limits.material_settings_max")) << refused;
  EXPECT_LE(print(config).size(), limits::settings_max);
}

// ---- of a running server

class MaterialSession : public ::testing::Test {
 protected:
  void start() {
    LiveConfig config;
    config.world = flat_world();
    config.net.admin_token = materials_token;
    config.record_path = record_;
    config.world_path = world_;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
    target_.port = server_->port();
    target_.token = materials_token;
    target_.within = std::chrono::seconds(60);
  }

  const TestFolder folder_;
  std::string record_, world_;
  std::unique_ptr<LiveServer> server_;
  AdminServer target_;
};

TEST_F(MaterialSession, numbers_are_shown_changed_and_taken_back) {
  start();
  auto palette = read_materials(target_);
  ASSERT_TRUE(palette) << palette.error().message;
  EXPECT_EQ(*palette, builtin_palette());
  const auto changed =
      change_materials(target_, {{"brick.strength", "12"}, {"brick.bearing.pressed", "3e6"}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(*changed, (SettingValues{{"brick.bearing.pressed", "3000000"}, {"brick.strength", "12"}}));
  palette = read_materials(target_);
  ASSERT_TRUE(palette);
  const MaterialRow& brick = palette->row(*palette->named("brick"));
  EXPECT_EQ(brick.strength_m_s, 12.0F);
  EXPECT_TRUE(holds(material_lines(brick), "bearing.pressed    3e+06 Pa\n")) << material_lines(brick);
  EXPECT_TRUE(holds(material_json(brick), "\"strength\": 12"));
  EXPECT_TRUE(holds(materials_lines(*palette), "brick"));
  EXPECT_TRUE(holds(material_named(*palette, "brik").error().message, "did you mean brick?"));
  const auto wrong = change_materials(target_, {{"brick.strength", "0"}, {"rock.strength", "9"}});
  ASSERT_FALSE(wrong);
  EXPECT_TRUE(holds(wrong.error().message, "brick: strength 0 is below 0.1 m/s")) << wrong.error().message;
  const auto none =
      change_materials(target_, {{"brick.strength", "default"}, {"brick.bearing.pressed", "default"}});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
  EXPECT_EQ(read_materials(target_).value(), builtin_palette());
}

TEST_F(MaterialSession, a_status_has_the_ledger_by_names) {
  start();
  FillRequest fill{box({0.0F, 2.0F, 0.0F}, {1.0F, 1.0F, 1.0F})};
  fill.material = *builtin_palette().named("brick");
  ASSERT_TRUE(server_->push({0, 0, fill}));
  std::string json;
  for (int tries = 0; tries < 20 && !holds(json, "\"brick\""); ++tries) {
    const auto named = read_named_status(target_);
    ASSERT_TRUE(named);
    json = status_json(named->status, named->materials);
  }
  EXPECT_TRUE(holds(json, "\"brick\": {\n")) << json;
}

TEST_F(MaterialSession, changes_are_recorded_kept_and_verified) {
  record_ = folder_ / "a.scree";
  world_ = folder_ / "a.world";
  start();
  ASSERT_TRUE(change_materials(target_, {{"rock.strength", "0.5"}, {"rock.density", "5000"}}));
  CarveRequest carve;
  carve.shape = sphere({0.0F, -0.5F, 0.0F}, 1.5F);
  carve.seeds = 8;
  ASSERT_TRUE(server_->push({0, 0, carve}));
  ASSERT_TRUE(change_materials(target_, {{"rock.friction", "0.1"}}));
  ASSERT_TRUE(server_->stop());
  server_.reset();
  start();  // and both go on
  const auto palette = read_materials(target_);
  ASSERT_TRUE(palette);
  EXPECT_EQ(palette->rows[0].strength_m_s, 0.5F);
  EXPECT_EQ(palette->rows[0].friction, 0.1F);
  ASSERT_TRUE(change_materials(target_, {{"rock.density", "default"}}));
  ASSERT_TRUE(server_->stop());
  expect_verifies(record_);
}

// ---- of a kept world

class KeptMaterials : public ::testing::Test {
 protected:
  Result<std::shared_ptr<const Palette>> open(std::shared_ptr<const Palette> materials) {
    WorldConfig config = flat_world();
    auto kept = TRY(SavedWorld::open(folder_ / "a.world", config, 1, {}, 0, {}, std::move(materials)));
    const auto world = kept->release_world();
    TRY(kept->start(*world, {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}}));
    kept->note(*world->step({}), *world);
    TRY(kept->finish(*world));
    return world->config().palette;
  }
  std::string refused(const Palette& palette) {
    const auto opened = open(std::make_shared<const Palette>(palette));
    return opened ? "" : opened.error().message;
  }

  const TestFolder folder_;
};

TEST_F(KeptMaterials, a_world_goes_on_with_other_numbers_and_more_rows_and_keeps_them) {
  ASSERT_TRUE(open(nullptr));
  Palette other = builtin_palette();
  other.rows[1].strength_m_s = 2.5F;
  other.rows.emplace_back().name = "marble";
  EXPECT_EQ(refused(other), "");
  const auto kept = open(nullptr);
  ASSERT_TRUE(kept);
  const Palette rows = numbered_as(builtin_palette(), *with_rubble(std::make_shared<const Palette>(other)));
  EXPECT_EQ(**kept, rows);
  EXPECT_EQ(rows.rows.back().name, "marble_rubble");
}

TEST_F(KeptMaterials, a_palette_of_another_world_is_refused_and_nothing_is_lost) {
  ASSERT_TRUE(open(nullptr));
  Palette fewer = builtin_palette(), renamed = fewer, moved = fewer, grounded = fewer;
  fewer.rows.pop_back();
  renamed.rows[2].name = "marble";
  std::swap(moved.rows[3], moved.rows[4]);
  grounded.ground.soil_depth_m = 3.0F;
  EXPECT_TRUE(holds(refused(fewer), "materials may be added, but not removed"));
  EXPECT_TRUE(holds(refused(renamed), "marble in the new palette"));
  EXPECT_TRUE(holds(refused(moved), "keep their numbers and names"));
  EXPECT_TRUE(holds(refused(grounded), "another [ground]"));
  const auto kept = open(nullptr);
  ASSERT_TRUE(kept);
  EXPECT_EQ(**kept, builtin_palette());
}

TEST_F(MaterialSession, images_are_shown_with_their_size) {
  auto content = builtin_palette();
  const std::string png = png_bytes(48, 32);
  const std::vector<uint8_t> bytes(png.begin(), png.end());
  const Digest there = sha256(bytes), missing = sha256(std::vector<uint8_t>{1});
  content.rows[7].look.albedo = there;
  content.rows[7].look.normal = missing;
  LiveConfig config;
  config.world = flat_world();
  config.world.palette = config.materials = std::make_shared<const Palette>(content);
  config.images = std::make_shared<const ContentFiles>(ContentFiles{{there, bytes}});
  auto started = LiveServer::start(config);
  ASSERT_TRUE(started) << started.error().message;
  server_ = std::move(*started);
  target_.port = server_->port();
  target_.within = std::chrono::seconds(60);
  const auto images = read_images(target_, content.rows[7]);
  ASSERT_TRUE(images) << images.error().message;
  const std::string lines = material_lines(content.rows[7], *images);
  EXPECT_TRUE(holds(lines, "look.albedo        " + hex_of(there) + ", 48 × 32 pixels, " +
                               std::to_string(bytes.size()) + " bytes\n"))
      << lines;
  EXPECT_TRUE(holds(lines, hex_of(missing) + ", which the server does not have\n")) << lines;
}

// ---- of the command line

class MaterialOptions : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const {
    std::ofstream(folder_ / "m.toml") << text;
    return folder_ / "m.toml";
  }
  static std::string ground_and_rows(size_t rows, const std::string& more = {}) {
    std::string text = "[ground]\nbulk = \"m0\"\nsoil = \"m0\"\ncap = \"m0\"\nsoil_depth_m = 0.5\n";
    for (size_t i = 0; i < rows; ++i) text += "[[material]]\nname = \"m" + std::to_string(i) + "\"\n";
    return text + more;
  }
  static std::variant<ServerOptions, int> parse(const std::string& path) {
    const std::array arguments{"scree-server", "--materials", path.c_str()};
    return parse_server_options(static_cast<int>(arguments.size()), arguments.data());
  }
  static std::string words_of_refusal(const std::string& path) {
    ::testing::internal::CaptureStderr();
    const auto parsed = parse(path);
    const std::string words = ::testing::internal::GetCapturedStderr();
    EXPECT_TRUE(std::holds_alternative<int>(parsed) && std::get<int>(parsed) == 2);
    return words;
  }
  std::string image(uint32_t side) const {
    std::ofstream(folder_ / "image.png", std::ios::binary)
        << (side > 100 ? png_header(side, side) : png_bytes(side, side));
    return ground_and_rows(1, "look.albedo = \"image.png\"\n");
  }

  const TestFolder folder_;
};

TEST_F(MaterialOptions, a_file_gives_the_world_its_palette_ground_and_images) {
  const auto parsed = parse(file(image(1)));
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const LiveConfig& live = std::get<ServerOptions>(parsed).live;
  EXPECT_EQ(live.world.palette->rows.at(0).name, "m0");
  EXPECT_EQ(live.world.terrain.rows, live.world.palette->ground);
  EXPECT_EQ(live.images->size(), 1U);
  EXPECT_TRUE(std::holds_alternative<ServerOptions>(parse(file(ground_and_rows(255)))));
}

TEST_F(MaterialOptions, what_cannot_be_a_palette_is_refused_with_its_file) {
  EXPECT_TRUE(holds(words_of_refusal(folder_ / "none.toml"), "none.toml"));
  EXPECT_TRUE(holds(words_of_refusal(file(ground_and_rows(256))), "255"));
  EXPECT_TRUE(holds(words_of_refusal(file(image(30000))), "30000"));
  EXPECT_TRUE(holds(words_of_refusal(file("nonsense")), "m.toml:1"));
}

}  // namespace
}  // namespace scree
