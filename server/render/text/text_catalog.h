// Parts for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_

#include <string>
#include <vector>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"

namespace plenum::server {

// One line a part.
std::string PartsText(const std::vector<catalog::Part>& parts);
// One part with every number, where it comes from, and its curve.
std::string PartText(const catalog::Part& part);

// One line a revision, newest first as given.
std::string RevisionsText(const std::vector<catalog::Revision>& revisions);
// One line a change and one for each field that it changed.
std::string HistoryText(const std::vector<catalog::Change>& changes);

// Numbers that look wrong and fields that are missing.
std::string PlausibilityText(const std::vector<catalog::Outlier>& outliers,
                             const std::vector<catalog::Gap>& gaps);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_
