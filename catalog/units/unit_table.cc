#include "catalog/units/unit_table.h"

#include <iterator>

namespace plenum::catalog {
namespace {

constexpr double kLitresPerCubicFoot = 28.316846592;

// Conventional columns of mercury and water: 13,595.1 and 1000 kg/m³ at 9.80665 m/s².
constexpr Unit kPressures[] = {
    {"kPa"},
    {"Pa", 1, 1000},
    {"hPa", 1, 10, 0, {}, true},
    {"mbar", 1, 10},
    {"bar", 100},
    {"MPa", 1000},
    {"psi", 6.894757293168361},
    {"PSI", 6.894757293168361, 1, 0, {}, true},
    {"inHg", 3.386388640341},
    {"mmHg", 0.133322387415},
    {"cmH2O", 0.0980665},
    {"mmH2O", 0.00980665, 1, 0, {}, true},
    {"inH2O", 0.24908891, 1, 0, {}, true},
    {"atm", 101.325, 1, 0, {}, true},
    {"Torr", 101.325, 760, 0, {}, true},
    {"kgf/cm2", 98.0665, 1, 0, {}, true},
    {"kg/cm2", 98.0665, 1, 0, {}, true},
};
constexpr Unit kConductances[] = {
    {"dm3/(sbar)"},        {"dm3/sbar", 1, 1, 0, {}, true},
    {"L/(sbar)"},          {"L/sbar", 1, 1, 0, {}, true},
    {"L/(minbar)", 1, 60}, {"L/minbar", 1, 60, 0, {}, true},
    {"m3/(sPa)", 1e8},     {"m3/sPa", 1e8, 1, 0, {}, true},
};
constexpr Unit kFlows[] = {
    {"L/min"},
    {"L/s", 60},
    {"lpm", 1, 1, 0, {}, true},
    {"LPM", 1, 1, 0, {}, true},
    {"L/h", 1, 60, 0, {}, true},
    {"mL/min", 1, 1000, 0, {}, true},
    {"m3/h", 1000, 60},
    {"m3/min", 1000, 1, 0, {}, true},
    // The standard cubic foot of CAGI and ISO 1217: 68 °F and 14.5 psi, which is the ANR litre.
    {"scfm", kLitresPerCubicFoot, 1, 0, kAtTwenty},
    {"SCFM", kLitresPerCubicFoot, 1, 0, kAtTwenty, true},
    {"scfh", kLitresPerCubicFoot, 60, 0, kAtTwenty, true},
    {"SCFH", kLitresPerCubicFoot, 60, 0, kAtTwenty, true},
    {"cfm", kLitresPerCubicFoot, 1, 0, {}, true},
    {"CFM", kLitresPerCubicFoot, 1, 0, {}, true},
    {"ft3/min", kLitresPerCubicFoot, 1, 0, {}, true},
};
constexpr Unit kViscous[] = {{"Pa2s/kg"}};
constexpr Unit kInertial[] = {{"Pa2s2/kg2"}};
constexpr Unit kFlowsPerBar[] = {{"L/(minbar)"}, {"L/minbar", 1, 1, 0, {}, true}, {"L/(sbar)", 60}};
constexpr Unit kMasses[] = {
    {"kg"},
    {"g", 1, 1000},
    {"mg", 1, 1e6},
    {"lb", 0.45359237},
    {"oz", 0.45359237, 16},
    {"lbs", 0.45359237, 1, 0, {}, true},
    {"gram", 1, 1000, 0, {}, true},
    {"grams", 1, 1000, 0, {}, true},
};
constexpr Unit kMassesPerM[] = {
    {"kg/m"},
    {"g/m", 1, 1000},
    {"lb/ft", 0.45359237, 0.3048},
    {"lbs/ft", 0.45359237, 0.3048, 0, {}, true},
    {"g/ft", 1, 304.8, 0, {}, true},
    {"oz/ft", 0.45359237, 16 * 0.3048, 0, {}, true},
    {"kg/100m", 1, 100, 0, {}, true},
    {"lb/100ft", 0.45359237, 30.48, 0, {}, true},
    {"lbs/100ft", 0.45359237, 30.48, 0, {}, true},
};
constexpr Unit kMillilitres[] = {
    {"mL"},      {"cm3"},       {"cc"},      {"mm3", 1, 1000, 0, {}, true},
    {"L", 1000}, {"dm3", 1000}, {"m3", 1e6}, {"in3", 16.387064}};
constexpr Unit kLitres[] = {
    {"L"},           {"dm3"},      {"mL", 1, 1000},         {"cm3", 1, 1000},
    {"cc", 1, 1000}, {"m3", 1000}, {"in3", 16.387064, 1000}};
constexpr Unit kMillimetres[] = {{"mm"},
                                 {"um", 1, 1000},
                                 {"cm", 10},
                                 {"m", 1000},
                                 {"in", 25.4},
                                 {"inch", 25.4, 1, 0, {}, true},
                                 {"inches", 25.4, 1, 0, {}, true},
                                 {"\"", 25.4, 1, 0, {}, true},
                                 {"″", 25.4, 1, 0, {}, true},
                                 {"ft", 304.8}};
constexpr Unit kMetres[] = {
    {"m"},
    {"mm", 1, 1000},
    {"cm", 1, 100},
    {"in", 254, 10000},
    {"inch", 254, 10000, 0, {}, true},
    {"\"", 254, 10000, 0, {}, true},
    {"″", 254, 10000, 0, {}, true},
    {"ft", 0.3048},
};
constexpr Unit kSquareMillimetres[] = {{"mm2"}, {"cm2", 100}, {"in2", 645.16}};
constexpr Unit kSeconds[] = {{"s"},
                             {"ms", 1, 1000},
                             {"us", 1, 1e6, 0, {}, true},
                             {"min", 60},
                             {"h", 3600},
                             {"sec", 1, 1, 0, {}, true},
                             {"second", 1, 1, 0, {}, true},
                             {"seconds", 1, 1, 0, {}, true},
                             {"minute", 60, 1, 0, {}, true},
                             {"minutes", 60, 1, 0, {}, true},
                             {"hr", 3600, 1, 0, {}, true},
                             {"hour", 3600, 1, 0, {}, true},
                             {"hours", 3600, 1, 0, {}, true}};
constexpr Unit kMilliseconds[] = {{"ms"}, {"us", 1, 1000}, {"s", 1000}, {"min", 60000}};
constexpr Unit kHertz[] = {{"Hz"},
                           {"hz", 1, 1, 0, {}, true},
                           {"mHz", 1, 1000},
                           {"kHz", 1000},
                           {"1/s", 1, 1, 0, {}, true},
                           {"1/min", 1, 60},
                           {"/min", 1, 60, 0, {}, true},
                           {"permin", 1, 60, 0, {}, true},
                           {"perminute", 1, 60, 0, {}, true},
                           {"rpm", 1, 60, 0, {}, true},
                           {"cpm", 1, 60, 0, {}, true},
                           {"bpm", 1, 60, 0, {}, true},
                           {"/s", 1, 1, 0, {}, true},
                           {"persecond", 1, 1, 0, {}, true},
                           {"/h", 1, 3600, 0, {}, true},
                           {"perhour", 1, 3600, 0, {}, true}};
constexpr Unit kKelvin[] = {{"K"},
                            {"°C", 1, 1, 273.15},
                            {"degC", 1, 1, 273.15, {}, true},
                            {"C", 1, 1, 273.15, {}, true},
                            {"°F", 5, 9, 459.67},
                            {"degF", 5, 9, 459.67, {}, true},
                            {"F", 5, 9, 459.67, {}, true}};
constexpr Unit kDegrees[] = {{"°"}, {"deg", 1, 1, 0, {}, true}, {"rad", 57.29577951308232}};
constexpr Unit kRadians[] = {{"rad/s"}, {"Hz", 6.283185307179586}};
constexpr Unit kEuros[] = {{"EUR"}, {"€"}};
constexpr Unit kEurosPerM[] = {{"EUR/m"}, {"€/m"}};
constexpr Unit kAmpereHours[] = {{"Ah"}, {"mAh", 1, 1000}, {"AH", 1, 1, 0, {}, true}};
constexpr Unit kWattHours[] = {
    {"Wh"}, {"kWh", 1000}, {"mWh", 1, 1000, 0, {}, true}, {"J", 1, 3600}, {"kJ", 1000, 3600}};
constexpr Unit kVolts[] = {{"V"},
                           {"mV", 1, 1000},
                           {"kV", 1000},
                           {"VDC", 1, 1, 0, {}, true},
                           {"Vdc", 1, 1, 0, {}, true},
                           {"Volt", 1, 1, 0, {}, true},
                           {"Volts", 1, 1, 0, {}, true}};
constexpr Unit kAmperes[] = {{"A"}, {"mA", 1, 1000}};
constexpr Unit kWatts[] = {{"W"}, {"mW", 1, 1000}, {"kW", 1000}};
constexpr Unit kShares[] = {{"%", 1, 100}};

// Longer suffixes come before those that they end in.
constexpr Dimension kDimensions[] = {
    {"_dm3_per_s_bar", "dm³/(s·bar)", kConductances},
    {"_l_per_min_bar", "L/(min·bar)", kFlowsPerBar},
    {"_l_per_min_anr", "L/min (ANR)", kFlows, Kind::kFlow},
    {"_l_per_min", "L/min", kFlows, Kind::kFlow},
    {"_pa2_s_per_kg", "Pa²·s/kg", kViscous},
    {"_pa2_s2_per_kg2", "Pa²·s²/kg²", kInertial},
    {"_rad_per_s", "rad/s", kRadians},
    {"_kg_per_m", "kg/m", kMassesPerM},
    {"_eur_per_m", "EUR/m", kEurosPerM},
    {"_kpa_gauge", "kPa gauge", kPressures, Kind::kGauge},
    {"_kpa_abs", "kPa absolute", kPressures, Kind::kAbsolute},
    {"_kpa", "kPa", kPressures},
    {"_mm2", "mm²", kSquareMillimetres},
    {"_kg", "kg", kMasses},
    {"_ml", "mL", kMillilitres},
    {"_mm", "mm", kMillimetres},
    {"_ms", "ms", kMilliseconds},
    {"_hz", "Hz", kHertz},
    {"_deg", "°", kDegrees},
    {"_eur", "EUR", kEuros},
    {"_ah", "Ah", kAmpereHours},
    {"_wh", "Wh", kWattHours},
    {"_l", "L", kLitres},
    {"_m", "m", kMetres},
    {"_s", "s", kSeconds},
    {"_k", "K", kKelvin},
    {"_v", "V", kVolts},
    {"_a", "A", kAmperes},
    {"_w", "W", kWatts},
    {"", "", kShares},
};

const Dimension& LongestOf(std::string_view field) {
  for (const Dimension& dimension : kDimensions)
    if (field.ends_with(dimension.suffix)) return dimension;
  return *std::rbegin(kDimensions);
}

}  // namespace

const Dimension& DimensionOf(std::string_view field) {
  const Dimension& whole = LongestOf(field);
  if (!whole.suffix.empty() || !(field.ends_with("_max") || field.ends_with("_min"))) return whole;
  return LongestOf(field.substr(0, field.size() - std::string_view("_max").size()));
}

}  // namespace plenum::catalog
