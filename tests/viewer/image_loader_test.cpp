#include "client/viewer/session/image_loader.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

Result<Image> decode(std::span<const uint8_t> bytes) {
  if (bytes.empty()) return fail("nothing to decode");
  return Image{1, 1, {bytes[0], bytes[0], bytes[0]}};
}

ReceivedContent::Bytes file_of(std::vector<uint8_t> bytes) {
  return std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
}

class ImageLoaderTest : public testing::Test {
 protected:
  static constexpr Digest bark{1}, damaged{2};

  ImageLoaderTest() : palette_(*plain_palette()) {
    palette_.rows.front().look.albedo = bark;
    palette_.rows.front().look.normal = damaged;
  }
  bool follow() {
    return loader_.follow(palette_, [&](const Digest& image) {
      const auto found = files_.find(image);
      return found == files_.end() ? nullptr : found->second;
    });
  }
  void work() {
    while (pool_.run_for(1.0)) {
    }
  }

  Palette palette_;
  std::map<Digest, ReceivedContent::Bytes> files_;
  WorkPool pool_{0};
  ImageLoader loader_{pool_, decode};
};

TEST_F(ImageLoaderTest, decodes_what_has_come_and_forgets_what_no_palette_names) {
  EXPECT_FALSE(follow());
  EXPECT_TRUE(loader_.complete());
  files_[bark] = file_of({7});
  files_[damaged] = file_of({});
  EXPECT_FALSE(follow());
  EXPECT_FALSE(loader_.complete());
  work();
  EXPECT_TRUE(follow());
  EXPECT_TRUE(loader_.complete());
  ASSERT_EQ(loader_.texels().size(), 1U) << "the damaged one is left out";
  EXPECT_EQ(loader_.texels().at(bark)->front(), 7);
  EXPECT_FALSE(follow()) << "each is decoded once";
  palette_ = *plain_palette();
  follow();
  EXPECT_TRUE(loader_.texels().empty());
}

}  // namespace
}  // namespace scree
