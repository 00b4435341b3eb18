// Boxes of combinations and what is known of everything in them.
//
// A box is one node of every slot's tree. Assess() looks at its corner, the combination of the best
// numbers that its choices have: if that misses a requirement so does every combination in the box,
// and its objective bounds theirs from below. As a box is divided its corner comes closer to real
// combinations, up to a single one.
//
// box.cc: boxes and their division. bounds_lines.cc: lines, whatever the source.
// group_lines.cc: lines of several groups at a common node. bounds_regulated.cc: cylinder, CO2
// and mains. bounds_compressor.cc: compressor, and pumps without a reservoir. bounds_volumes.cc:
// reservoirs. core_sizing.cc: made-to-measure reservoirs.
#ifndef PLENUM_OPTIMIZER_BOUNDS_BOX_H_
#define PLENUM_OPTIMIZER_BOUNDS_BOX_H_

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "optimizer/bounds/group_lines.h"
#include "optimizer/bounds/line_parts.h"
#include "optimizer/choices/known_lines.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/choices/plan.h"
#include "optimizer/choices/shared.h"
#include "optimizer/evaluate/evaluate.h"
#include "optimizer/pump/direct_bound.h"

namespace plenum::optimizer {

struct CoreSizing;

// Some of the reservoirs that a box may have: a node of their tree, of a made-to-measure one an
// interval of volumes.
struct VolumeNeed {
  int node = 0;
  ReservoirNeed need;
  double objective = 0.0;   // of a reservoir in it, at least
  double rest = 0.0;        // of reservoir, battery and energy, at least
  double with_lines = 0.0;  // the same with the lines, whose coils the battery feeds
  int look = -1;            // Box::look when it was looked at; less: in a larger box, still a bound
  int rest_look = -1;       // the same of Box::rest_look, for rest and with_lines
  bool energy_known = false;  // by LeastMissionEnergy(), in that look
  int battery = -1;  // node of one that was the least that will do, here or in a larger box
};

// What a box is divided for, which says what comes first: a design that is soon found, where
// bottles and batteries come last, by what they must bear; a proof, where tanks that pumps go on
// filling come before the lines, since what pumps and packs must bear depends on them; or a proof
// of kinds, where what decides the kind comes before all else.
enum class DivideFor { kDesigns, kProof, kKinds };

struct Box {
  // Without a place of their own in memory for one group, since boxes are many.
  boost::container::small_vector<int, kSlotsPerGroup + 3> nodes;  // per slot
  // Per group; empty before the first Assess() and once forgotten.
  boost::container::small_vector<std::shared_ptr<const Line>, 1> lines;
  bool lines_finished = false;                               // by FinishLine()
  std::shared_ptr<const std::vector<LineChoice>> choices;    // of all lines together, once finished
  double bound = 0.0;                                        // of the objective
  Window window{0.0, 0.0};                                   // source pressures
  double source_floor_pa = 0.0, source_cap_pa = kUnlimited;  // as in Candidate
  double air_m3 = 0.0;                                       // per cycle
  double coil_power_w = 0.0;                                 // with the regulator's
  double energy_j = 0.0;                    // of the mission; without a compressor's reservoir
  double energy_beyond_j = 0.0;             // what of it the shares of the choices do not count
  Shared<std::vector<VolumeNeed>> volumes;  // compressor
  std::size_t lowest = 0;                   // of them: whose bound is that of the box
  double forgotten = kUnlimited;            // least bound of those that the list lacks
  int look = 0;                             // grows where the needs of volumes may have grown
  int rest_look = 0;                        // grows where what is added to these may have
  std::size_t needs_of = 0, rest_of = 0;    // hashes of what the two depend on
  double volume_ratio_max = 0.0;            // of the ends of an interval of made-to-measure volumes
  bool source_bounded = false;              // from below, for the real parts; regulated
  bool source_known = false;                // the least source pressure is that of the real parts
  std::shared_ptr<CoreSizing> core;         // shared by all that differ in the battery alone
};

std::vector<ReservoirNeed> NeedsOf(const Box& box);
// Of the packs of a single combination (packs.h); 0 for a box of several.
double PackSurplus(const Problem& problem, const Plan& plan, const Box& box);
// Puts the choices of all lines together.
void CombineChoices(Box& box);
double LinesObjective(const Box& box);

// Of all coils of a box per cycle, whatever the strokes, J.
double CoilEnergy(const Problem& problem, const Box& box);

class Bounds {
 public:
  // `bench`: handed to the candidates; may be null. `useful`: amounts that are of interest, a limit
  // like the problem's; what it accepts must not cease to be accepted with less of an amount.
  Bounds(const Problem& problem, const Plan& plan, const Workbench* bench = nullptr,
         std::function<bool(const Amounts&)> useful = {});

  const Plan& plan() const { return plan_; }

  Box Root() const;  // all combinations, not assessed yet

  // What the corner misses, or kNone with box.bound raised. `changed`: the slot that differs from
  // the box that was assessed before, or −1 for all.
  Constraint Assess(Box& box, int changed);

  // The same of an assessed box after the problem's limits on amounts have fallen.
  Constraint Reassess(Box& box);

  // The problem's objective has other weights of the amounts, and so has the plan (reweigh.h): what
  // is known of boxes but for their bounds stays, and Reweigh() finds those.
  void ChangeWeights() {
    ++weights_;
    if (groups_) groups_->ChangeWeights();
  }
  Constraint Reweigh(Box& box);

  Amounts LeastOfAll(const Box& box) const;  // sums of the least of each slot
  // The same of an assessed box, with the least of the reservoirs that it may still have.
  Amounts LeastAssessed(const Box& box) const;

  // What raises the bound of a box without dividing it, step by step: a look at the reservoirs that
  // its bound comes from; once all but bottle and battery are single choices their source pressure,
  // bounded by enclosures of the strokes and then found for good at a hundred times the cost, or
  // finer intervals of made-to-measure volumes, and where energy counts the best settings of those
  // with any battery (core_sizing.h). What was forgotten is found anew first.
  bool CanFindSource(const Box& box) const;
  Constraint FindSource(Box& box);

  // To save room: lets go of reservoirs whose bound is above `objective`, and of all but the bound
  // where that of the box is. The bound stays one; LeastAssessed() must not be asked any more.
  void Forget(Box& box, double objective) const;

  bool IsSingle(const Box& box) const;
  // The slot to divide: of those that decide the source pressure the one whose choices differ most
  // in their share of the objective, then bottles and batteries.
  int WidestSlot(const Box& box, DivideFor divide_for) const;
  BigCount Count(const Box& box) const;
  // Whether each combination comes behind as many better ones as are wanted, by the choices that
  // dominate its own (dominance.h).
  bool IsOutdone(const Box& box) const;

  Candidate CandidateOf(const Box& box) const;

  // Each group's lines by themselves; of several groups.
  GroupLines& groups() { return *groups_; }

 private:
  // A box of lines: a node of each of the group's trees.
  struct LineKey {
    int group = 0;
    KnownLines::Nodes nodes{};
    bool operator>(const LineKey& other) const {
      return std::tie(group, nodes) > std::tie(other.group, other.nodes);
    }
  };
  LineParts PartsOf(const LineKey& key) const;

  const BoxNode& Node(const Box& box, int slot) const {
    return (*plan_.slots[slot].nodes)[box.nodes[slot]];
  }
  template <typename Corner>
  const Corner& CornerAt(const BoxTree<Corner>& tree, const Box& box, int slot) const {
    return tree.corners[box.nodes[slot]];
  }
  const Option& OptionOf(const Box& box, int slot) const {
    return (*plan_.slots[slot].options)[Node(box, slot).first];
  }
  bool DecidesSource(int slot) const {
    return slot != plan_.bottle_slot && slot != plan_.battery_slot && !plan_.rail.Has(slot) &&
           (slot != plan_.compressor_slot || IsPumped(plan_.configuration));
  }
  bool CoreIsSingle(const Box& box, int except = -1) const;

  // The line of a box of lines, for all boxes that have it.
  struct MadeLine {
    LineKey key;
    std::shared_ptr<Line> line;
    bool finished = false;  // by FinishLine()
    bool least = false;     // its objective is by FindChoices(), else that of its corner
    int weights = 0;        // that the objective has
  };
  // What is known of a box of lines, whatever the source. `whole`: one that misses nothing and of
  // which it is a part; null where none is at hand.
  KnownLines::Known Know(const LineKey& key, const LineParts* whole = nullptr);
  Constraint Screen(const LineKey& key, const LineParts& parts, const LineParts* whole) const;
  // Of one that misses nothing; until the next call.
  MadeLine& LineOf(const LineKey& key, KnownLines::Known known);
  MadeLine& Keep(const LineKey& key, std::shared_ptr<Line> line);
  double ObjectiveKnown(const LineParts& parts, KnownLines::Known known) const;
  Constraint FindLeast(const LineKey& key, MadeLine& made);
  void TakeChoices(MadeLine& made, std::vector<LineChoice> choices) const;
  void TakeOver(const Line& whole, const LineParts& parts, MadeLine& made) const;
  void ForgetLines();
  std::shared_ptr<Line> Assemble(const LineKey& key) const;
  Constraint FindChoices(const LineKey& key, std::vector<LineChoice>& choices);
  static LineKey KeyOf(const Box& box, int group);
  Constraint RemakeLine(Box& box, int group);
  Constraint FinishLines(Box& box);
  bool WithinLimits(Amounts amounts, const Amounts& more = {}) const;
  Amounts LeastBesidesBattery(const Box& box) const;
  void AddLines(Box& box) const;  // window, coils

  Constraint AssessRegulated(Box& box, bool source_changed);
  Constraint NeedOfRegulated(Box& box);
  double RegulatedFloor(const Box& box) const;
  Constraint RestOfRegulated(Box& box);

  bool PackDrivesPump(const Box& box) const;
  Constraint NeedOfDirect(Box& box);
  Constraint AssessCompressor(Box& box, int changed);
  Constraint NeedOfCompressor(Box& box) const;
  void RenewLooks(Box& box) const;
  void RestrictVolumes(Box& box) const;
  bool IsWide(const Box& box, const VolumeNeed& volume) const;
  static bool IsLookedAt(const Box& box, const VolumeNeed& volume) {
    return volume.look == box.look && volume.rest_look == box.rest_look;
  }
  bool IsSettled(const Box& box, const VolumeNeed& volume) const;
  // Of the objective of all but the compressor, with these reservoirs.
  static double BoundOf(double lines, const VolumeNeed& volume) {
    return std::max(lines + volume.rest, volume.with_lines);
  }
  static std::size_t Lowest(const Box& box);
  Constraint LookAtLowest(Box& box);
  std::optional<VolumeNeed> LookAt(const Box& box, VolumeNeed volume);
  double TotalOf(const Box& box, const VolumeNeed& volume) const;
  bool IsForgotten(const Box& box) const;
  bool IsMade(const VolumeNeed& volume) const;
  Amounts LeastOf(const VolumeNeed& volume) const;
  double Spread(const VolumeNeed& volume) const;
  std::vector<VolumeNeed> Halves(const VolumeNeed& volume) const;
  void BoundRest(const Box& box, VolumeNeed& volume);
  Constraint RestOfCompressor(Box& box);
  const PumpFacts& PumpOf(const Box& box);
  Constraint FindStockSource(Box& box);
  double LeastEnergy(const Candidate& candidate, OperatingPoint point,
                     const Evaluation& least) const;
  Constraint RefineVolumes(Box& box);
  bool CanSizeCore(const Box& box) const;
  Constraint SizeCore(Box& box);

  // What batteries must bear; `others`: what the rest of the design at least amounts to.
  struct BatteryLoad {
    double energy_j = 0.0, pump_current_a = 0.0, coil_power_w = 0.0;
    Amounts others;
  };
  // The least share of the objective of a battery that bears so much. `known`: a battery that was
  // the least in a larger box, as a node, and is so here if it still will do; −1 where none is
  // known.
  double LeastBattery(const Box& box, const BatteryLoad& load, int& known) const;
  // The least of a battery and the lines, whose coils it feeds. `load`: with the coils of the box
  // at their least, for which `battery` is the least.
  double LeastWithLines(const Box& box, const BatteryLoad& load, double battery) const;
  double EnergyShare(double energy_j) const;

  const Problem& problem_;
  const Plan& plan_;
  const Workbench* bench_;
  std::function<bool(const Amounts&)> useful_;
  std::vector<KnownLines> lines_;  // per group
  std::vector<MadeLine> made_;     // of them
  // Of several groups. `shared_`: they inflate at once, at the node behind a regulator; the wall's
  // vacuum has none that would hold any of them back.
  std::unique_ptr<GroupLines> groups_;
  bool shared_;
  bool limited_;              // in amounts
  double highest_source_pa_;  // that all groups stand
  int weights_ = 0, strokes_ = 0;
  // Per node of the compressors' tree: with boxes of lines, with single lines.
  std::unordered_map<int, PumpFacts> pumps_, chosen_pumps_;
  DirectBounds direct_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_BOX_H_
