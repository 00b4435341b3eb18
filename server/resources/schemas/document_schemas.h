// Schemas of the documents of parts and their files.
#ifndef PLENUM_SERVER_RESOURCES_SCHEMAS_DOCUMENT_SCHEMAS_H_
#define PLENUM_SERVER_RESOURCES_SCHEMAS_DOCUMENT_SCHEMAS_H_

#include "api/json/json.h"

namespace plenum::server {

// By name: DocumentOfPart, Documents.
api::Json DocumentSchemas();
// The body of a request that brings a file.
api::Json DocumentBody();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SCHEMAS_DOCUMENT_SCHEMAS_H_
