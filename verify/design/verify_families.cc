#include "verify/design/verify_families.h"

#include <cmath>
#include <map>

namespace plenum::verify {

const model::PartBasics* BasicsOf(const Problem& problem, Family family, int part) {
  const model::Parts& parts = problem.parts;
  switch (family) {
    case Family::kTubing:
      return &parts.tubing[part].per_metre;
    case Family::kFitting:
      return &parts.fittings[part].basics;
    case Family::kValve:
      return &parts.valves[part].basics;
    case Family::kCompressor:
      return &parts.compressors[part].basics;
    case Family::kCylinder:
      return &parts.cylinders[part].basics;
    case Family::kCo2:
      return &parts.co2[part].basics;
    case Family::kBattery:
      return &parts.batteries[part].basics;
    case Family::kRegulator:
      return &parts.regulators[part].basics;
    case Family::kReservoir:
      return &parts.reservoirs[part].basics;
  }
  return nullptr;
}

int FamilySize(const Problem& problem, Family family) {
  const model::Parts& parts = problem.parts;
  const std::map<Family, std::size_t> sizes{
      {Family::kTubing, parts.tubing.size()},       {Family::kFitting, parts.fittings.size()},
      {Family::kValve, parts.valves.size()},        {Family::kCompressor, parts.compressors.size()},
      {Family::kCylinder, parts.cylinders.size()},  {Family::kCo2, parts.co2.size()},
      {Family::kBattery, parts.batteries.size()},   {Family::kRegulator, parts.regulators.size()},
      {Family::kReservoir, parts.reservoirs.size()}};
  return static_cast<int>(sizes.at(family));
}

int QuantityMax(const Problem& problem, Family family) {
  switch (family) {
    case Family::kCompressor:
      return problem.limits.compressors;
    case Family::kBattery:
      return problem.limits.batteries;
    case Family::kCylinder:
      return problem.limits.cylinders;
    case Family::kCo2:
      return problem.limits.co2;
    case Family::kReservoir:
      return problem.limits.reservoirs;
    default:
      return 1;
  }
}

std::vector<Family> SourceFamilies(Configuration configuration) {
  switch (configuration) {
    case Configuration::kCylinder:
      return {Family::kRegulator, Family::kCylinder, Family::kBattery};
    case Configuration::kCo2:
      return {Family::kRegulator, Family::kCo2, Family::kBattery};
    case Configuration::kCompressor:
      return {Family::kCompressor, Family::kReservoir, Family::kBattery};
    case Configuration::kMains:
      return {Family::kRegulator};
  }
  return {};
}

bool MadeReservoirAllowed(const Problem& problem) {
  const auto required = problem.require.find(Family::kReservoir);
  return !problem.exclude.contains("custom") &&
         (required == problem.require.end() || required->second.contains("custom"));
}

BigCount Combinations(const Problem& problem, Configuration configuration) {
  BigCount count = 1;
  for (const ActuatorGroup& group : problem.groups) {
    count *= FamilySize(problem, Family::kTubing);
    count *= FamilySize(problem, Family::kValve);
    if (group.fittings_per_line > 0) count *= FamilySize(problem, Family::kFitting);
  }
  for (Family family : SourceFamilies(configuration)) {
    const bool made = family == Family::kReservoir && MadeReservoirAllowed(problem);
    count *= FamilySize(problem, family) * QuantityMax(problem, family) + (made ? 1 : 0);
  }
  return count;
}

std::vector<ProofItem> EntriesOf(const Problem& problem, const ProofSlot& slot) {
  if (slot.family == Family::kFitting && problem.groups[slot.group].fittings_per_line == 0)
    return {{-1, 0}};
  const bool cost = problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
  std::vector<ProofItem> entries;
  for (int part = 0; part < FamilySize(problem, slot.family); ++part)
    for (int quantity = 1; quantity <= QuantityMax(problem, slot.family); ++quantity)
      if (!cost || BasicsOf(problem, slot.family, part)->cost_eur)
        entries.push_back({part, quantity});
  if (slot.family == Family::kReservoir && MadeReservoirAllowed(problem) && !cost)
    entries.push_back({-2, 1});
  return entries;
}

}  // namespace plenum::verify
