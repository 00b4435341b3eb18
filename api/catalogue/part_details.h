// What a part of any family may carry beside its fields: series, aliases, offers, documents, and
// whether it can be ordered.
#ifndef PLENUM_API_CATALOGUE_PART_DETAILS_H_
#define PLENUM_API_CATALOGUE_PART_DETAILS_H_

#include <cstddef>
#include <string_view>

#include "api/json/json.h"
#include "api/json/reader.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Text that may be empty, missing or null, of at most `longest` characters.
std::string ReadFreeText(Reader& reader, std::string_view name, std::size_t longest);

void ReadDetails(Reader& reader, catalog::Part& part);
// Adds { series, orderable (null: not known), aliases, offers, documents }.
void RenderDetails(const catalog::Part& part, Json& document);
// The JSON schemas of these fields, by name.
Json DetailForms();

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_DETAILS_H_
