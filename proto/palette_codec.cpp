#include "proto/palette_codec.h"

#include <algorithm>
#include <material.pb.h>

#include "shared/base/check.h"
#include "shared/material/material_members.h"

namespace scree {

namespace {

// Each kind has its value in material.proto. That the names agree, too, is tested (tests/content).
static_assert(wire::BreakLook_ARRAYSIZE == kind_count<BreakLook>);
static_assert(wire::GrainAxis_ARRAYSIZE == kind_count<GrainAxis>);
static_assert(wire::SurfacePattern_ARRAYSIZE == kind_count<SurfacePattern>);

void write_digest(std::string& to, const std::optional<Digest>& from) {
  if (from) to.assign(from->begin(), from->end());
}

void write_bearing(wire::PaletteBearing& to, const Bearing& from) {
  to.set_pressed(from.pressed_pa);
  to.set_hanging(from.hanging_pa);
  to.set_sideways(from.sideways_pa);
  to.set_bending(from.bending_pa);
}

void write_sound(wire::PaletteSound& to, const MaterialSound& from) {
  to.set_pitch(from.pitch);
  to.set_damping_s(from.damping_s);
  to.set_noise(from.noise);
}

void write_look(wire::PaletteLook& to, const MaterialLook& from) {
  to.set_red(from.colour[0]);
  to.set_green(from.colour[1]);
  to.set_blue(from.colour[2]);
  to.set_variation(from.variation);
  to.set_roughness(from.roughness);
  to.set_pattern(static_cast<wire::SurfacePattern>(from.pattern));
  to.set_pattern_m(from.pattern_m);
  write_digest(*to.mutable_albedo(), from.albedo);
  write_digest(*to.mutable_normal(), from.normal);
  to.set_image_m(from.image_m);
}

void write_row(wire::PaletteRow& to, const MaterialRow& from) {
  to.set_name(from.name);
  to.set_density(from.density_kg_m3);
  to.set_friction(from.friction);
  to.set_restitution(from.restitution);
  to.set_strength(from.strength_m_s);
  to.set_strength_by_size(from.strength_by_size);
  to.set_seed_density(from.seed_density);
  to.set_dent_resistance(from.dent_resistance_j_m3);
  to.set_breaks(static_cast<wire::BreakLook>(from.breaks));
  to.set_axis(static_cast<wire::GrainAxis>(from.axis));
  write_bearing(*to.mutable_bearing(), from.bearing);
  write_sound(*to.mutable_sound(), from.sound);
  write_look(*to.mutable_look(), from.look);
  if (from.rubble) {
    to.mutable_rubble()->set_of(static_cast<uint32_t>(row_number(from.rubble->of)));
    to.mutable_rubble()->set_fill(from.rubble->fill);
  }
  to.set_loose(from.loose);
}

/// A number that no byte holds becomes one that validate() refuses.
uint8_t byte_of(int64_t number) {
  return number < 0 || number > UINT8_MAX ? UINT8_MAX : static_cast<uint8_t>(number);
}

Result<std::optional<Digest>> read_digest(const std::string& from, const char* what) {
  if (from.empty()) return std::nullopt;
  Digest digest;
  if (from.size() != digest.size())
    return fail(std::string(what) + " has " + std::to_string(from.size()) + " bytes, and a digest has " +
                std::to_string(digest.size()));
  std::ranges::copy(from, digest.begin());
  return digest;
}

Bearing read_bearing(const wire::PaletteBearing& from) {
  return {from.pressed(), from.hanging(), from.sideways(), from.bending()};
}

MaterialSound read_sound(const wire::PaletteSound& from) {
  return {from.pitch(), from.damping_s(), from.noise()};
}

Result<MaterialLook> read_look(const wire::PaletteLook& from) {
  MaterialLook look;
  look.colour = {from.red(), from.green(), from.blue()};
  look.variation = from.variation();
  look.roughness = from.roughness();
  look.pattern = static_cast<SurfacePattern>(byte_of(from.pattern()));
  look.pattern_m = from.pattern_m();
  look.albedo = TRY(read_digest(from.albedo(), "look.albedo"));
  look.normal = TRY(read_digest(from.normal(), "look.normal"));
  look.image_m = from.image_m();
  return look;
}

Result<MaterialRow> read_row(const wire::PaletteRow& from) {
  MaterialRow row;
  row.name = from.name();
  row.density_kg_m3 = from.density();
  row.friction = from.friction();
  row.restitution = from.restitution();
  row.strength_m_s = from.strength();
  row.strength_by_size = from.strength_by_size();
  row.seed_density = from.seed_density();
  row.dent_resistance_j_m3 = from.dent_resistance();
  row.breaks = static_cast<BreakLook>(byte_of(from.breaks()));
  row.axis = static_cast<GrainAxis>(byte_of(from.axis()));
  row.bearing = read_bearing(from.bearing());
  row.sound = read_sound(from.sound());
  row.look = TRY(read_look(from.look()));
  if (from.has_rubble())
    row.rubble = RubbleOf{Material{byte_of(from.rubble().of())}, byte_of(from.rubble().fill())};
  row.loose = from.loose();
  return row;
}

/// Equal numbers have equal bytes afterwards: put() knows one zero.
template <typename Owner>
void put_again(std::span<const NumberMember<Owner>> members, Owner& owner) {
  for (const NumberMember<Owner>& member : members) member.put(owner, member.get(owner));
}

GroundRows read_ground(const wire::PaletteGround& from) {
  return {Material{byte_of(from.bulk())}, Material{byte_of(from.soil())}, Material{byte_of(from.cap())},
          from.soil_depth_m(), from.cap_depth_m()};
}

}  // namespace

std::vector<uint8_t> encode_palette(const Palette& palette) {
  wire::Palette message;
  for (const MaterialRow& row : palette.rows) write_row(*message.add_rows(), row);
  wire::PaletteGround& ground = *message.mutable_ground();
  ground.set_bulk(static_cast<uint32_t>(row_number(palette.ground.bulk)));
  ground.set_soil(static_cast<uint32_t>(row_number(palette.ground.soil)));
  ground.set_cap(static_cast<uint32_t>(row_number(palette.ground.cap)));
  ground.set_soil_depth_m(palette.ground.soil_depth_m);
  ground.set_cap_depth_m(palette.ground.cap_depth_m);
  std::vector<uint8_t> bytes(message.ByteSizeLong());
  CHECK(message.SerializeToArray(bytes.data(), static_cast<int>(bytes.size())));
  return bytes;
}

Result<Palette> decode_palette(std::span<const uint8_t> bytes) {
  if (bytes.size() > palette_bytes_max)
    return fail("the palette has " + std::to_string(bytes.size()) + " bytes, over the limit of " +
                std::to_string(palette_bytes_max));
  wire::Palette message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return fail("the palette is cut short or damaged");
  if (message.rows_size() > static_cast<int>(materials_max))
    return fail("the palette: " + std::to_string(message.rows_size()) + " materials are over the limit of " +
                std::to_string(materials_max));
  Palette palette;
  for (const wire::PaletteRow& from : message.rows()) {
    const Result<MaterialRow> row = read_row(from);
    if (!row)
      return fail("the palette: material " + std::to_string(palette.rows.size()) + ": " +
                  row.error().message);
    put_again(material_numbers(), palette.rows.emplace_back(*row));
  }
  palette.ground = read_ground(message.ground());
  put_again(ground_numbers(), palette.ground);
  if (const auto valid = validate(palette); !valid) return fail("the palette: " + valid.error().message);
  return palette;
}

}  // namespace scree
