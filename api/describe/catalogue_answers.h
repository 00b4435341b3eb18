// JSON Schemas (2020-12) of what the catalogue answers, and the parameters of its list.
#ifndef PLENUM_API_DESCRIBE_CATALOGUE_ANSWERS_H_
#define PLENUM_API_DESCRIBE_CATALOGUE_ANSWERS_H_

#include "api/json/json.h"

namespace plenum::api {

// By name: PartsPage, Comparison, Import, CatalogCheck. They refer to the schema StoredPart.
Json DescribeCatalogueAnswers();

// Of a query for parts: [{ "name", "in": "query", "schema", "description" }] of every filter.
Json DescribePartFilters();

}  // namespace plenum::api

#endif  // PLENUM_API_DESCRIBE_CATALOGUE_ANSWERS_H_
