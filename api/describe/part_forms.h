// The JSON Schema of a part, made of the table of its family's fields.
#ifndef PLENUM_API_DESCRIBE_PART_FORMS_H_
#define PLENUM_API_DESCRIBE_PART_FORMS_H_

#include "api/json/json.h"
#include "catalog/fields/fields.h"

namespace plenum::api {

Json PartForm(const catalog::Family& family);

}  // namespace plenum::api

#endif  // PLENUM_API_DESCRIBE_PART_FORMS_H_
