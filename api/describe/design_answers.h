// JSON Schemas of what a search answers, designs/1: every field that an answer may have.
#ifndef PLENUM_API_DESCRIBE_DESIGN_ANSWERS_H_
#define PLENUM_API_DESCRIBE_DESIGN_ANSWERS_H_

#include "api/json/json.h"

namespace plenum::api {

// Adds the fields of an answer to the schema "Designs", which has what every answer has (schema,
// version, remarks), and the components that it refers to.
void AddDesignAnswers(Json& schemas);

}  // namespace plenum::api

#endif  // PLENUM_API_DESCRIBE_DESIGN_ANSWERS_H_
