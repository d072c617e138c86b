#include "server/rules/api/query_fields.h"

#include "server/rules/field_of.h"
#include "shared/query/query.h"

namespace scree {

namespace {

constexpr FieldRow except_row() {
  FieldRow row =
      field_by<ListCodec<BodyCodec>, &QueryMask::except>("except", "bodies that are left out, 64 at most");
  row.type = "body[]";
  return row;
}

constexpr std::array mask_rows{
    field<&QueryMask::terrain>("terrain", "whether it counts; as usual all do"),
    field<&QueryMask::pieces>("pieces", "likewise"),
    field<&QueryMask::bodies>("props", "likewise; persons' bodies are among them"),
    field<&QueryMask::groups>("groups", "bits: props that have any of these"),
    except_row(),
};

}  // namespace

constexpr FieldTable mask_fields{"mask", "a mask", "What a question is about.", mask_rows};

}  // namespace scree
