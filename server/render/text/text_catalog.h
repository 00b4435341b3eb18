// A part, its history and the state of the catalogue for a person.
#ifndef PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_
#define PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_

#include <string>
#include <vector>

#include "api/catalogue/catalog_check.h"
#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/catalogue/table_reading.h"

namespace plenum::server {

// One part with every number, where it comes from, and its curve.
std::string PartText(const catalog::Part& part);

// One line a revision, newest first as given.
std::string RevisionsText(const std::vector<catalog::Revision>& revisions);
// One line a change and one for each field that it changed.
std::string HistoryText(const std::vector<catalog::Change>& changes);

// What a person who tends the catalogue should look at.
std::string CheckText(const api::CatalogCheck& check);

// How a table was understood; empty for one that is read as it was exported.
std::string UnderstoodText(const catalog::TableReading& reading);
// Each question that a table leaves open, with the option that answers it.
std::string QuestionsText(const catalog::TableReading& reading);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RENDER_TEXT_TEXT_CATALOG_H_
