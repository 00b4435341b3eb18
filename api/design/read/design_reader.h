// Pieces of a design of an answer, read back.
#ifndef PLENUM_API_DESIGN_READ_DESIGN_READER_H_
#define PLENUM_API_DESIGN_READ_DESIGN_READER_H_

#include <string>
#include <vector>

#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

inline constexpr std::size_t kDesignRowsMax = 1000;

template <typename Enum>
Enum ReadEnum(Reader& reader, const char* field, const std::vector<Enum>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const Enum value : values) names.emplace_back(optimizer::Name(value));
  const std::string chosen = reader.Choice(field, names);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == chosen) return values[i];
  return values.front();
}

// "configuration".
optimizer::Configuration ReadConfiguration(Reader& design);

// "family", "id", "group" and "quantity" of a row of "parts".
optimizer::Choice ReadChoice(Reader& row, const optimizer::Problem& problem,
                             optimizer::Configuration configuration);

// "source_pressure_kpa_gauge", "reservoir_volume_ml", "tank_fill_kpa_gauge", "pump_stop_kpa_gauge"
// of "settings": positive and finite. Of pumps without a reservoir the pressure is no setting and
// may be left out.
optimizer::Settings ReadPoint(Reader& settings, const optimizer::Problem& problem,
                              optimizer::Configuration configuration);

// The three together: a design that is to be evaluated.
optimizer::Design ReadGivenDesign(Reader design, const optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_DESIGN_READER_H_
