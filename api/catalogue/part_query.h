// Which parts a list holds, in which order, and the page of it that is asked for.
//
//   q=mhe2 m5  family=valve  mass_kg_min=0.01  mass_kg_max=0.1  port=M5  sort=-mass_kg  limit=20
//   cursor=…
//   cursor=…
//
// Every number field F has F_min and F_max (inclusive, in the unit of its name) and F itself
// (equal); every text field, manufacturer, part_number, origin, series and orderable (true, false)
// match exactly. So do two flags that every part has: `priced`, and `documented` (a document is
// named); and datasheet_share, … estimated_share filter like numbers: the share of a part's numbers
// and texts that has this provenance. A part without the field does not match. `q` finds words in
// all texts (part_search.h). `sort` takes any of these fields, id or match, "-" before it turns the
// order round; parts without the field come last, equal ones in order of id. `match`, the order of
// a search that names none, has parts first whose names hold all words. `facets=true` adds what the
// matching parts hold (part_facets.h).
#ifndef PLENUM_API_CATALOGUE_PART_QUERY_H_
#define PLENUM_API_CATALOGUE_PART_QUERY_H_

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/catalogue/part_table.h"
#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "catalog/store/revision.h"

namespace plenum::api {

inline constexpr std::size_t kSearchBytesMax = 500;

struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// Where a page begins: after part `id` of the list as it was in a revision, so that pages neither
// repeat nor miss a part whatever is written meanwhile.
struct Cursor {
  std::int64_t revision = 0;
  std::string id;
};

struct PartQuery {
  std::map<std::string, NumberRange> numbers;  // by field
  std::map<std::string, std::string> texts;    // by field, family among them
  std::string search;                          // empty: none
  std::string sort = "id";
  bool descending = false;
  bool facets = false;
  int limit = 100;                       // 1…1000
  std::optional<Cursor> cursor;          // written "revision.id"; empty: from the beginning
  std::optional<std::int64_t> revision;  // asked for, else of the cursor, else the newest
};

// Names and values of a URL's query, decoded. Errors point to "/name".
Parsed<PartQuery> ParsePartQuery(const std::multimap<std::string, std::string>& query);

// The matching parts, in order.
std::vector<const catalog::Part*> Select(const PartQuery& query, const PartTable& table);

// What all of them hold: part_facets.h.
Json FacetsOf(const PartQuery& query, const PartTable& table);

// Names that a list of parts can show: id, the texts and numbers of a family (of all without one),
// and documents. Errors name the nearest known one.
Errors CheckColumns(const std::vector<std::string>& columns,
                    const std::optional<std::string>& family);

// { "parts", "next_cursor": text or null, "total": matching parts, "facets" if asked for,
// "catalogue_revision" } as text: for a thousand parts a tree takes twice the time. The table is of
// the parts of `revision`. An error if the cursor is not of this query.
Parsed<std::string> RenderPage(const PartQuery& query, const catalog::Revision& revision,
                               const PartTable& table);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_QUERY_H_
