#include "verify/verify_worlds.h"

#include <optional>
#include <string>

#include "verify/design/cycle/verify_cycle.h"
#include "verify/design/cycle/verify_gait.h"
#include "verify/design/verify_list.h"
#include "verify/design/verify_supply.h"

namespace plenum::verify {
namespace {

// What a design misses in a world, or nothing; none where the simulator does not tell.
std::optional<std::string> Missed(const Problem& world, const Design& design, const Stop& stop) {
  Findings findings;
  std::optional<Assembly> assembly = Assemble(world, design, findings);
  if (!assembly) return findings.front().detail;
  if (!Fit(world, *assembly)) return "parts of the source do not fit";
  Settings settings = design.settings;
  if (assembly->reservoir) settings.reservoir_volume_m3 = assembly->ReservoirVolume();
  if (!Stand(world, settings, *assembly)) return "the parts do not stand the source pressure";
  const std::optional<Cycle> cycle = SimulateCycle(world, settings, *assembly, stop);
  if (!cycle) return std::nullopt;
  const double slack = 1.0 + kTimeTolerance;
  for (int g = 0; g < static_cast<int>(world.groups.size()); ++g)
    if (cycle->inflate_s[g] > FillWindow(world, g) * slack ||
        cycle->fall_s[g] > VentWindow(world, g) * slack)
      return world.groups[g].name + ": a stroke takes longer than its window";
  const Supply supply = SupplyOf(world, settings, *assembly, *cycle);
  if (assembly->battery && supply.current_a > assembly->batteries *
                                                  assembly->battery->current_max_a *
                                                  (1.0 + kEnergyTolerance))
    return "the batteries do not give the current";
  const Totals totals = TotalsOf(world, *assembly, settings);
  for (const auto& [pointer, reached] :
       Requirements(world, settings, totals, *assembly, *cycle, supply))
    if (reached.margin() < -reached.tolerance)
      return pointer + ": " + std::to_string(reached.achieved) + " for " +
             std::to_string(reached.required);
  return "";
}

}  // namespace

Verification VerifyWorlds(const Problem& problem, const std::vector<Design>& designs, int worlds,
                          const DrawParts& parts_of_world, const Stop& stop) {
  Problem world = problem;
  Findings findings;
  int open = 0;
  for (std::size_t i = 0; i < designs.size(); ++i)
    for (int w = 0; w < worlds; ++w) {
      if (Stopped(stop)) {
        ++open;
        continue;
      }
      world.parts = parts_of_world(designs[i], w);
      const std::optional<std::string> missed = Missed(world, designs[i], stop);
      if (!missed)
        ++open;
      else if (!missed->empty())
        findings.push_back({"worlds", "rank " + std::to_string(i + 1) + ", world " +
                                          std::to_string(w + 1) + ": " + *missed});
    }
  std::vector<NotRechecked> not_rechecked;
  if (open > 0) not_rechecked.push_back({"designs in corners of their tolerances", open});
  const CheckNames names{{"worlds", "designs hold in corners of their parts' tolerances"}};
  return {Gather(names, findings), not_rechecked, {}};
}

}  // namespace plenum::verify
