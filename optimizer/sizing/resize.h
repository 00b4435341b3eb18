// A given set of parts sized anew: the settings are tuned again to a problem whose requirements, or
// whose parts' numbers, are not those the design was made for.
#ifndef PLENUM_OPTIMIZER_SIZING_RESIZE_H_
#define PLENUM_OPTIMIZER_SIZING_RESIZE_H_

#include <functional>
#include <optional>
#include <vector>

#include "model/simulate/simulate_rig.h"
#include "optimizer/sizing/custom_sizing.h"

namespace plenum::optimizer {

// The problem with no parts but those of the design.
Problem WithPartsOf(const Problem& problem, const Design& design);

// Sizes the design's parts, found in the problem by their ids, with the evaluation that ranks
// (candidate.h). A made-to-measure reservoir is sized, too, unless the problem has a stock
// reservoir with the id "custom". Infeasible where a line misses its limits on any source or where
// a part is missing, undecided where `stop` says so. Whether the parts fit together is not asked
// again.
Leaf Resize(const Problem& problem, const Design& design, const std::function<bool()>& stop = {});

// The design with its parts as bought, volume of a made-to-measure reservoir included, and its
// settings sized anew; made by MakeDesign (report.h). None where that is not proved feasible.
std::optional<Design> WithSettingsAnew(const Problem& problem, const Design& design,
                                       const std::function<bool()>& stop);

// The design's parts with other settings.
struct Remade {
  LeafStatus status = LeafStatus::kUndecided;
  std::optional<Design> design;  // kFeasible
};

// At the settings that suit them best; a made-to-measure reservoir is sized, too, but under a
// revised model.
Remade AtBestSettings(const Problem& problem, const Design& design,
                      const std::function<bool()>& stop);

// Under a revised model: sized by SizeWithEffects (effect_sizing.h) and made anew. `relaxed`
// (relaxation.h) says what a line can do at best, the design comes from there.
Remade Remake(const Problem& problem, const Problem& relaxed, const Design& design,
              const std::function<bool()>& stop);

// Margins of the design's parts at its own settings under the problem's effects; none where a
// stroke is never completed, or where it was told to stop.
std::optional<std::vector<Margin>> MarginsOf(const Problem& problem, const Problem& relaxed,
                                             const Design& design,
                                             const std::function<bool()>& stop);

// The design's parts at its own settings, whatever they meet: totals, performance and margins,
// negative where a requirement is missed. No design where a part is missing, where the parts do not
// stand the source pressure, where a stroke takes longer than half of the period, or where that is
// not known.
struct AtSettings {
  Window source{kUnlimited,
                -kUnlimited};  // pressures that the parts stand; empty: a part is missing
  bool unknown = false;        // the strokes' periodic state was not found, or `stop` said so
  std::optional<Design> design;
};
AtSettings EvaluateAtSettings(const Problem& problem, const Design& design,
                              const std::function<bool()>& stop = {});

// The design's parts at its own settings as what a robot drives.
struct DrivenDesign {
  model::Rig rig;  // one group for each actuator, without commands; full source, all at ambient
  std::vector<double> coil_power_w;  // of each actuator's valve while energised
  std::vector<bool> holds;           // each actuator's valve
  double regulator_power_w = 0.0;
  double energy_available_j = kUnlimited;
  double air_available_m3 = kUnlimited;  // ANR, on board
};
// None where a part is missing, where the design does not work as it was asked to, or where groups
// have regulators of their own.
std::optional<DrivenDesign> Drive(const Problem& problem, const Design& design,
                                  const std::function<bool()>& stop = {});

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_RESIZE_H_
