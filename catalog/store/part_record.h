// A part as one text, for its history and its hash: comma-separated lines, each named by its first
// cell.
//
//   part,id,family,manufacturer,part_number,origin,notes
//   series,text                                                 where it has one
//   orderable,true                                              or false; where it is known
//   alias,text                                                  one an alias
//   offer,supplier,price,currency,pack,date,link                one an offer
//   document,link,sha256                                        one a document
//   number,field,value,provenance,source[,uncertainty]          one a number, in order of field
//   text,field,value,provenance,source                          one a text
//   curve,provenance and source of free air, of current[,uncertainty of free air, of current]
//   point,kPa gauge,L/min,A
//
// It knows no vocabulary of fields, so that old records stay readable when fields come and go. What
// a part does not have has no line and no cell: a part of an older catalogue keeps its record, and
// so its hash.
#ifndef PLENUM_CATALOG_STORE_PART_RECORD_H_
#define PLENUM_CATALOG_STORE_PART_RECORD_H_

#include <optional>
#include <string>
#include <string_view>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// Equal parts have equal records.
std::string FormatRecord(const Part& part);
// The part again, exactly; none if the text is no record.
std::optional<Part> ParseRecord(std::string_view text);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_PART_RECORD_H_
