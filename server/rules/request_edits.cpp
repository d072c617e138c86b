// Requests that edit terrain.
#include "server/rules/request_fields.h"
#include "server/rules/request_table.h"

namespace scree {

namespace {

/// Where pieces fly towards, as usual: the top of the shape.
glm::vec3 top_of(const Shape& shape) {
  return centre_of(shape) + glm::vec3(0.0F, reach_of(shape), 0.0F);
}

Result<void> finish_carve(void* of, const GivenFields& given, const RulesMoment& moment) {
  auto& carve = *static_cast<CarveRequest*>(of);
  TRY(validate(carve.shape));
  if (!given.has("impact")) carve.impact_m = top_of(carve.shape);
  if (!given.has("seed")) carve.random_seed = random_seed_of(moment);
  return {};
}

template <typename Edit>
Result<void> check_shape(void* of, const GivenFields&, const RulesMoment&) {
  return validate(static_cast<const Edit*>(of)->shape);
}

Result<void> finish_blast(void* of, const GivenFields& given, const RulesMoment& moment) {
  if (!given.has("seed")) static_cast<BlastRequest*>(of)->random_seed = random_seed_of(moment);
  return {};
}

template <typename Edit>
Result<void> finish_store(void* of, const GivenFields& given, const RulesMoment&) {
  auto& edit = *static_cast<Edit*>(of);
  TRY(validate(edit.shape));
  if (!given.has("store")) edit.store = worlds_store();  // a script has none of its own
  return {};
}

constexpr std::string_view seed_words = "of the random numbers; as usual one of the tick's";

constexpr auto carve_rows =
    joined(shape_fields<&CarveRequest::shape>(),
           std::array{
               field<&CarveRequest::seeds>("pieces", "into about so many it breaks; 32 as usual"),
               field<&CarveRequest::pattern>("pattern",
                                             "how it breaks: natural (as usual), uniform, radial, even, …"),
               field<&CarveRequest::blast_speed_m_s>("speed", "by which pieces fly out, m/s; 6 as usual"),
               field<&CarveRequest::impact_m>(
                   "impact", "place of the blow, towards which pieces fly; as usual the shape's top"),
               field<&CarveRequest::random_seed>("seed", seed_words),
               field<&CarveRequest::authored_m>("points", "of the pattern authored: one for each piece"),
               body_field<&CarveRequest::piece>("body", "the piece that is carved; as usual the terrain is"),
           });

constexpr auto fill_rows =
    joined(shape_fields<&FillRequest::shape>(),
           std::array{field<&FillRequest::material>("material", "as usual that of the rock beside it")});

constexpr auto paint_rows =
    joined(shape_fields<&PaintRequest::shape>(),
           std::array{needed(field<&PaintRequest::material>("material", "what the rock in it becomes"))});

constexpr auto cut_out_rows = shape_fields<&CutOutRequest::shape>();

constexpr std::array blast_rows{
    needed(field<&BlastRequest::centre_m>("at", "its centre")),
    field<&BlastRequest::energy_j>("energy", "joules; a kilogram of TNT, 4.2e6, as usual"),
    field<&BlastRequest::random_seed>("seed", seed_words),
};

constexpr auto dig_rows =
    joined(shape_fields<&DigRequest::shape>(),
           std::array{field<&DigRequest::store>("store", "into which; the world's as usual"),
                      body_field<&DigRequest::piece>("body", "the piece that is taken, whole")});

constexpr auto place_rows =
    joined(shape_fields<&PlaceRequest::shape>(),
           std::array{needed(field<&PlaceRequest::material>("material", "that the store has")),
                      field<&PlaceRequest::solid>("solid", "else it is rubble, where the material has any"),
                      field<&PlaceRequest::store>("store", "out of which; the world's as usual")});

constexpr std::array transfer_rows{
    needed(field<&TransferRequest::from>("from", "the store that gives")),
    needed(field<&TransferRequest::to>("to", "the store that gets")),
    field<&TransferRequest::material>("material", "as usual all that it has"),
    field_by<VolumeCodec, &TransferRequest::mass>("volume", "m³ of the material; as usual as much as it has"),
};

}  // namespace

constexpr FieldTable carve_fields{"carve", "a carve", "Breaks a shape out of the terrain, or out of a piece.",
                                  carve_rows, finish_carve};
constexpr FieldTable fill_fields{"fill", "a fill", "Fills a shape with rock.", fill_rows,
                                 check_shape<FillRequest>};
constexpr FieldTable paint_fields{"paint", "a paint", "Changes the material of the rock in a shape.",
                                  paint_rows, check_shape<PaintRequest>};
constexpr FieldTable cut_out_fields{
    "cut_out", "a cut_out",
    "Cuts a shape out of the terrain as a body that never becomes terrain, until it is released.",
    cut_out_rows, check_shape<CutOutRequest>};
constexpr FieldTable blast_fields{"blast", "a blast", "Sets energy free: rock breaks and is thrown.",
                                  blast_rows, finish_blast};
constexpr FieldTable dig_fields{"dig", "a dig",
                                "Takes the terrain in a shape into a store, or a piece, whole.", dig_rows,
                                finish_store<DigRequest>};
constexpr FieldTable place_fields{"place", "a place", "Fills a shape out of a store.", place_rows,
                                  finish_store<PlaceRequest>};
constexpr FieldTable transfer_fields{"transfer", "a transfer", "Moves rock from a store to another.",
                                     transfer_rows, nullptr};

}  // namespace scree
