// Lists of parts for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_PARTS_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_PARTS_H_

#include <string>
#include <vector>

#include "api/catalogue/part_document.h"
#include "api/json/json.h"

namespace plenum::server {

// One line a part, with mass and conductance or the fields that `columns` names; "~" stands before
// what is estimated.
std::string PartsText(const std::vector<catalog::Part>& parts,
                      const std::vector<std::string>& columns = {});
// Of api::FacetsOf: the most frequent values of each text, the range of each number.
std::string FacetsText(const api::Json& facets);
// Of api::RenderComparison: a line a field, "≠" before those that differ.
std::string ComparisonText(const api::Json& comparison);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_PARTS_H_
