#include "tests/support/packs/packs_by_hand.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "optimizer/problem/family_specs.h"
#include "tests/support/random_parts.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Family;
using optimizer::Line;
using optimizer::Option;
using optimizer::Problem;

void SellInPacks(std::uint64_t seed, bool joints, Problem& problem) {
  Random random(seed);
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    if (spec.joins && !joints) continue;
    for (int part = 0; part < FamilySize(problem.parts, spec.family); ++part) {
      model::PartBasics& basics = BasicsOf(problem.parts, spec.family, part);
      if (!Chance(random, 0.7)) continue;
      basics.pack = spec.family == Family::kTubing ? Uniform(random, 0.3, 6.0)
                                                   : static_cast<double>(Pick(random, 2, 12));
    }
  }
  problem.parts.tanks = problem.parts.reservoirs;
}

double SurplusByHand(const Problem& problem, const Candidate& candidate) {
  std::map<std::string, std::pair<const model::PartBasics*, double>> needs;
  const auto need = [&](const model::PartBasics& basics, double pieces) {
    auto& entry = needs[basics.id];
    entry.first = &basics;
    entry.second += pieces;
  };
  for (std::size_t g = 0; g < candidate.lines.size(); ++g) {
    const Line& line = *candidate.lines[g];
    const optimizer::ActuatorGroup& group = problem.groups[g];
    const model::Valve& valve = problem.parts.valves[line.valve];
    need(valve.basics, std::ceil(static_cast<double>(group.count) / valve.channels));
    if (line.fitting >= 0)
      need(problem.parts.fittings[line.fitting].basics, group.count * group.fittings_per_line);
    need(problem.parts.tubing[line.tubing].per_metre, group.count * group.tube_length_m);
  }
  const auto add = [&](const auto& family, const Option& option, int times = 1) {
    if (option.index >= 0) need(family[option.index].basics, option.quantity * times);
  };
  add(problem.parts.regulators, candidate.regulator);
  if (candidate.configuration == Configuration::kCylinder)
    add(problem.parts.cylinders, candidate.bottle);
  if (candidate.configuration == Configuration::kCo2) add(problem.parts.co2, candidate.bottle);
  if (HasTank(candidate.configuration)) add(problem.parts.tanks, candidate.bottle);
  add(PumpsOf(problem, candidate.configuration), candidate.compressor, FeedsByHand(problem));
  add(problem.parts.batteries, candidate.battery);
  add(problem.parts.reservoirs, candidate.reservoir);
  add(problem.parts.vacuum_pumps, candidate.rail.pump);
  add(problem.parts.reservoirs, candidate.rail.reservoir);
  double surplus_eur = 0.0;
  for (const auto& [id, entry] : needs) {
    const auto& [basics, pieces] = entry;
    if (!basics->cost_eur || !(basics->pack > 0.0)) continue;
    int packs = 0;
    while (packs * basics->pack < pieces - 1e-9) ++packs;
    surplus_eur += (packs * basics->pack - pieces) * *basics->cost_eur;
  }
  return surplus_eur;
}

}  // namespace plenum::test
