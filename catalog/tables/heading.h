// Headings of a table as fields of a family: by name, by other words for it, by unit.
#ifndef PLENUM_CATALOG_TABLES_HEADING_H_
#define PLENUM_CATALOG_TABLES_HEADING_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/fields.h"
#include "catalog/units/printed_flow.h"

namespace plenum::catalog {

// Where the cells of a column go.
struct Target {
  std::string column;  // of CsvColumns(family), or of catalog/tables/printed/printed_columns.h
  std::string unit;    // of bare numbers; empty: none is said
  // The column prints flow otherwise than as a sonic conductance (catalog/units/printed_flow.h).
  std::optional<FlowNotation> notation = std::nullopt;
  bool by_full_name = false;  // whose end says the unit: mass_kg
  bool operator==(const Target&) const = default;
};

// "mass_kg [g]", "sonic_conductance_dm3_per_s_bar [Qn Nl/min (20 °C)]": as ParseTarget reads it.
std::string FormatTarget(const Target& target);

struct HeadingMatch {
  std::vector<Target> targets;  // none: not known; more than one: any of them may be meant
  std::string wrong_unit;       // the only fields that the words name do not have this unit
};

// What a heading means, in this order: the name of a column ("mass_kg"); words for a field with its
// unit in brackets or behind "in", "/", "," or a blank ("Gewicht [g]", "Druck in bar", "mass_g");
// the words alone; a unit alone or with "max" and "min", which names its quantity ("max psi").
// Words that mean something else beside a unit are read with it: "ID (mm)", "PN (bar)". A field is
// meant by its own words ("pressure max", in any order), also in other words and in German
// (catalog/tables/heading_words.h); where only some of the words are given
// ("pressure"), every number field that has them. Of these the unit leaves those that can have it.
HeadingMatch MatchHeading(const Family& family, std::string_view heading);

// A target that a person names: "mass_kg" or "mass_kg [g]". Of the errors one, in words.
struct GivenTarget {
  Target target;
  std::string error;
};
GivenTarget ParseTarget(const Family& family, std::string_view text);

// Whether the lower and the upper end of one range: inlet_pressure_min_… and inlet_pressure_max_….
bool AreEnds(const Target& low, const Target& high);

// Null where the column is no number field, nor printed as numbers.
const NumberField* FindNumber(const Family& family, std::string_view column);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_HEADING_H_
