// Pieces of the schemas in the OpenAPI description.
#ifndef PLENUM_SERVER_RESOURCES_SCHEMAS_SCHEMA_FORMS_H_
#define PLENUM_SERVER_RESOURCES_SCHEMAS_SCHEMA_FORMS_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// Of "schemas" or "parameters" in the components.
api::Json Ref(const std::string& kind, const std::string& name);
// All of its properties required.
api::Json Object(const api::Json& properties);
api::Json ListOf(const api::Json& items);
api::Json NamedListOf(const std::string& name, const api::Json& items);
// An answer with its schema, the program's version and what it says of its request.
api::Json Versioned(const char* schema);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SCHEMAS_SCHEMA_FORMS_H_
