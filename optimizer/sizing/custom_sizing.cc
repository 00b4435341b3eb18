#include "optimizer/sizing/custom_sizing.h"

#include <algorithm>
#include <cmath>

#include "model/physics/storage.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/sizing/sizing_program.h"

namespace plenum::optimizer {
namespace {

// Of the objective; all are less than what tells designs apart.
constexpr double kTolerance = 1e-7, kEnergyTolerance = 4e-7, kLateTolerance = 8e-7;
constexpr int kLateSteps = 1000;
constexpr int kStepsPerRefine = 4;
constexpr int kOfferEvaluationsMax = 300;  // a point is wanted; rectangles prove it
constexpr int kFirstOfferSteps = 100;
constexpr int kStepsMax = 40000, kEnergyStepsMax = 2500;
constexpr double kPressureShare = 0.1;  // of the width of the volumes, to which p1 is raised
constexpr double kFinest = 1e-10;       // relative width that is not divided any more
constexpr double kRounding = 1e-12;     // of a margin
constexpr double kMostMore = 1e-6;      // volume, relative
constexpr double kFirstNarrow = 2e-3, kNarrower = 0.125;

double Width(double low, double high) { return high / low - 1.0; }

}  // namespace

std::vector<ReservoirNeed> NeedsOfCandidate(const Problem& problem, const Candidate& candidate) {
  const PumpFacts facts =
      MakePumpFacts(problem, ChosenPump(problem, candidate).curve, candidate.compressor.quantity);
  double energy_j = kUnlimited;
  if (candidate.battery.index != kNone) {
    const model::Battery& battery = problem.parts.batteries[candidate.battery.index];
    energy_j = candidate.battery.quantity *
               model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v);
  }
  return ReservoirNeeds(problem, facts, candidate, energy_j, model::kMadeReservoirSmallestM3,
                        model::kMadeReservoirLargestM3);
}

CustomSizing::CustomSizing(const Problem& problem, const Candidate& candidate)
    : CustomSizing(problem, candidate, NeedsOfCandidate(problem, candidate)) {}

CustomSizing::CustomSizing(const Problem& problem, Candidate candidate,
                           const std::vector<ReservoirNeed>& needs)
    : problem_(problem),
      candidate_(std::move(candidate)),
      trend_(MakePumpTrend(problem, candidate_)),
      tolerance_(problem.objective.energy_wh > 0.0 ? kEnergyTolerance : kTolerance) {
  leaf_.objective = kUnlimited;
  const Window window = SourceWindow(problem_, candidate_);
  for (const ReservoirNeed& need : needs) {
    Region region;
    region.box = {need.low_m3, need.high_m3, std::max(need.source_pa, window.low_pa),
                  std::min(need.source_max_pa, window.high_pa)};
    if (region.box.low_pa > region.box.high_pa) continue;
    Evaluation least;
    least.energy_total_j = need.energy_j;
    region.bound =
        ObjectiveValue(problem_, candidate_, {region.box.low_pa, need.low_m3, need.low_m3}, least);
    open_.push(region);
  }
  leaf_.lower_bound = open_.empty() ? 0.0 : open_.top().bound;
}

bool CustomSizing::Refine() {
  for (int step = 0; step < kStepsPerRefine && !Decided() && !candidate_.stopped(); ++step) {
    const Region region = open_.top();
    open_.pop();
    if (!region.examined) {
      Examine(region);
    } else {
      OfferIfNarrow(region);
      Divide(region);
    }
    ++steps_;
    if (steps_ == kLateSteps) tolerance_ = std::max(tolerance_, kLateTolerance);
    const bool energy = problem_.objective.energy_wh > 0.0;
    failed_ = failed_ || steps_ >= (energy ? kEnergyStepsMax : kStepsMax);
    if (failed_ && !candidate_.stopped()) return Conclude(LeafStatus::kUndecided);
  }
  if (Decided()) return Conclude(LeafStatus::kInfeasible);
  leaf_.lower_bound = open_.top().bound;
  return false;
}

bool CustomSizing::Decided() const {
  return !failed_ && (open_.empty() || open_.top().bound >= leaf_.objective * (1.0 - tolerance_));
}

// The bound stands where a solver failed: the leaf is as good as the best point, with a gap.
bool CustomSizing::Conclude(LeafStatus without_point) {
  const bool found = std::isfinite(leaf_.objective);
  leaf_.status = found ? LeafStatus::kFeasible : without_point;
  if (!open_.empty()) leaf_.lower_bound = std::min(leaf_.objective, open_.top().bound);
  if (open_.empty() && found) leaf_.lower_bound = leaf_.objective;
  return true;
}

// Queues what the bounds leave of a rectangle.
void CustomSizing::Examine(Region region) {
  region.examined = true;
  const SettingsBox& box = region.box;
  if (!WithinLimits({box.low_pa, box.low_m3, box.low_m3})) return;
  const double tolerance = std::clamp(kPressureShare * Width(box.low_m3, box.high_m3), 1e-10, 1e-2);
  const LeafStatus driven = RaisePressure(problem_, candidate_, region.box, tolerance);
  if (driven == LeafStatus::kInfeasible) return;
  failed_ = failed_ || driven == LeafStatus::kUndecided;
  if (failed_ || Judge(region, tolerance)) open_.push(region);
}

bool CustomSizing::WithinLimits(const OperatingPoint& least) const {
  const Amounts total = TotalAmounts(problem_, candidate_, least);
  return total.mass_kg + total.mass_slack_kg <= problem_.mass_max_kg &&
         (total.volume_m3 + total.volume_slack_m3) * 1e3 <= problem_.volume_max_l;
}

// Raises the rectangle's bound and lowers its highest pressure to what the supply bears; false
// where it bears none.
bool CustomSizing::Judge(Region& region, double tolerance) {
  SettingsBox& box = region.box;
  for (bool lowered = true; lowered;) {
    lowered = false;
    const Strokes fastest = FastestStrokes(problem_, candidate_, box);
    failed_ = failed_ || fastest.failed;
    if (failed_) return true;
    LeastEvaluation bounds;
    double objective = 0.0;
    // How far the bounds from a pressure up are from closing the rectangle there.
    const auto room = [&](double low_pa) {
      SettingsBox part = box;
      part.low_pa = low_pa;
      bounds = LeastOver(problem_, candidate_, trend_, part, fastest);
      failed_ = failed_ || bounds.least.failed;
      const OperatingPoint judged{part.low_pa, part.low_m3, part.low_m3};
      objective = ObjectiveValue(problem_, candidate_, judged, bounds.least);
      return std::min(SupplyMargin(problem_, candidate_, judged, bounds.least) + kRounding,
                      1.0 - objective / leaf_.objective);
    };
    const double room_low = room(box.low_pa);
    if (failed_) return true;
    if (!(room_low > 0.0)) return false;
    region.bound = std::max(region.bound, objective);
    region.pressures_differ = bounds.pressures_gap_j > bounds.volumes_gap_j;
    if (!(Width(box.low_pa, box.high_pa) > tolerance)) return true;
    const double room_high = room(box.high_pa);
    if (room_high > 0.0 || failed_) return true;
    const double before_pa = box.high_pa;
    box.high_pa = NarrowBracket(room, box.low_pa, room_low, box.high_pa, room_high, tolerance).high;
    lowered = before_pa - box.high_pa > 0.5 * (before_pa - box.low_pa);
  }
  return true;
}

void CustomSizing::Divide(const Region& region) {
  const SettingsBox& box = region.box;
  const double pressures = Width(box.low_pa, box.high_pa);
  const double volumes = Width(box.low_m3, box.high_m3);
  Region lower = region, upper = region;
  lower.examined = upper.examined = false;
  if (pressures > kFinest &&
      ((region.pressures_differ && pressures > kPressureShare * volumes) || !(volumes > kFinest))) {
    lower.box.high_pa = upper.box.low_pa = 0.5 * (box.low_pa + box.high_pa);
  } else if (volumes > kFinest) {
    lower.box.high_m3 = upper.box.low_m3 = std::sqrt(box.low_m3 * box.high_m3);
  } else {
    failed_ = true;  // too small to tell
    open_.push(region);
    return;
  }
  open_.push(lower);
  open_.push(upper);
}

void CustomSizing::OfferIfNarrow(const Region& region) {
  const double width = Width(region.box.low_m3, region.box.high_m3);
  const bool narrow = width <= kFirstNarrow && (width <= narrow_ || steps_ >= next_offer_);
  const bool empty_handed =
      std::isinf(leaf_.objective) && steps_ >= std::max(kFirstOfferSteps, next_offer_);
  if (!narrow && !empty_handed) return;
  narrow_ = kNarrower * width;
  next_offer_ = 2 * steps_;
  if (Offer(ALittleMore(region.box.high_m3))) Polish();
}

// A volume that is a hair larger, and so more surely works, by less than the tolerance of the
// objective: requirements are met to within a tolerance of the pressure at most.
double CustomSizing::ALittleMore(double volume_m3) const {
  const double here = LeastParts(volume_m3);
  const double slope = LeastParts(2.0 * volume_m3) - here;
  const double most = slope > 0.0 ? 0.5 * tolerance_ * here / slope : kMostMore;
  return std::min(volume_m3 * (1.0 + std::min(most, kMostMore)), model::kMadeReservoirLargestM3);
}

// Objective of the parts with this volume, at least.
double CustomSizing::LeastParts(double volume_m3) const {
  return ObjectiveOf(problem_.objective,
                     TotalAmounts(problem_, candidate_, LeastPoint(problem_, volume_m3)));
}

// Sizes the leaf at a volume; true where that is better than what was found before.
bool CustomSizing::Offer(double volume_m3) {
  if (LeastParts(volume_m3) >= leaf_.objective) return false;
  const Leaf leaf = SizeAtVolume(problem_, candidate_, volume_m3, kOfferEvaluationsMax);
  if (leaf.status != LeafStatus::kFeasible || leaf.objective >= leaf_.objective) return false;
  leaf_.point = leaf.point;
  leaf_.objective = leaf.objective;
  return true;
}

// From a volume that works a solver finds the best pair of pressure and volume near it.
void CustomSizing::Polish() {
  const std::optional<SizingProgram> program = SizingProgram::At(problem_, candidate_, leaf_.point);
  if (!program) return;
  const NlpResult result = Solve(program->MakeNlp(), problem_.solver);
  if (result.status != NlpStatus::kSolved) return;
  Offer(ALittleMore(program->PointOf(result.x).reservoir_m3));
}

}  // namespace plenum::optimizer
