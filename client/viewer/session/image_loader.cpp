#include "client/viewer/session/image_loader.h"

#include <mutex>
#include <utility>
#include <vector>

#include "client/render/scene/limits.h"

namespace scree {

struct ImageLoader::Inbox {
  struct Done {
    Digest image;
    std::shared_ptr<const MaterialTexels> texels;  ///< null: it cannot be decoded
  };
  std::mutex mutex;
  std::vector<Done> done;
};

ImageLoader::ImageLoader(WorkPool& pool, DecodeImage decode)
    : pool_(pool), decode_(decode), inbox_(std::make_shared<Inbox>()) {}

ImageLoader::~ImageLoader() = default;

/// Images of an earlier palette.
void ImageLoader::forget_others(const Palette& palette) {
  if (begun_.empty() || waiting_ != 0) return;
  std::set<Digest> named;
  for (const MaterialRow& row : palette.rows)
    for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal})
      if (image) named.insert(*image);
  std::erase_if(begun_, [&](const Digest& image) { return !named.contains(image); });
  std::erase_if(texels_, [&](const auto& each) { return !named.contains(each.first); });
}

void ImageLoader::begin(const Digest& image, const ReceivedContent::Bytes& file) {
  begun_.insert(image);
  ++waiting_;
  pool_.submit(WorkPool::Urgency::load, [inbox = inbox_, decode = decode_, image, file] {
    Inbox::Done done{image, nullptr};
    if (const Result<Image> decoded = decode(*file))
      done.texels =
          std::make_shared<const MaterialTexels>(resampled(decoded->rgb, decoded->width, decoded->height));
    const std::lock_guard lock(inbox->mutex);
    inbox->done.push_back(std::move(done));
  });
}

bool ImageLoader::follow(const Palette& palette, const Find& find) {
  if (decode_ == nullptr) return false;
  forget_others(palette);
  for (const MaterialRow& row : palette.rows)
    for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal}) {
      if (!image || begun_.size() >= limits::material_images_max || begun_.contains(*image)) continue;
      if (const ReceivedContent::Bytes file = find(*image)) begin(*image, file);
    }
  if (waiting_ == 0) return false;
  std::vector<Inbox::Done> done;
  {
    const std::lock_guard lock(inbox_->mutex);
    std::swap(done, inbox_->done);
  }
  bool is_new = false;
  for (Inbox::Done& each : done) {
    --waiting_;
    if (each.texels == nullptr) continue;
    texels_[each.image] = std::move(each.texels);
    is_new = true;
  }
  return is_new;
}

}  // namespace scree
