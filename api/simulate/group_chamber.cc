#include "api/simulate/group_chamber.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/simulate/shape_reader.h"

namespace plenum::api {
namespace {

const Range kRestVolumeMl{0.01, 1e6};
constexpr double kTableAgreement = 0.05;
constexpr double kContractionMin = 0.01;  // least expansion ratio of an evacuated actuator

// What else says the volume cannot stand beside `kind`.
void Refuse(Reader& group, std::string_view kind, std::initializer_list<std::string_view> others) {
  for (const std::string_view other : others)
    if (group.Has(other))
      group.Fail(other,
                 "give either " + std::string(other) + " or " + std::string(kind) + ", not both");
}

void ReadTableOf(Reader& group, const model::Ambient& ambient, double operating_kpa,
                 model::Chamber& chamber) {
  const auto stated = group.OptionalNumber("rest_volume_ml", kRestVolumeMl);
  const double lowest = -ambient.pressure_pa / kPaPerKpa;
  const Table table = ReadTable(group, "pressure_volume", 2, "pressure_kpa_gauge",
                                Above(lowest, kRigGaugeMaxKpa), "volume_ml", kRestVolumeMl, +1);
  // Reported where they are read.
  if (!table.valid || std::isnan(chamber.operating_pressure_pa)) return;
  if (table.x.front() > 0 || table.x.back() < operating_kpa) {
    group.Fail("pressure_volume", "must reach from 0 to the operating pressure of " +
                                      Decimal(operating_kpa) + " kPa gauge, not from " +
                                      Decimal(table.x.front()) + " to " + Decimal(table.x.back()));
    return;
  }
  std::vector<double> pressure_pa, volume_m3;
  for (const double kpa : table.x) pressure_pa.push_back(PaFromKpaGauge(kpa, ambient));
  for (const double ml : table.y) volume_m3.push_back(M3FromMl(ml));
  chamber.volume_curve = model::MonotoneCurve(std::move(pressure_pa), std::move(volume_m3));
  chamber.rest_volume_m3 = chamber.volume_curve(ambient.pressure_pa);
  chamber.expansion_ratio =
      chamber.volume_curve(chamber.operating_pressure_pa) / chamber.rest_volume_m3;
  const double rest_ml = MlFromM3(chamber.rest_volume_m3);
  if (stated && std::abs(*stated - rest_ml) > kTableAgreement * rest_ml)
    group.Fail("rest_volume_ml", "is " + Decimal(*stated) + ", but pressure_volume gives " +
                                     Decimal(rest_ml) + " at ambient pressure");
}

void SetVolumes(const model::ActuatorVolumes& volumes, model::Chamber& chamber) {
  chamber.rest_volume_m3 = volumes.rest_m3;
  chamber.expansion_ratio = volumes.operating_m3 / volumes.rest_m3;
}

// Also of one that cannot be read, as it is too deep or in no known unit.
bool IsBelowZero(Reader& group) {
  const Json* given = group.Raw("operating_pressure_kpa_gauge");
  if (given && given->is_string()) {
    const std::string& text = given->get_ref<const std::string&>();
    const std::size_t first = text.find_first_not_of(' ');
    return first != std::string::npos && text.compare(first, 1, "-") == 0;
  }
  return given && given->is_number() && given->get<double>() < 0.0;
}

// Its rest volume and ratio.
void ReadEvacuated(Reader& group, const model::Ambient& ambient, double operating_kpa,
                   model::Chamber& chamber) {
  chamber.operating_pressure_pa = PaFromKpaGauge(-operating_kpa, ambient);
  chamber.rest_volume_m3 = M3FromMl(group.Number("rest_volume_ml", kRestVolumeMl));
  chamber.expansion_ratio = group.Number("expansion_ratio", {kContractionMin, 1});
}

}  // namespace

model::Chamber ReadChamber(Reader& group, const model::Ambient& ambient, Vacuum vacuum,
                           std::optional<model::Chamber>* rod_side, double operating_max_kpa) {
  model::Chamber chamber;
  chamber.ambient_pressure_pa = ambient.pressure_pa;
  const double deepest_kpa = DeepestKpaGauge(ambient);
  const double operating = group.Number(
      "operating_pressure_kpa_gauge",
      {vacuum == Vacuum::kAllowed ? std::min(deepest_kpa, -1.0) : 1.0, operating_max_kpa});
  if (std::abs(operating) < 1.0)
    group.Fail("operating_pressure_kpa_gauge",
               "must be at least 1, or at most -1 for an actuator that is evacuated, not " +
                   Decimal(operating));
  chamber.evacuated = operating < 0.0;
  if (chamber.evacuated || (vacuum == Vacuum::kAllowed && IsBelowZero(group))) {
    if (!HasShape(group) && !group.Has("pressure_volume")) {
      chamber.evacuated = true;
      ReadEvacuated(group, ambient, operating, chamber);
      return chamber;
    }
    // What it says is read all the same, so that each of its errors is told.
    group.Fail("operating_pressure_kpa_gauge",
               "is below ambient: give rest_volume_ml and expansion_ratio, at most 1, of an "
               "evacuated actuator; a shape or a table says how one swells");
  }
  chamber.operating_pressure_pa = PaFromKpaGauge(operating, ambient);

  if (HasShape(group)) {
    Refuse(group, "the shape of the actuator",
           {"rest_volume_ml", "expansion_ratio", "pressure_volume"});
    if (const auto shape = ReadShape(group)) {
      SetVolumes(shape->volumes, chamber);
      if (shape->rod_side && rod_side == nullptr)
        group.FailAt("cylinder/acting",
                     "must be single here: give each side of a double-acting cylinder as a group "
                     "of its own");
      if (shape->rod_side && rod_side != nullptr) {
        *rod_side = chamber;
        SetVolumes(*shape->rod_side, **rod_side);
      }
    }
  } else if (group.Has("pressure_volume")) {
    Refuse(group, "pressure_volume", {"expansion_ratio"});
    ReadTableOf(group, ambient, operating, chamber);
  } else {
    chamber.rest_volume_m3 = M3FromMl(group.Number("rest_volume_ml", kRestVolumeMl));
    chamber.expansion_ratio = group.Number("expansion_ratio", {1, kExpansionMax});
  }
  return chamber;
}

void ReadLowPressure(Reader& group, const model::Ambient& ambient, bool double_acting,
                     model::Chamber& chamber) {
  constexpr const char* kField = "low_pressure_kpa_gauge";
  const auto kpa = group.OptionalNumber(kField, {DeepestKpaGauge(ambient), 0});
  if (!kpa || !(*kpa < 0.0)) return;
  if (chamber.evacuated)
    return group.Fail(kField,
                      "is for actuators under pressure: one with an operating pressure below "
                      "ambient rests at ambient");
  if (double_acting)
    return group.Fail(kField, "is not for double-acting cylinders, whose sides rest in turn");
  chamber.low_pressure_pa = PaFromKpaGauge(*kpa, ambient);
  const double left_m3 = model::Volume(chamber, chamber.low_pressure_pa);
  if (left_m3 <= 0.0)
    group.Fail(kField, "is " + Decimal(*kpa) +
                           ", where the actuator would have no volume left: its volume goes on "
                           "below ambient as it does above it, and comes to " +
                           Decimal(Rounded(MlFromM3(left_m3))) +
                           " mL there; a pressure_volume table that reaches below 0 says how it "
                           "goes on");
}

}  // namespace plenum::api
