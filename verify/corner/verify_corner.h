// What this side can say of a box from the raw parts alone. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_CORNER_H_
#define PLENUM_VERIFY_CORNER_VERIFY_CORNER_H_

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "verify/corner/verify_best.h"
#include "verify/corner/verify_direct.h"
#include "verify/corner/verify_least_line.h"
#include "verify/corner/verify_least_rail.h"
#include "verify/corner/verify_line.h"
#include "verify/corner/verify_pump.h"
#include "verify/design/verify_choice.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// The least amounts of a slot's choices in a range, the objective's share and its spread.
struct LeastAmounts {
  ItemAmounts least{kUnlimited, kUnlimited, kUnlimited, kUnlimited};
  double objective_most = -kUnlimited;
};

// Keeps what it found: boxes of one tree share most of their ranges.
class Corners {
 public:
  Corners(const Problem& problem, const ProofPlan& plan, KnownStrokes& strokes);
  Corners(const Corners&) = delete;  // its pumps look at its amounts

  // No choices in the box fit together.
  bool CannotMate(const Ranges& ranges);

  // Every design in the box has at least this objective; +∞ where no combination works. It is
  // looked at closely only as long as it is not above `enough`.
  double LeastObjective(const Ranges& ranges, double enough);

  const LeastAmounts& Least(const Ranges& ranges, int slot);

 private:
  using SlotRange = std::array<int, 3>;  // slot, first, last

  bool SourceMates(const Ranges& ranges) const;
  bool SourceMates(const Ranges& ranges, const ProofItem& pump_or_regulator) const;
  // Of all groups, or where they have their own of this one.
  int RegulatorSlot(int group) const;
  ItemAmounts LeastAmountsBut(const Ranges& ranges, int slot);  // that one left out
  double LeastRegulated(const Ranges& ranges, double chosen);
  struct Stored {
    double air_m3;    // per cycle
    double energy_j;  // of the mission
  };
  struct SourceBounds {
    BestNumbers regulator;
    double low_pa = 0.0, high_pa = kUnlimited, flow_max = kUnlimited;
    bool some_open = false, all_open = false;  // a tank without a regulator
  };
  // Of the source, or behind the group's own regulator.
  SourceBounds SourceOf(const Ranges& ranges, int group);
  // Of all regulators: the highest of the pressures behind them, at least; what they ask in front
  // of them; their power.
  struct Inlets {
    double low_pa = 0.0, min_pa = 0.0, max_pa = kUnlimited, electrical_w = 0.0;
  };
  static Inlets InletsOf(const std::vector<SourceBounds>& sources);
  double LeastTank(const Ranges& ranges, const Inlets& inlets, const SourceBounds& source,
                   double air_m3);
  double LeastRefilled(const Ranges& ranges, const Inlets& inlets, double air_m3, double energy_j);
  double LeastBattery(const Ranges& ranges, double energy_j);
  // `sum` with the least of the bottles and batteries that hold so much.
  double LeastStores(const Ranges& ranges, const Inlets& inlets, const Stored& stored, double sum);

  // By how much more than its parts at their least a line of the group weighs that works alone
  // behind its regulator; and the lines of all groups, each with some reservoir's pressure at which
  // the others' lines work as well.
  double ExcessBehind(const Ranges& ranges, int group, const SourceBounds& source);
  double ExcessOnPumps(const Ranges& ranges, const std::vector<const BestLine*>& lines);
  // Of the most actuators of a group that fill at once behind the regulator, at least; +∞: later
  // than its limits.
  double InflateSeconds(const BestLine& line, int group, const SourceBounds& source,
                        const std::pair<int, int>& regulators);

  const Problem& problem_;
  const ProofPlan& plan_;
  KnownStrokes& strokes_;
  bool shared_;          // groups inflate at once at the node behind a regulator
  SlotAmounts amounts_;  // per slot and choice
  std::vector<std::unordered_map<std::uint64_t, LeastAmounts>> least_;  // per slot, by range
  std::map<SlotRange, Packs> packs_;
  std::map<std::tuple<const BestLine*, int, int, double>, double> inflate_s_;
  LeastLines least_lines_;
  LeastRails rails_;
  std::optional<Pumps> pumps_;
  std::optional<PumpChoices> fillers_;
  std::optional<DirectPumps> direct_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_CORNER_H_
