#include "api/json/unit_slips.h"

#include "api/json/json.h"
#include "api/json/words.h"
#include "catalog/units/quantity.h"

namespace plenum::api {
namespace {

// What the pointer of a number ends in, and the values, from `low` to below `high`, that would be
// usual in `unit`. What soft robots need lies ten times off these bounds, or nearly so; actuators
// below 20 kPa exist, but 14.5 is more often meant in psi, and a warning changes nothing.
struct Slip {
  std::string_view place;
  double low, high;
  std::string_view unit;
};
constexpr Slip kSlips[] = {
    {"/operating_pressure_kpa_gauge", 1, 8, "bar"},
    {"/operating_pressure_kpa_gauge", 8, 20, "psi"},
    {"/pressure_kpa_gauge_max", 1, 8, "bar"},
    {"/pressure_kpa_gauge_max", 8, 20, "psi"},
    {"/mains/pressure_kpa_gauge", 1, 20, "bar"},
    {"/source_pressure_kpa_gauge", 1, 12, "bar"},
    {"/source_pressure_kpa_gauge_max", 1, 20, "bar"},
    {"/tank_fill_kpa_gauge_max", 1, 20, "bar"},
    {"/rise_time_s_max", 20, 1e6, "ms"},
    {"/fall_time_s_max", 20, 1e6, "ms"},
    {"/rest_volume_ml", 0, 1, "L"},
    {"/rest_volume_ml", 2e4, 1e6, "mm³"},
    {"/reservoir_volume_ml", 1, 10, "L"},
    {"/tube_length_m", 20, 100, "cm"},
    {"/tube/length_m", 20, 100, "cm"},
    {"/mass_kg_max", 100, 1e6, "g"},
    {"/volume_l_max", 100, 1e6, "mL"},
    {"/sonic_conductance_dm3_per_s_bar", 30, 1e4, "L/(min·bar)"},
};

std::string SlipQuestion(const Slip& slip, double value) {
  const std::string unit(catalog::UnitOf(slip.place));
  const std::string other = Decimal(value) + " " + std::string(slip.unit);
  const auto meant = catalog::ParseQuantity(other, slip.place).value.value_or(value);
  return "is read as " + Decimal(value) + " " + unit + "; is " + other + " meant, " +
         Decimal(Rounded(meant)) + " " + unit + "? Then write \"" + other + "\"";
}

}  // namespace

std::string LooksLikeAnotherUnit(std::string_view pointer, double value) {
  for (const Slip& slip : kSlips)
    if (pointer.ends_with(slip.place) && value >= slip.low && value < slip.high)
      return SlipQuestion(slip, value);
  return "";
}

}  // namespace plenum::api
