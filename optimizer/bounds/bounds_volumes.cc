// The reservoirs of a compressor's box, divided within the box by what they hold.
//
// Of what couples the families the reservoir's volume is the one number that more is not better in.
// So a box keeps its reservoirs as a list of intervals of volumes, each with its least source
// pressure, least energy and so its lightest battery, the lowest of which bounds the box. Parts of
// a box take over the list: what holds for all of it holds for them. An interval is looked at again
// only once its bound is the lowest of all that is open.
#include <algorithm>
#include <cmath>

#include "optimizer/bounds/box.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/evaluate/strokes/full_strokes.h"

namespace plenum::optimizer {
namespace {

// Reservoirs are halved down to this share of how much the other choices of the box differ in their
// share of the objective, and those made to measure at least down to this ratio of volumes; where
// compressor and lines are single choices down to ever smaller ones.
constexpr double kVolumeShare = 0.1;
constexpr double kBoxRatio = 2.0;
constexpr double kRatioSteps[] = {1.25, 1.06, 1.015};
constexpr double kFinestRatio = 1.004;
// Of the least source pressure, whose lower end is used.
constexpr double kBoxTolerance = 3e-3;
constexpr double kSingleTolerance = 1e-3;
// Of the range of source pressures, for the energy, at most: as long as it matters.
constexpr int kDivisions = 32;

// Made to measure, built for the least stop pressure that is known to be needed.
Amounts Made(const Problem& problem, const VolumeNeed& volume, double volume_m3) {
  return CustomReservoir(problem, volume_m3,
                         std::max(LeastSourcePa(problem), volume.need.source_pa));
}

// Of single lines and pumps: raises the least stop pressure to what the strokes of several groups
// ask out of a full reservoir, of groups that begin at once with what each takes from the others.
// False where none is enough. For boxes it would not hold, whose other groups may take less than
// their best lines do.
bool RaiseExactly(const Problem& problem, const Candidate& candidate, ReservoirNeed& need) {
  const auto excess = [&](double stop_pa) {
    const OperatingPoint fastest{stop_pa, need.high_m3, need.low_m3};
    const std::optional<double> together = ExcessWhenFull(problem, candidate, fastest);
    return together ? *together : AloneStrokeExcess(problem, candidate, fastest);
  };
  const std::optional<double> least_pa =
      RaisedFloor(excess, need.source_pa, need.source_max_pa, kSingleTolerance);
  if (least_pa) need.source_pa = *least_pa;
  return least_pa.has_value();
}

}  // namespace

// Those of the box's reservoirs, with what a larger box knows of them.
void Bounds::RestrictVolumes(Box& box) const {
  const int whole = box.nodes[plan_.reservoir_slot];
  const BoxNode& range = plan_.reservoirs.nodes[whole];
  const auto cut = [&](VolumeNeed volume) {
    const ReservoirCorner& corner = plan_.reservoirs.corners[whole];
    volume.node = whole;
    volume.need.low_m3 = corner.low_m3;
    volume.need.high_m3 = corner.high_m3;
    volume.objective = corner.objective;
    volume.rest = std::max(volume.rest, corner.objective);
    volume.look = -1;
    return volume;
  };
  if (box.volumes->empty()) box.volumes.Own().push_back(cut({}));
  std::vector<VolumeNeed> kept;
  for (const VolumeNeed& volume : *box.volumes) {
    const BoxNode& node = plan_.reservoirs.nodes[volume.node];
    if (range.first <= node.first && node.last <= range.last)
      kept.push_back(volume);
    else if (node.first <= range.first && range.last <= node.last)
      kept.push_back(cut(volume));
  }
  box.volumes.Own() = std::move(kept);
}

bool Bounds::IsMade(const VolumeNeed& volume) const {
  return plan_.reservoirs.nodes[volume.node].single() &&
         plan_.reservoirs.corners[volume.node].custom;
}

Amounts Bounds::LeastOf(const VolumeNeed& volume) const {
  return IsMade(volume) ? Made(problem_, volume, volume.need.low_m3)
                        : plan_.reservoirs.corners[volume.node].amounts;
}

Amounts Bounds::LeastAssessed(const Box& box) const {
  Amounts all = LeastOfAll(box);
  if (!KeepsReservoir(plan_.configuration)) return all;
  Amounts least{kUnlimited, kUnlimited, kUnlimited};
  for (const VolumeNeed& volume : *box.volumes) {
    if (std::isinf(volume.rest)) continue;
    const Amounts of = LeastOf(volume);
    least = {std::min(least.mass_kg, of.mass_kg), std::min(least.volume_m3, of.volume_m3),
             std::min(least.cost_eur, of.cost_eur)};
  }
  const Amounts& counted = CornerAt(plan_.reservoirs, box, plan_.reservoir_slot).amounts;
  all.mass_kg += least.mass_kg - counted.mass_kg;
  all.volume_m3 += least.volume_m3 - counted.volume_m3;
  all.cost_eur += least.cost_eur - counted.cost_eur;
  return all;
}

// How much more of the objective than the least a reservoir in it may take.
double Bounds::Spread(const VolumeNeed& volume) const {
  const auto made = [&](double volume_m3) {
    return ObjectiveOf(problem_.objective, Made(problem_, volume, volume_m3));
  };
  const BoxNode& node = plan_.reservoirs.nodes[volume.node];
  return IsMade(volume) ? made(volume.need.high_m3) - made(volume.need.low_m3)
                        : node.objective_high - node.objective_low;
}

std::vector<VolumeNeed> Bounds::Halves(const VolumeNeed& volume) const {
  std::vector<VolumeNeed> halves(2, volume);
  if (IsMade(volume)) {
    const double middle_m3 = std::sqrt(volume.need.low_m3 * volume.need.high_m3);
    halves[0].need.high_m3 = halves[1].need.low_m3 = middle_m3;
    halves[1].objective = ObjectiveOf(problem_.objective, Made(problem_, volume, middle_m3));
    return halves;
  }
  const BoxNode& node = plan_.reservoirs.nodes[volume.node];
  halves[0].node = node.left;
  halves[1].node = node.right;
  for (VolumeNeed& half : halves) {
    const ReservoirCorner& corner = plan_.reservoirs.corners[half.node];
    half.need.low_m3 = corner.low_m3;
    half.need.high_m3 = corner.high_m3;
    half.objective = corner.objective;
  }
  return halves;
}

// Whether some of the reservoirs differ so much that they are looked at half by half.
bool Bounds::IsWide(const Box& box, const VolumeNeed& volume) const {
  const bool made = IsMade(volume);
  if (!made && plan_.reservoirs.nodes[volume.node].single()) return false;
  const double ratio_max = box.volume_ratio_max > 0.0 ? box.volume_ratio_max : kBoxRatio;
  if (made && volume.need.high_m3 > ratio_max * volume.need.low_m3) return true;
  if (made && volume.need.high_m3 <= kFinestRatio * volume.need.low_m3) return false;
  if (CoreIsSingle(box, plan_.reservoir_slot)) return !made;
  double spread = 0.0;
  for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
    if (DecidesSource(s) && s != plan_.reservoir_slot)
      spread = std::max(spread, Node(box, s).objective_high - Node(box, s).objective_low);
  return Spread(volume) > kVolumeShare * spread;
}

// Looked at for this box, and no longer to be halved.
bool Bounds::IsSettled(const Box& box, const VolumeNeed& volume) const {
  return IsLookedAt(box, volume) && volume.energy_known && !IsWide(box, volume);
}

double Bounds::TotalOf(const Box& box, const VolumeNeed& volume) const {
  return CornerAt(plan_.compressors, box, plan_.compressor_slot).objective +
         BoundOf(LinesObjective(box), volume);
}

// Those made to measure stay: they are sized together.
void Bounds::Forget(Box& box, double objective) const {
  if (box.bound > objective) {
    box.volumes = {};
    box.lines.clear();
    box.choices = nullptr;
    return;
  }
  const std::vector<VolumeNeed>& volumes = *box.volumes;
  const auto stays = [&](const VolumeNeed& volume) {
    return TotalOf(box, volume) <= objective || IsMade(volume);
  };
  const auto count = static_cast<std::size_t>(std::count_if(volumes.begin(), volumes.end(), stays));
  if (volumes.empty() || 4 * count > 3 * volumes.capacity()) return;  // hardly worth it
  std::vector<VolumeNeed> kept;
  kept.reserve(count);
  for (const VolumeNeed& volume : volumes)
    if (stays(volume))
      kept.push_back(volume);
    else
      box.forgotten = std::min(box.forgotten, TotalOf(box, volume));
  box.volumes = {};
  box.volumes.Own() = std::move(kept);
  box.lowest = Lowest(box);
}

bool Bounds::IsForgotten(const Box& box) const {
  if (box.lines.empty()) return true;
  return std::isfinite(box.forgotten) &&
         (box.volumes->empty() || TotalOf(box, (*box.volumes)[box.lowest]) > box.forgotten);
}

// The reservoirs whose bound is that of the box.
std::size_t Bounds::Lowest(const Box& box) {
  const double lines = LinesObjective(box);
  const auto lowest = std::min_element(box.volumes->begin(), box.volumes->end(),
                                       [&](const VolumeNeed& a, const VolumeNeed& b) {
                                         return BoundOf(lines, a) < BoundOf(lines, b);
                                       });
  return static_cast<std::size_t>(lowest - box.volumes->begin());
}

// What these reservoirs need in this box: their source pressure and what it takes, and where that
// is known the energy of coils; none where none of them will do.
std::optional<VolumeNeed> Bounds::LookAt(const Box& box, VolumeNeed volume) {
  const PumpFacts& pump = PumpOf(box);
  std::vector<const Line*> lines;
  for (const std::shared_ptr<const Line>& line : box.lines) lines.push_back(line.get());
  const PumpLoad load = MakePumpLoad(problem_, lines);
  const PumpLimits limits{CornerAt(plan_.compressors, box, plan_.compressor_slot).duty_max,
                          CornerAt(plan_.batteries, box, plan_.battery_slot).energy_j};
  const bool single = CoreIsSingle(box, plan_.reservoir_slot);
  if (volume.look == box.look) {
    volume.energy_known = true;
    const auto rest_with = [&](double energy_j) {
      VolumeNeed at = volume;
      at.need.energy_j = energy_j;
      BoundRest(box, at);
      return BoundOf(LinesObjective(box), at);
    };
    volume.need.energy_j = LeastMissionEnergy(
        problem_, pump, load, volume.need, kDivisions, [&](double low_j, double high_j) {
          return high_j > limits.energy_max_j || rest_with(high_j) > rest_with(low_j);
        });
    if (!(volume.need.energy_j <= limits.energy_max_j)) return std::nullopt;
  } else {
    volume.need.source_max_pa =
        std::min(volume.need.source_max_pa, plan_.reservoirs.corners[volume.node].pressure_max_pa);
    const double tolerance = single ? kSingleTolerance : kBoxTolerance;
    const auto raise = [&] {
      const std::optional<ReservoirNeed> need =
          LeastReservoirNeed(problem_, pump, load, limits, box.window, volume.need, tolerance);
      if (need) volume.need = *need;
      return need.has_value();
    };
    if (!raise()) return std::nullopt;
    if (problem_.groups.size() > 1 && single) {
      const double alone_pa = volume.need.source_pa;
      if (!RaiseExactly(problem_, CandidateOf(box), volume.need)) return std::nullopt;
      if (volume.need.source_pa > alone_pa && !raise()) return std::nullopt;
    }
    if (IsMade(volume)) volume.objective = ObjectiveOf(problem_.objective, LeastOf(volume));
    volume.look = box.look;
    volume.energy_known = !EnergyMayGrow(problem_, load);
  }
  BoundRest(box, volume);
  return volume;
}

// Looks at the reservoirs with the lowest bound as this box has them, or divides them where that is
// done.
Constraint Bounds::LookAtLowest(Box& box) {
  std::vector<VolumeNeed>& volumes = box.volumes.Own();
  if (volumes[box.lowest].look == box.look && !IsLookedAt(box, volumes[box.lowest])) {
    BoundRest(box, volumes[box.lowest]);
    return RestOfCompressor(box);
  }
  const VolumeNeed volume = volumes[box.lowest];
  volumes.erase(volumes.begin() + static_cast<std::ptrdiff_t>(box.lowest));
  if (volume.look == box.look && (volume.energy_known || IsWide(box, volume))) {
    // What is known of both holds for each half, which is looked at once it is the lowest.
    for (VolumeNeed half : Halves(volume)) {
      half.look = -1;
      BoundRest(box, half);
      volumes.push_back(half);
    }
  } else if (const std::optional<VolumeNeed> looked = LookAt(box, volume)) {
    volumes.push_back(*looked);
  }
  return RestOfCompressor(box);
}

Constraint Bounds::RefineVolumes(Box& box) {
  double next = kFinestRatio;
  for (double ratio : kRatioSteps)
    if (box.volume_ratio_max == 0.0 || ratio < box.volume_ratio_max) {
      next = ratio;
      break;
    }
  box.volume_ratio_max = next;
  box.source_known = next == kFinestRatio;
  return RestOfCompressor(box);
}

}  // namespace plenum::optimizer
