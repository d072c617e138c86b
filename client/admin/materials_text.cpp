#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/near_name.h"
#include "shared/material/material_members.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t mistyped_max = 2;

/// As many digits as a float has: 0.7, not 0.699999988.
std::string number_text(float number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", static_cast<double>(number));
  return text;
}

struct RowImage {
  const char* name;
  std::optional<Digest> digest;
};
std::array<RowImage, 2> images_of(const MaterialRow& row) {
  return {{{"look.albedo", row.look.albedo}, {"look.normal", row.look.normal}}};
}

void add_images(Json& json, const MaterialRow& row, const ImageFactsOf& images) {
  for (const RowImage& image : images_of(row)) {
    if (!image.digest) continue;
    const std::string name = image.name;
    json[name] = hex_of(*image.digest);
    const auto facts = images.find(*image.digest);
    if (facts == images.end()) continue;
    json[name + ".bytes"] = facts->second.bytes;
    json[name + ".pixels"] = {facts->second.size.width, facts->second.size.height};
  }
}

std::string image_words(const Digest& digest, const ImageFactsOf& images) {
  const auto facts = images.find(digest);
  if (facts == images.end()) return hex_of(digest);
  const auto& [bytes, size] = facts->second;
  if (bytes == 0) return hex_of(digest) + ", which the server does not have";
  return hex_of(digest) + ", " + std::to_string(size.width) + " × " + std::to_string(size.height) +
         " pixels, " + std::to_string(bytes) + " bytes";
}

Json json_of(const MaterialRow& row, const ImageFactsOf& images = {}) {
  Json json{{"name", row.name}};
  for (const MaterialNumber& member : material_numbers())
    json[std::string(member.name)] = Json::parse(number_text(member.get(row)));
  for (const MaterialChoice& choice : material_choices())
    json[std::string(choice.name)] = choice.values[choice.get(row)];
  add_images(json, row, images);
  return json;
}

std::string member_line(const std::string& name, const std::string& value, std::string_view unit = {}) {
  char text[200];
  std::snprintf(text, sizeof text, "%-18s %s%s%.*s\n", name.c_str(), value.c_str(), unit.empty() ? "" : " ",
                static_cast<int>(unit.size()), unit.data());
  return text;
}

}  // namespace

std::string materials_lines(const Palette& palette) {
  char text[160];
  std::snprintf(text, sizeof text, "%3s  %-32s %9s %9s %9s %15s\n", "row", "name", "density", "friction",
                "strength", "bearing.pressed");
  std::string lines = text;
  for (size_t i = 0; i < palette.rows.size(); ++i) {
    const MaterialRow& row = palette.rows[i];
    std::snprintf(text, sizeof text, "%3zu  %-32s %9s %9s %9s %15s\n", i, row.name.c_str(),
                  number_text(row.density_kg_m3).c_str(), number_text(row.friction).c_str(),
                  number_text(row.strength_m_s).c_str(), number_text(row.bearing.pressed_pa).c_str());
    lines += text;
  }
  return lines;
}

std::string materials_json(const Palette& palette) {
  Json list = Json::array();
  for (const MaterialRow& row : palette.rows) list.push_back(json_of(row));
  return list.dump(2) + "\n";
}

std::string material_lines(const MaterialRow& row, const ImageFactsOf& images) {
  std::string lines = member_line("name", row.name);
  for (const MaterialNumber& member : material_numbers())
    lines += member_line(std::string(member.name), number_text(member.get(row)), member.unit);
  for (const MaterialChoice& choice : material_choices())
    lines += member_line(std::string(choice.name), std::string(choice.values[choice.get(row)]));
  for (const RowImage& image : images_of(row))
    if (image.digest) lines += member_line(image.name, image_words(*image.digest, images));
  return lines;
}

std::string material_json(const MaterialRow& row, const ImageFactsOf& images) {
  return json_of(row, images).dump(2) + "\n";
}

Result<Material> material_named(const Palette& palette, const std::string& name) {
  if (const auto material = palette.named(name)) return *material;
  const std::vector<std::string_view> names = palette.names();
  return fail("this world has no material '" + name + "'" +
              did_you_mean(name, std::vector<std::string>(names.begin(), names.end()), mistyped_max) +
              "; scree admin materials show lists all");
}

}  // namespace scree
