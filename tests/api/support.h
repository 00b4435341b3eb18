// What the tests of this room share: the contract's example documents and a catalogue with one part
// of each family.
#ifndef PLENUM_TESTS_API_SUPPORT_H_
#define PLENUM_TESTS_API_SUPPORT_H_

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Documents as the contract shows them, with ids of SmallCatalogue().
std::string RequirementsText();
std::string SimulationText();
std::string MapText();

Json Parse(std::string_view text);  // must be good
inline Json Requirements() { return Parse(RequirementsText()); }
inline Json Simulation() { return Parse(SimulationText()); }
inline Json Map() { return Parse(MapText()); }

// One valid part of each of the nine families, ids "<family>-1".
std::vector<catalog::Part> SmallCatalogue();
// The same and a vacuum pump.
std::vector<catalog::Part> SmallCatalogueWithVacuum();
catalog::Part PartOf(std::string_view family);  // the one of the family

template <typename T>
Errors ErrorsOf(const Parsed<T>& parsed) {
  const Errors* errors = std::get_if<Errors>(&parsed);
  return errors == nullptr ? Errors{} : *errors;
}

// The details of all errors at a pointer, joined by newlines.
std::string DetailAt(const Errors& errors, std::string_view pointer);

// A document with the value at a JSON pointer replaced, added or (null pointer `value`) removed.
Json With(Json document, const std::string& pointer, Json value);
Json Without(Json document, const std::string& pointer);

}  // namespace plenum::api

#endif  // PLENUM_TESTS_API_SUPPORT_H_
