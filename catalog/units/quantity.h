// A number with or without a unit, as people write it in a spreadsheet or a request: "350 g",
// "6 bar", "1/4 in", "0,5 s".
#ifndef PLENUM_CATALOG_UNITS_QUANTITY_H_
#define PLENUM_CATALOG_UNITS_QUANTITY_H_

#include <optional>
#include <string>
#include <string_view>

namespace plenum::catalog {

struct Quantity {
  std::optional<double> value;  // in the unit of the field; none: see error
  std::string error;            // names the text and what would do
  std::string_view condition;   // what a standard volume was taken to be counted at; often empty
};

// What surrounds the text.
struct QuantityContext {
  // Of the document: what an absolute pressure is made gauge with; none: it is refused.
  std::optional<double> ambient_kpa_abs = {};
  bool needs_unit = false;  // a bare number is refused
};

// Reads `text` for a field whose name ends in its unit (mass_kg, pressure_max_kpa_gauge,
// mass_kg_max, …): the one reader of units of the program. A bare number is taken in that unit, as
// it is. Otherwise it is converted, with one rounding:
//
//   _kpa_gauge          kPa, Pa, mbar, bar, MPa, psi, inHg, mmHg, cmH2O and more: gauge, also with
//                       (g) or gauge behind it; with (a) or abs behind it, psia and bara: absolute
//   _kpa_abs            the same, absolute, also with (a) or abs behind it
//   _kpa                the same, a difference
//   _kg                 kg, g, mg, lb, oz              _kg_per_m   kg/m, g/m, lb/ft
//   _ml, _l             mL, cm3, cc, L, dm3, m3, in3
//   _mm, _m             mm, um, cm, m, in, ft          _mm2        mm2, cm2, in2
//   _l_per_min[_anr]    L/min, L/s, m3/h, scfm, cfm, each also with ANR (ISO 8778); normal litres
//                       only with 0 °C or 20 °C behind them: NL/min (0 °C), NL/min, 20 °C
//   _dm3_per_s_bar      dm3/(s·bar), L/(s·bar), L/(min·bar), m3/(s·Pa)
//   _s, _ms             s, ms, us, min, h              _hz         Hz, mHz, kHz, 1/min, rpm, and
//                                                                  "every 3 s": once in that time
//   _k                  K, °C, °F                      _deg        °, rad
//   _v V mV kV · _a A mA · _ah Ah mAh · _w W mW kW · _wh Wh kWh J kJ · _eur EUR € · _eur_per_m
//   EUR/m _l_per_min_bar      L/(min·bar), L/(s·bar)         _rad_per_s  rad/s, Hz without a unit
//   % for a share
//
// ³ and · may stand for 3 and nothing; blanks do not matter. A comma is read as a decimal one, or
// one between thousands, where only one of them can be meant ("1,5", "0,125", "1.234,5"); "1,500"
// is refused. Units are those of the SI brochure (2019) and NIST SP 811 (2008), table of factors.
Quantity ParseQuantity(std::string_view text, std::string_view field,
                       const QuantityContext& context = {});

// The unit that the name of a field ends in, for people ("kPa gauge"); empty: it has none.
std::string_view UnitOf(std::string_view field);
// The units that a text for the field may be written in: "kPa, Pa, mbar, …".
std::string UnitNames(std::string_view field);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_UNITS_QUANTITY_H_
