// Documents that break exactly what a schema demands, each with the place of the fault.
#ifndef PLENUM_TESTS_SERVER_ENEMY_H_
#define PLENUM_TESTS_SERVER_ENEMY_H_

#include <random>
#include <string>
#include <vector>

#include "api/json/json.h"

namespace plenum::server {

struct BadDocument {
  std::string text;
  std::string pointer;  // where an error must be reported
};

// Of a schema: what stands under a name, null if nothing does; the type, the first of several.
const api::Json& In(const api::Json& form, const std::string& name);
std::string TypeOf(const api::Json& form);

// A document with every field of the schema; where it may have one of several forms or values, the
// one of that turn.
api::Json FullDocument(const api::Json& schema, unsigned turn);

// For every place of `document`: values of the wrong kind, numbers out of range, texts too long,
// lists too short and too long, missing fields and unknown ones. `schema` has no references.
std::vector<BadDocument> BadDocuments(const api::Json& schema, const api::Json& document,
                                      std::mt19937& random);

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_ENEMY_H_
