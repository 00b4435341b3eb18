// A heading of a recording as a field of a measurement.
#ifndef PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_HEADING_H_
#define PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_HEADING_H_

#include <string>
#include <string_view>

#include "catalog/tables/heading.h"

namespace plenum::api {

// What a heading may mean, in this order: the name of a field ("pressure_kpa_gauge"), words with a
// unit behind them ("p_abs [bar]", "Zeit in ms", "pressure_psi"), words alone, a unit of pressure
// or time alone ("Sensor 3 (bar)": the pressure, "millis"). The unit of a pressure carries its
// mark: "bar abs", or "abs" where only the mark is said.
catalog::HeadingMatch MatchRecordingHeading(std::string_view heading);

// A target that a person names: "pressure_kpa_gauge [bar abs]", "valve [1 = inflate; 0 = hold]".
catalog::GivenTarget ParseRecordingTarget(std::string_view text);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_HEADINGS_RECORDING_HEADING_H_
