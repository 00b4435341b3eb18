// The words that headings are made of.
#ifndef PLENUM_CATALOG_TABLES_HEADING_WORDS_H_
#define PLENUM_CATALOG_TABLES_HEADING_WORDS_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/units/printed_flow.h"

namespace plenum::catalog {

// Lower case, in ASCII where German and French letters allow; anything but letters and digits is a
// blank. "Außen-Ø" becomes "aussen diameter".
std::string PlainWords(std::string_view text);

// The words of a heading in those of field names, sorted: "Max. Betriebsdruck" gives "max",
// "pressure". Words that say nothing here are left out. Some say what they say in the tables of one
// family alone: the bore of a tube is its inner diameter, that of a valve its orifice.
std::vector<std::string> FieldWords(std::string_view family, std::string_view heading);
// The same beside a unit: "ID" is an inner diameter in "ID (mm)".
std::vector<std::string> WordsWithUnit(std::string_view family, std::string_view heading);

// The notation that words such as "Cv", "Kv-Wert" or "Nenndurchfluss" stand for. It takes them out
// of `words`, so that "fill" may be left.
std::optional<FlowNotation> TakeNotation(std::vector<std::string>& words);

// "Total", "Summe", "Σ", "Average" …: the label of a row that is none of the table's.
bool IsTotalLabel(std::string_view cell);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_HEADING_WORDS_H_
