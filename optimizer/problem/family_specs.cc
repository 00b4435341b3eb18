#include "optimizer/problem/family_specs.h"

#include <algorithm>
#include <utility>

#include "optimizer/problem/part_tables.h"

namespace plenum::optimizer {
namespace {

template <auto list>
std::size_t SizeOf(const model::Parts& parts) {
  return (parts.*list).size();
}

template <auto list>
const model::PartBasics& BasicsIn(const model::Parts& parts, int part) {
  const auto& found = (parts.*list)[part];
  if constexpr (requires { found.per_metre; })
    return found.per_metre;
  else
    return found.basics;
}

// Where a family is used.
struct Place {
  int place;
  bool in_line = false;
  std::vector<Configuration> sources = {};
  int Limits::*most = nullptr;
  bool by_need = false, made_to_measure = false, joins = false;
  KindRole kind_role = KindRole::kApart;
  bool on_rail = false;
};

template <auto list>
FamilySpec Spec(Family family, const char* name, std::span<const PartField> fields,
                const Place& place) {
  FamilySpec spec{.family = family,
                  .name = name,
                  .fields = fields,
                  .size = &SizeOf<list>,
                  .basics = &BasicsIn<list>,
                  .place = place.place,
                  .in_line = place.in_line,
                  .most = place.most,
                  .joins = place.joins,
                  .by_need = place.by_need,
                  .made_to_measure = place.made_to_measure,
                  .kind_role = place.kind_role,
                  .on_rail = place.on_rail};
  for (const Configuration configuration : place.sources)
    spec.in_source[static_cast<std::size_t>(configuration)] = true;
  return spec;
}

Place PumpsIn(std::vector<Configuration> sources, bool on_rail = false) {
  return {.place = 6,
          .sources = std::move(sources),
          .most = &Limits::compressors,
          .kind_role = KindRole::kSource,
          .on_rail = on_rail};
}

std::vector<Family> InOrder(std::vector<Family> families) {
  std::sort(families.begin(), families.end(),
            [](Family a, Family b) { return SpecOf(a).place < SpecOf(b).place; });
  return families;
}

}  // namespace

std::vector<FamilySpec> OwnFamilies() {
  using model::Parts;
  using enum Configuration;
  return {
      Spec<&Parts::tubing>(Family::kTubing, "tubing", kTubingFields, {.place = 2, .in_line = true}),
      Spec<&Parts::fittings>(Family::kFitting, "fitting", kFittingFields,
                             {.place = 1, .in_line = true}),
      Spec<&Parts::valves>(Family::kValve, "valve", kValveFields,
                           {.place = 0, .in_line = true, .kind_role = KindRole::kValve}),
      Spec<&Parts::compressors>(Family::kCompressor, "compressor", kCompressorFields,
                                PumpsIn({kCompressor, kDirectPump, kTankAndPump})),
      Spec<&Parts::cylinders>(Family::kCylinder, "cylinder", kCylinderFields,
                              {.place = 4,
                               .sources = {kCylinder},
                               .most = &Limits::cylinders,
                               .by_need = true,
                               .kind_role = KindRole::kSource}),
      Spec<&Parts::co2>(Family::kCo2, "co2", kCo2Fields,
                        {.place = 5,
                         .sources = {kCo2},
                         .most = &Limits::co2,
                         .by_need = true,
                         .kind_role = KindRole::kSource}),
      Spec<&Parts::batteries>(
          Family::kBattery, "battery", kBatteryFields,
          {.place = 7,
           .sources = {kCylinder, kCo2, kCompressor, kTank, kDirectPump, kVacuumPump,
                       kDirectVacuumPump, kTankAndPump, kEjector, kDirectEjector},
           .most = &Limits::batteries,
           .by_need = true}),
      Spec<&Parts::regulators>(Family::kRegulator, "regulator", kRegulatorFields,
                               {.place = 3,
                                .sources = {kCylinder, kCo2, kMains, kTank, kTankAndPump},
                                .kind_role = KindRole::kRegulator}),
      Spec<&Parts::reservoirs>(Family::kReservoir, "reservoir", kReservoirFields,
                               {.place = 8,
                                .sources = {kCompressor, kVacuumPump, kEjector},
                                .most = &Limits::reservoirs,
                                .by_need = true,
                                .made_to_measure = true}),
      Spec<&Parts::tanks>(Family::kTank, "reservoir", kTankFields,
                          {.place = 5,
                           .sources = {kTank, kTankAndPump},
                           .most = &Limits::reservoirs,
                           .by_need = true,
                           .kind_role = KindRole::kSource}),
      Spec<&Parts::vacuum_pumps>(Family::kVacuumPump, "vacuum_pump", kVacuumPumpFields,
                                 PumpsIn({kVacuumPump, kDirectVacuumPump}, true)),
      Spec<&Parts::manifolds>(Family::kManifold, "manifold", kManifoldFields,
                              {.place = 9, .joins = true}),
      Spec<&Parts::ejectors>(Family::kEjector, "ejector", kEjectorFields,
                             PumpsIn({kEjector, kDirectEjector})),
      Spec<&Parts::check_valves>(Family::kCheckValve, "check_valve", kCheckValveFields,
                                 {.place = 10, .joins = true}),
      Spec<&Parts::reservoirs>(Family::kVacuumReservoir, "reservoir", kReservoirFields,
                               {.place = 8, .most = &Limits::reservoirs, .on_rail = true}),
  };
}

const FamilySpec& SpecOf(Family family) { return Families()[static_cast<std::size_t>(family)]; }

const char* Name(Family family) { return SpecOf(family).name; }

int FamilySize(const model::Parts& parts, Family family) {
  return static_cast<int>(SpecOf(family).size(parts));
}

int ChoicesIn(const Problem& problem, Configuration configuration, Family family) {
  const int all = FamilySize(problem.parts, family);
  const bool any_voltage = family == Family::kBattery &&
                           (!HasPump(configuration) || IsEjector(configuration)) &&
                           !PumpsRail(problem) && problem.power.kind != PowerKind::kBattery;
  return any_voltage ? std::min(all, 1) : all;
}

const model::PartBasics& BasicsOf(const model::Parts& parts, Family family, int part) {
  return SpecOf(family).basics(parts, part);
}

model::PartBasics& BasicsOf(model::Parts& parts, Family family, int part) {
  return const_cast<model::PartBasics&>(BasicsOf(std::as_const(parts), family, part));
}

int FindPart(const model::Parts& parts, Family family, const std::string& id) {
  for (int i = 0; i < FamilySize(parts, family); ++i)
    if (BasicsOf(parts, family, i).id == id) return i;
  return -1;
}

Family FamilyIn(Configuration configuration, Family named) {
  if (named != Family::kReservoir || KeepsReservoir(configuration)) return named;
  return HasTank(configuration) ? Family::kTank : Family::kVacuumReservoir;
}

Family CatalogueFamily(Family family) {
  const bool another = family == Family::kTank || family == Family::kVacuumReservoir;
  return another ? Family::kReservoir : family;
}

bool MayLack(Configuration configuration, Family family) {
  return configuration == Configuration::kTank && family == Family::kRegulator;
}

int QuantityMax(const Problem& problem, Family family) {
  const auto most = SpecOf(family).most;
  return most == nullptr ? 1 : problem.limits.*most;
}

bool MadeToMeasureAllowed(const Problem& problem, Family family) {
  // What is made to measure is built for pressure from inside.
  if (!SpecOf(family).made_to_measure || problem.orderable_only || Evacuated(problem)) return false;
  const auto required = problem.require.find(family);
  return !problem.exclude.contains("custom") &&
         (required == problem.require.end() || required->second.contains("custom"));
}

std::vector<Family> LineFamilies() {
  std::vector<Family> families;
  for (const FamilySpec& spec : Families())
    if (spec.in_line) families.push_back(spec.family);
  return InOrder(std::move(families));
}

bool IsInSource(const Problem& problem, Configuration configuration, const FamilySpec& spec) {
  return spec.InSourceOf(configuration) || (spec.on_rail && PumpsRail(problem));
}

std::vector<Family> SourceFamilies(const Problem& problem, Configuration configuration) {
  std::vector<Family> families;
  for (const FamilySpec& spec : Families())
    if (IsInSource(problem, configuration, spec)) families.push_back(spec.family);
  return InOrder(std::move(families));
}

}  // namespace plenum::optimizer
