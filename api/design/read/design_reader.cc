#include "api/design/read/design_reader.h"

#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

constexpr double kSamePressureKpa = 1e-6;

using optimizer::Configuration;
using optimizer::Family;
using optimizer::Problem;

const Range kReservoirMl{1e-3, 1e9};

int GroupNamed(const Problem& problem, const std::string& name) {
  for (std::size_t g = 0; g < problem.groups.size(); ++g)
    if (problem.groups[g].name == name) return static_cast<int>(g);
  return -1;
}

// Fields that an answer has in a design that it lists, and that a given one may keep.
void PassOver(Reader& reader, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    reader.Raw(name);
    reader.Describe(name, {{"description", "of a design of an answer; not read"}});
  }
}

// The source pressure of an evacuated design is the same number, and not needed.
void ReadVacuumOf(Reader& reader, const Problem& problem, Configuration configuration,
                  optimizer::Settings& settings) {
  const Range range{DeepestKpaGauge(problem.ambient), 0};
  const auto source = reader.OptionalNumber("source_pressure_kpa_gauge", range);
  if (!reader.Has("vacuum_kpa_gauge") && (source || optimizer::IsDirect(configuration))) {
    if (source) settings.source_pressure_pa = optimizer::PaFromKpaGauge(problem, *source);
    return;
  }
  const double vacuum = reader.Number("vacuum_kpa_gauge", range);
  settings.source_pressure_pa = optimizer::PaFromKpaGauge(problem, vacuum);
  if (source && std::abs(*source - vacuum) > kSamePressureKpa)
    reader.Fail("source_pressure_kpa_gauge", "must be the vacuum_kpa_gauge of " + Decimal(vacuum) +
                                                 " where actuators are evacuated, not " +
                                                 Decimal(*source));
}

// Of a vacuum that pumps keep beside the pressure.
void ReadPumpedRail(Reader& reader, const Problem& problem, optimizer::Settings& settings) {
  const double kpa = reader.Number("vacuum_kpa_gauge", PumpedRailRange(problem));
  settings.rail = optimizer::RailSettings{PaFromKpaGauge(kpa, problem.ambient)};
}

// Of a design with a vacuum beside its pressure: the wall's, if it is given.
void ReadRail(Reader& reader, const Problem& problem) {
  const auto given =
      reader.OptionalNumber("vacuum_kpa_gauge", {DeepestKpaGauge(problem.ambient), 0});
  if (!given) return;
  if (!HasVacuumRail(problem))
    reader.Fail("vacuum_kpa_gauge",
                "is for actuators that go below ambient: none has an operating pressure or a "
                "low_pressure_kpa_gauge below 0 kPa gauge");
  else if (std::abs(*given - VacuumRailKpa(problem)) > kSamePressureKpa)
    reader.Fail("vacuum_kpa_gauge", "must be the wall's vacuum of " +
                                        Decimal(VacuumRailKpa(problem)) + ", not " +
                                        Decimal(*given));
}

}  // namespace

Configuration ReadConfiguration(Reader& design) {
  return ReadEnum<Configuration>(
      design, "configuration",
      {Configuration::kCylinder, Configuration::kCo2, Configuration::kCompressor,
       Configuration::kMains, Configuration::kTank, Configuration::kDirectPump,
       Configuration::kVacuumPump, Configuration::kDirectVacuumPump, Configuration::kTankAndPump,
       Configuration::kEjector, Configuration::kDirectEjector});
}

optimizer::Choice ReadChoice(Reader& row, const Problem& problem, Configuration configuration) {
  optimizer::Choice choice;
  std::vector<Family> families;
  for (const optimizer::FamilySpec& spec : optimizer::Families())
    if (optimizer::CatalogueFamily(spec.family) == spec.family) families.push_back(spec.family);
  choice.family = optimizer::FamilyIn(configuration, ReadEnum<Family>(row, "family", families));
  choice.id = row.Text("id");
  if (row.Has("group")) {
    choice.group = GroupNamed(problem, row.Text("group"));
    if (choice.group < 0) row.Fail("group", "is no group of the request");
  }
  choice.quantity = row.Number("quantity", Above(0, 1e6));
  return choice;
}

optimizer::Settings ReadPoint(Reader& reader, const Problem& problem, Configuration configuration) {
  optimizer::Settings settings;
  if (optimizer::Evacuated(problem))
    ReadVacuumOf(reader, problem, configuration, settings);
  else if (reader.Has("source_pressure_kpa_gauge") || !optimizer::IsDirect(configuration))
    settings.source_pressure_pa = PaFromKpaGauge(
        reader.Number("source_pressure_kpa_gauge", {0, kGaugeMaxKpa}), problem.ambient);
  if (optimizer::PumpsRail(problem))
    ReadPumpedRail(reader, problem, settings);
  else if (!optimizer::Evacuated(problem) && reader.Has("vacuum_kpa_gauge"))
    ReadRail(reader, problem);
  if (const auto ml = reader.OptionalNumber("reservoir_volume_ml", kReservoirMl))
    settings.reservoir_volume_m3 = M3FromMl(*ml);
  if (const auto kpa = reader.OptionalNumber("tank_fill_kpa_gauge", {0, kGaugeMaxKpa}))
    settings.tank_fill_pa = PaFromKpaGauge(*kpa, problem.ambient);
  if (const auto kpa = reader.OptionalNumber("pump_stop_kpa_gauge", {0, kGaugeMaxKpa}))
    settings.pump_stop_pa = PaFromKpaGauge(*kpa, problem.ambient);
  if (reader.Has("group_pressure_kpa_gauge"))
    for (const double kpa :
         reader.Numbers("group_pressure_kpa_gauge", problem.groups.size(), {0, kGaugeMaxKpa}))
      settings.group_pressure_pa.push_back(PaFromKpaGauge(kpa, problem.ambient));
  return settings;
}

optimizer::Design ReadGivenDesign(Reader reader, const Problem& problem) {
  optimizer::Design design;
  design.configuration = ReadConfiguration(reader);
  for (const Element& element : reader.List("parts", 1, kDesignRowsMax)) {
    Reader row(element, reader.errors());
    design.parts.push_back(ReadChoice(row, problem, design.configuration));
    PassOver(row,
             {"manufacturer", "part_number", "unit", "mass_kg", "volume_l", "cost_eur", "own"});
    row.Finish();
  }
  Reader settings = reader.Object("settings");
  design.settings = ReadPoint(settings, problem, design.configuration);
  PassOver(settings, {"valve_duty", "valve_duty_groups", "compressor_duty", "power",
                      "vacuum_stop_kpa_gauge", "vacuum_duty", "vacuum_reservoir_volume_ml"});
  settings.Finish();
  PassOver(reader, {"rank", "objective", "totals", "performance", "margins", "response", "kind",
                    "packs", "variants", "data_quality", "robustness", "guarantee", "to_be_first"});
  reader.Finish();
  return design;
}

}  // namespace plenum::api
