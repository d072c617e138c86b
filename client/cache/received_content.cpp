#include "client/cache/received_content.h"

#include <algorithm>

#include "client/cache/limits.h"
#include "crypto/sha256.h"
#include "proto/palette_codec.h"
#include "shared/material/material_image.h"
#include "shared/prop/model_mesh.h"

namespace scree {

ReceivedContent::ReceivedContent(TileFolder folder, bool images)
    : folder_(std::move(folder)), images_(images) {}

void ReceivedContent::begin_session(const std::optional<Digest>& palette) {
  wanted_.clear();
  asked_.clear();
  given_up_.clear();
  fault_.clear();
  models_.clear();
  wanted_palette_.reset();
  if (palette != current_ || model_bytes_ > limits::model_files_memory_max / 2) {  // make room
    held_models_.clear();
    model_bytes_ = 0;
  }
  if (palette != current_) {  // of another world, whose content is in the folder
    held_.clear();
    held_bytes_ = 0;
    current_.reset();
    palette_ = plain_palette();
  }
  if (palette) change_palette(*palette);
}

void ReceivedContent::change_palette(const Digest& palette) {
  if (wanted_palette_ && *wanted_palette_ != palette) {  // what is on its way of that is of no more use
    std::erase(wanted_, *wanted_palette_);
    if (asked_.erase(*wanted_palette_) > 0) given_up_.insert(*wanted_palette_);
    given_up_.erase(palette);
  }
  wanted_palette_ = palette;
  if (current_ == palette)
    want_images();  // which may be missing
  else if (const auto bytes = folder_.read(palette))
    use_palette(*bytes);
  else if (is_new(palette))
    wanted_.push_back(palette);
}

ReceivedContent::Bytes ReceivedContent::find(const Digest& digest) const {
  const auto found = held_.find(digest);
  return found == held_.end() ? nullptr : found->second;
}

ReceivedContent::Bytes ReceivedContent::find_model(const Digest& digest) const {
  const auto found = held_models_.find(digest);
  return found == held_models_.end() ? nullptr : found->second;
}

bool ReceivedContent::is_new(const Digest& digest) const {
  return !asked_.contains(digest) && !given_up_.contains(digest) &&
         std::ranges::find(wanted_, digest) == wanted_.end();
}

/// The folder has palettes, too, and a hostile server names any file of it.
void ReceivedContent::want_image(const Digest& digest) {
  if (held_.contains(digest) || !is_new(digest)) return;
  auto bytes = folder_.read(digest);
  if (!bytes || held_bytes_ + bytes->size() > limits::content_memory_max)
    wanted_.push_back(digest);
  else
    hold_image(digest, std::move(*bytes));
}

void ReceivedContent::want_images() {
  if (!images_) return;
  for (const MaterialRow& row : palette_->rows)
    for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal})
      if (image) want_image(*image);
}

void ReceivedContent::want_model(const Digest& model) {
  if (models_.size() >= limits::models_wanted_max || !models_.insert(model).second) return;
  if (held_models_.contains(model) || !is_new(model)) return;
  auto bytes = folder_.read(model);
  if (bytes && bytes->size() <= limits::model_bytes_max &&
      model_bytes_ + bytes->size() <= limits::model_files_memory_max)
    hold_model(model, std::move(*bytes));
  else
    wanted_.push_back(model);
}

void ReceivedContent::hold_model(const Digest& digest, std::vector<uint8_t> bytes) {
  model_bytes_ += bytes.size();
  held_models_[digest] = std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
}

std::string ReceivedContent::what_is(const Digest& digest) const {
  return digest == wanted_palette_  ? "the server's palette"
         : models_.contains(digest) ? "the model of a prop"
                                    : "an image of the server's palette";
}

bool ReceivedContent::hold_image(const Digest& digest, std::vector<uint8_t> bytes) {
  if (const auto image = check_image(bytes); !image) {
    drop(digest, "an image of the server's palette cannot be used: " + image.error().message);
    return false;
  }
  held_bytes_ += bytes.size();
  held_[digest] = std::make_shared<const std::vector<uint8_t>>(std::move(bytes));
  return true;
}

AskContentMessage ReceivedContent::next_request() {
  AskContentMessage request;
  while (!wanted_.empty() && asked_.size() < limits::contents_asked_max) {
    const Digest digest = wanted_.front();
    wanted_.erase(wanted_.begin());
    asked_[digest];
    request.wanted.push_back(digest);
  }
  return request;
}

/// It counts as if the server had none such.
void ReceivedContent::drop(const Digest& digest, const std::string& fault) {
  fault_ = fault;
  asked_.erase(digest);
  given_up_.insert(digest);
}

/// Empty: the part may be added.
std::string ReceivedContent::fault_of(const ContentMessage& message, const Partial& partial) const {
  if (message.total == 0) return " is not there";
  const bool is_palette = message.digest == wanted_palette_;
  const bool is_model = !is_palette && models_.contains(message.digest);
  const size_t most = is_palette ? palette_bytes_max
                      : is_model ? limits::model_bytes_max
                                 : limits::image_bytes_max;
  const bool fits = is_model ? model_bytes_ + message.total <= limits::model_files_memory_max
                             : held_bytes_ + message.total <= limits::content_memory_max;
  if (message.total > most || !fits) return " has too many bytes: " + std::to_string(message.total);
  if (message.total != partial.total || message.offset != partial.bytes.size())
    return " comes in parts that do not follow one another";
  return {};
}

std::optional<Digest> ReceivedContent::accept(const ContentMessage& message) {
  const Digest& digest = message.digest;
  bytes_received_ += message.part.size();
  const auto asked = asked_.find(digest);
  if (asked == asked_.end()) {
    if (!given_up_.contains(digest)) fault_ = "the server sends content that was not asked for";
    return std::nullopt;
  }
  Partial& partial = asked->second;
  if (message.offset > 0 && partial.bytes.empty()) return std::nullopt;  // of an earlier request
  if (message.offset == 0) partial = {{}, message.total};
  const std::string what = what_is(digest);
  if (const std::string fault = fault_of(message, partial); !fault.empty()) {
    drop(digest, what + fault);
    return std::nullopt;
  }
  partial.bytes.insert(partial.bytes.end(), message.part.begin(), message.part.end());
  if (partial.bytes.size() < partial.total) return std::nullopt;
  std::vector<uint8_t> bytes = std::move(partial.bytes);
  if (sha256(bytes) != digest) {
    drop(digest, what + " does not have the hash that names it");
    return std::nullopt;
  }
  asked_.erase(digest);
  const Digest whole = digest;
  return take(whole, std::move(bytes)) ? std::optional(whole) : std::nullopt;
}

/// What cannot be used is not kept.
bool ReceivedContent::take(const Digest& digest, std::vector<uint8_t> bytes) {
  if (digest == wanted_palette_) {
    if (!use_palette(bytes)) return false;
    folder_.write(digest, bytes);
    return true;
  }
  if (models_.contains(digest)) {
    folder_.write(digest, bytes);
    hold_model(digest, std::move(bytes));
    return true;
  }
  if (!hold_image(digest, std::move(bytes))) return false;
  folder_.write(digest, *held_.at(digest));
  return true;
}

/// The one that is wanted.
bool ReceivedContent::use_palette(std::span<const uint8_t> bytes) {
  auto palette = decode_palette(bytes);
  if (!palette) {
    drop(*wanted_palette_, "the server's palette cannot be used: " + palette.error().message);
    return false;
  }
  palette_ = std::make_shared<const Palette>(std::move(*palette));
  current_ = wanted_palette_;
  want_images();
  return true;
}

}  // namespace scree
