#include "optimizer/bounds/box.h"

#include <algorithm>
#include <cmath>

#include "optimizer/bounds/highest_source.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/packs.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {

std::vector<ReservoirNeed> NeedsOf(const Box& box) {
  std::vector<ReservoirNeed> needs;
  for (const VolumeNeed& volume : *box.volumes)
    if (std::isfinite(volume.rest)) needs.push_back(volume.need);
  return needs;
}

double PackSurplus(const Problem& problem, const Plan& plan, const Box& box) {
  if (!plan.shares_packs) return 0.0;
  std::vector<Choice> rows;
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    const Slot& slot = plan.slots[s];
    const BoxNode& node = (*slot.nodes)[box.nodes[s]];
    if (!node.single()) return 0.0;
    const Option& option = (*slot.options)[node.first];
    if (option.index < 0) continue;
    rows.push_back({slot.family, BasicsOf(problem.parts, slot.family, option.index).id, slot.group,
                    PiecesOf(problem, slot.family, slot.group, option.index, option.quantity)});
  }
  return PackSurplus(problem, rows);
}

Bounds::Bounds(const Problem& problem, const Plan& plan, const Workbench* bench,
               std::function<bool(const Amounts&)> useful)
    : problem_(problem),
      plan_(plan),
      bench_(bench),
      useful_(std::move(useful)),
      lines_(plan.groups.size()),
      groups_(plan.groups.size() > 1 ? std::make_unique<GroupLines>(problem, plan, bench)
                                     : nullptr),
      shared_(MeetingOf(problem) == Meeting::kTogether && !IsPumped(plan.configuration) &&
              !plan.own_regulators && !Evacuated(problem)),
      limited_(useful_ || std::isfinite(problem.mass_max_kg) ||
               std::isfinite(problem.volume_max_l) || std::isfinite(problem.cost_max_eur)),
      highest_source_pa_(plan.own_regulators ? kUnlimited : HighestSource(problem, plan)),
      direct_(problem) {}

Box Bounds::Root() const {
  Box box;
  box.nodes.assign(plan_.slots.size(), 0);
  return box;
}

bool Bounds::IsSingle(const Box& box) const {
  for (std::size_t s = 0; s < box.nodes.size(); ++s)
    if (!Node(box, static_cast<int>(s)).single()) return false;
  return true;
}

bool Bounds::CoreIsSingle(const Box& box, int except) const {
  for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
    if (s != except && DecidesSource(s) && !Node(box, s).single()) return false;
  return true;
}

int Bounds::WidestSlot(const Box& box, DivideFor divide_for) const {
  // What a pump or a reservoir adds to the others of its source is not in its own share, so that it
  // counts for more, and for something where two weigh the same. Fittings hold back less than
  // valves and tubes do, and by how much they weigh the bound on lines alone (FindChoices) divides
  // them already.
  constexpr double kSourceWeight = 300.0, kTankWeight = 10.0, kFittingWeight = 0.125;
  constexpr double kSourceShare = 0.05;  // of its objective
  const bool tanks_early = divide_for != DivideFor::kDesigns && plan_.compressor_slot >= 0;
  // What fills a tank decides no source pressure, and all that comes behind it.
  const auto decides = [&](int s) {
    return DecidesSource(s) || s == plan_.compressor_slot || plan_.rail.Has(s) ||
           (tanks_early && s == plan_.bottle_slot);
  };
  const auto is_source = [&](int s) { return decides(s) && plan_.slots[s].group < 0; };
  const auto weight = [&](int s) {
    if (s == plan_.bottle_slot) return kTankWeight;
    if (plan_.slots[s].family == Family::kFitting) return kFittingWeight;
    return is_source(s) ? kSourceWeight : 1.0;
  };
  const auto spread = [&](int s) {
    const BoxNode& node = Node(box, s);
    const double own = is_source(s) ? kSourceShare * node.objective_low : 0.0;
    return (node.objective_high - node.objective_low + own) * weight(s);
  };
  const auto wider = [&](int a, int b) {
    return spread(a) != spread(b) ? spread(a) > spread(b)
                                  : Node(box, a).size() > Node(box, b).size();
  };
  // Reservoirs are divided within the
  // box (VolumeNeed) until all that decides the source with them is chosen; bottles and batteries
  // are found by what they must bear.
  const auto turn = [&](int s) {
    if (divide_for == DivideFor::kKinds && Node(box, s).series < 0) return 0;
    return s == plan_.reservoir_slot ? 2 : decides(s) ? 1 : 3;
  };
  int widest = -1;
  for (const int now : {0, 1, 2, 3}) {
    for (int s = 0; s < static_cast<int>(box.nodes.size()); ++s)
      if (turn(s) == now && !Node(box, s).single() && (widest < 0 || wider(s, widest))) widest = s;
    if (widest >= 0) break;
  }
  return widest;
}

bool Bounds::IsOutdone(const Box& box) const {
  long long as_good = 1;  // the combination itself and those that are better
  for (int s = 0; s < static_cast<int>(box.nodes.size()) && as_good <= problem_.count; ++s)
    as_good *= 1 + Node(box, s).outdone;
  return as_good > problem_.count;
}

BigCount Bounds::Count(const Box& box) const {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
  BigCount count = 1;
  std::uint64_t part = 1;
  for (std::size_t s = 0; s < box.nodes.size(); ++s) {
    part *= static_cast<std::uint64_t>(Node(box, static_cast<int>(s)).size());
    if (part < kMost) continue;
    count *= part;
    part = 1;
  }
  return count *= part;
}

Constraint Bounds::Assess(Box& box, int changed) {
  const int groups = static_cast<int>(plan_.groups.size());
  box.lines.resize(groups);
  for (int g = 0; g < groups; ++g)
    if (changed < 0 || changed / kSlotsPerGroup == g)
      if (const Constraint missed = RemakeLine(box, g); missed != Constraint::kNone) return missed;
  if (!WithinLimits(LeastOfAll(box))) return Constraint::kAmounts;
  if (!KeepsReservoir(plan_.configuration) && !box.lines_finished)
    if (const Constraint missed = FinishLines(box); missed != Constraint::kNone) return missed;
  return KeepsReservoir(plan_.configuration)
             ? AssessCompressor(box, changed)
             : AssessRegulated(box, changed < 0 || DecidesSource(changed));
}

bool Bounds::WithinLimits(Amounts amounts, const Amounts& more) const {
  constexpr double kRounding = 1.0 + 1e-12;  // sums in another order
  amounts += more;
  return amounts.mass_kg + amounts.mass_slack_kg <= problem_.mass_max_kg * kRounding &&
         (amounts.volume_m3 + amounts.volume_slack_m3) * 1e3 <= problem_.volume_max_l * kRounding &&
         amounts.cost_eur <= problem_.cost_max_eur * kRounding && (!useful_ || useful_(amounts));
}

Constraint Bounds::Reassess(Box& box) {
  if (!WithinLimits(LeastOfAll(box))) return Constraint::kAmounts;
  if (!KeepsReservoir(plan_.configuration)) return RestOfRegulated(box);
  for (VolumeNeed& volume : box.volumes.Own()) BoundRest(box, volume);
  return RestOfCompressor(box);
}

Constraint Bounds::Reweigh(Box& box) {
  box.bound = 0.0;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const LineKey key = KeyOf(box, g);
    const KnownLines::Known known = Know(key);
    if (known.missed() != Constraint::kNone) return known.missed();
    MadeLine* made = known.line() < 0 ? nullptr : &LineOf(key, known);
    if (!made || made->finished < box.lines_finished) {  // forgotten
      made = &Keep(key, std::make_shared<Line>(*box.lines[g]));
      made->line->objective = PartsOf(key).objective();
      made->finished = box.lines_finished;
    }
    if (made->finished && !shared_)
      if (const Constraint missed = FindLeast(key, *made); missed != Constraint::kNone)
        return missed;
    box.lines[g] = made->line;
  }
  if (shared_) return AssessRegulated(box, true);
  if (box.lines_finished) CombineChoices(box);
  if (!KeepsReservoir(plan_.configuration)) return RestOfRegulated(box);
  for (VolumeNeed& volume : box.volumes.Own()) {
    volume.objective = IsMade(volume) ? ObjectiveOf(problem_.objective, LeastOf(volume))
                                      : plan_.reservoirs.corners[volume.node].objective;
    volume.battery = -1;
    volume.rest = volume.with_lines = 0.0;
    BoundRest(box, volume);
  }
  return RestOfCompressor(box);
}

Amounts Bounds::LeastBesidesBattery(const Box& box) const {
  Amounts least;
  for (const std::shared_ptr<const Line>& line : box.lines) least += line->amounts;
  const auto add = [&](const auto& tree, int slot) {
    if (slot >= 0) least += CornerAt(tree, box, slot).amounts;
  };
  for (std::size_t i = 0; i < plan_.regulators.size(); ++i)
    add(plan_.regulators[i], plan_.regulator_slots[i]);
  add(plan_.bottles, plan_.bottle_slot);
  add(plan_.compressors, plan_.compressor_slot);
  add(plan_.reservoirs, plan_.reservoir_slot);
  add(plan_.rail.pumps, plan_.rail.pump_slot);
  add(plan_.rail.reservoirs, plan_.rail.reservoir_slot);
  return least;
}

Amounts Bounds::LeastOfAll(const Box& box) const {
  Amounts least = LeastBesidesBattery(box);
  if (plan_.battery_slot >= 0) least += CornerAt(plan_.batteries, box, plan_.battery_slot).amounts;
  return least;
}

void Bounds::AddLines(Box& box) const {
  box.window = {std::max(problem_.ambient.pressure_pa, box.source_floor_pa),
                std::min({problem_.source_pressure_max_pa, box.source_cap_pa, highest_source_pa_})};
  box.coil_power_w = 0.0;
  for (const std::shared_ptr<const Line>& line : box.lines) {
    box.window.low_pa = std::max(box.window.low_pa, line->source_min_pa);
    box.window.high_pa = std::min(box.window.high_pa, line->source_max_pa);
    box.coil_power_w += line->coil_power_w;
  }
}

double Bounds::EnergyShare(double energy_j) const {
  return problem_.objective.energy_wh * energy_j / kJoulePerWattHour;
}

double CoilEnergy(const Problem& problem, const Box& box) {
  double energy_j = 0.0;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g)
    energy_j += box.lines[g]->coil_power_w * CoilSeconds(problem, g, *box.lines[g]);
  return energy_j;
}

double Bounds::LeastBattery(const Box& box, const BatteryLoad& load, int& known) const {
  if (plan_.battery_slot < 0) return 0.0;
  const auto voltages = [&](const BoxTree<CompressorCorner>& pumps, int slot) {
    return slot < 0 ? ~Kinds{0} : CornerAt(pumps, box, slot).voltages;
  };
  const Kinds pump = voltages(plan_.compressors, plan_.compressor_slot);
  const Kinds rail = voltages(plan_.rail.pumps, plan_.rail.pump_slot);
  const BoxTree<BatteryCorner>& tree = plan_.batteries;
  const auto will_do = [&](const BatteryCorner& c) {
    return (c.voltages & pump) && (c.voltages & rail) && load.energy_j <= c.energy_j &&
           load.pump_current_a + load.coil_power_w / c.voltage_v <= c.current_max_a &&
           WithinLimits(load.others, c.amounts);
  };
  const BoxNode& allowed = Node(box, plan_.battery_slot);
  const auto is_allowed = [&](const BoxNode& node) {
    return allowed.first <= node.first && node.last <= allowed.last;
  };
  if (known < 0 || !is_allowed(tree.nodes[known]) || !will_do(tree.corners[known]))
    known = LeastChoice(tree, box.nodes[plan_.battery_slot], will_do);
  return known < 0 ? kUnlimited : tree.corners[known].objective;
}

double Bounds::LeastWithLines(const Box& box, const BatteryLoad& load, double battery) const {
  const std::vector<LineChoice>& choices = *box.choices;
  const double least_coil_s = LeastCoilSeconds(problem_);
  double coil_power_w = 0.0;
  for (const std::shared_ptr<const Line>& line : box.lines) coil_power_w += line->coil_power_w;
  double least = kUnlimited;
  for (auto choice = choices.rbegin(); choice != choices.rend(); ++choice) {
    const double more_w = choice->coil_power_w - coil_power_w;
    // More power never makes do with less of a battery.
    if (more_w > 0.0 && choice->objective + battery < least) {
      BatteryLoad more = load;
      more.energy_j += problem_.actuations * least_coil_s * more_w;
      more.coil_power_w += more_w;
      int unknown = -1;
      battery = LeastBattery(box, more, unknown);
    }
    least = std::min(least, choice->objective + battery);
  }
  return least;
}

double LinesObjective(const Box& box) {
  double objective = 0.0;
  for (const std::shared_ptr<const Line>& line : box.lines) objective += line->objective;
  return objective;
}

Candidate Bounds::CandidateOf(const Box& box) const {
  Candidate candidate;
  candidate.configuration = plan_.configuration;
  candidate.source_floor_pa = box.source_floor_pa;
  candidate.source_cap_pa = box.source_cap_pa;
  candidate.bench = bench_;
  for (const std::shared_ptr<const Line>& line : box.lines) candidate.lines.push_back(line.get());
  const auto choose = [&](int slot, Option& option) {
    if (slot >= 0 && Node(box, slot).single()) option = OptionOf(box, slot);
  };
  for (const int slot : plan_.regulator_slots)
    choose(slot,
           plan_.own_regulators ? candidate.own_regulators.emplace_back() : candidate.regulator);
  choose(plan_.bottle_slot, candidate.bottle);
  choose(plan_.compressor_slot, candidate.compressor);
  choose(plan_.reservoir_slot, candidate.reservoir);
  choose(plan_.battery_slot, candidate.battery);
  choose(plan_.rail.pump_slot, candidate.rail.pump);
  choose(plan_.rail.reservoir_slot, candidate.rail.reservoir);
  candidate.pack_surplus_eur = PackSurplus(problem_, plan_, box);
  return candidate;
}

}  // namespace plenum::optimizer
