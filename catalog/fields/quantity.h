// A number with or without a unit, as people write it in a spreadsheet: "350 g", "6 bar", "0.25
// in".
#ifndef PLENUM_CATALOG_FIELDS_QUANTITY_H_
#define PLENUM_CATALOG_FIELDS_QUANTITY_H_

#include <optional>
#include <string>
#include <string_view>

namespace plenum::catalog {

struct Quantity {
  std::optional<double> value;  // in the unit of the field; none: see error
  std::string error;            // names the text and what would do
};

// Reads `text` for a field whose name ends in its unit (mass_kg, pressure_max_kpa_gauge, …). A bare
// number is taken in that unit, as it is. Otherwise it is converted, with one rounding:
//
//   _kpa_gauge          kPa, Pa, mbar, bar, MPa, psi, each also with (g) or gauge behind it
//   _kg                 kg, g, mg, lb, oz              _kg_per_m   kg/m, g/m, lb/ft
//   _ml, _l             mL, cm3, cc, L, dm3, m3, in3
//   _mm                 mm, um, cm, m, in
//   _l_per_min[_anr]    L/min, L/s, m3/h, each also with ANR (ISO 8778); normal litres are refused,
//                       they are counted at 0 °C
//   _dm3_per_s_bar      dm3/(s·bar), L/(s·bar), L/(min·bar), m3/(s·Pa)
//   _v V mV kV · _a A mA · _ah Ah mAh · _w W mW kW · _ms ms us s · _eur EUR € · _eur_per_m EUR/m
//   without a unit      % for a share
//
// Absolute pressures are refused: without the ambient pressure they cannot be made gauge. ³ and ·
// may stand for 3 and nothing; blanks do not matter. Units are those of the SI brochure (2019) and
// NIST SP 811 (2008), table of factors.
Quantity ParseQuantity(std::string_view text, std::string_view field);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_QUANTITY_H_
