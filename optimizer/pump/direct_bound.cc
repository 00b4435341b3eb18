#include "optimizer/pump/direct_bound.h"

#include <algorithm>

#include "model/physics/storage.h"

namespace plenum::optimizer {
namespace {

constexpr int kPanels = 64;      // of one choice of pumps
constexpr int kFewPanels = 24;   // of many
constexpr double kWidth = 1e-6;  // of a bracket of pressures, of the highest
// Flows of tables are within 3e-5 of the lines' (tests/model/flow/flow_table_test.cc), and so are
// the pressures that follow from them.
constexpr double kSlack = 1.0 + 1e-4;
constexpr double kQuadrature = 1.0 + 1e-8;  // two computations of one stroke

class Stroke {
 public:
  Stroke(const Problem& problem, const PumpFacts& facts, const Line& line, const FedSquad& fed,
         double highest_pa)
      : problem_(problem),
        facts_(facts),
        line_(line),
        count_(fed.count),
        highest_pa_(highest_pa),
        holding_(facts.holding.empty() ? nullptr : &facts.holding[fed.squad.group]) {}

  DirectStrokeBound Run(double target_pa) const {
    const double from_pa = problem_.ambient.pressure_pa;
    const double operating_pa = line_.chamber.operating_pressure_pa;
    const int panels = facts_.exact ? kPanels : kFewPanels;
    DirectStrokeBound stroke;
    double low_pa = from_pa;
    for (int i = 0; i < panels; ++i) {
      // The target ends a panel, so that no time beyond it counts.
      const double even_pa = from_pa + (operating_pa - from_pa) * (i + 1) / panels;
      const double high_pa = i + 1 == panels ? operating_pa : even_pa;
      if (low_pa < target_pa && target_pa < high_pa) {
        Add(low_pa, target_pa, stroke);
        stroke.rise_s = stroke.inflate_s;
        low_pa = target_pa;
      }
      Add(low_pa, high_pa, stroke);
      if (high_pa <= target_pa) stroke.rise_s = stroke.inflate_s;
      low_pa = high_pa;
    }
    stroke.node_pa = facts_.exact ? NodeAtLeast(operating_pa) : operating_pa;
    return stroke;
  }

 private:
  double Taken(double node_pa, double chamber_pa) const {
    return count_ * line_.curve->flow.Flow(node_pa, chamber_pa);
  }

  // The pressures around the one where `before` ceases to hold, which holds at the chamber's.
  template <class Before>
  std::pair<double, double> Around(double chamber_pa, const Before& before) const {
    double low_pa = chamber_pa, high_pa = std::max(highest_pa_, chamber_pa);
    while (high_pa - low_pa > kWidth * high_pa) {
      const double middle_pa = 0.5 * (low_pa + high_pa);
      (before(middle_pa) ? low_pa : high_pa) = middle_pa;
    }
    return {low_pa, high_pa};
  }

  double FlowAtMost(double chamber_pa) const {
    const auto [low_pa, high_pa] = Around(chamber_pa, [&](double node_pa) {
      return facts_.rates.Delivery(node_pa) > Taken(node_pa, chamber_pa);
    });
    return Taken(high_pa, chamber_pa);
  }

  double NodeAtLeast(double chamber_pa) const {
    const double node_pa = Around(chamber_pa, [&](double pa) {
                             return 1.0 / facts_.rates.SecondsAtMost(pa) > Taken(pa, chamber_pa);
                           }).first;
    return std::max(chamber_pa, node_pa / kSlack);
  }

  void Add(double low_pa, double high_pa, DirectStrokeBound& stroke) const {
    const model::Chamber& chamber = line_.chamber;
    const double air_m3 = count_ * model::StandardVolume(model::Content(chamber, high_pa) -
                                                             model::Content(chamber, low_pa),
                                                         problem_.ambient.temperature_k);
    const double flow = FlowAtMost(low_pa);
    stroke.inflate_s += flow > 0.0 ? air_m3 / flow : kUnlimited;
    const double node_pa = facts_.exact ? NodeAtLeast(low_pa) : low_pa;
    stroke.pump_j += air_m3 * facts_.rates.At(node_pa).energy_j;
    if (holding_)
      stroke.beyond_holding_j += air_m3 * holding_->beyond_j_per_m3[facts_.rates.Cell(node_pa)];
  }

  const Problem& problem_;
  const PumpFacts& facts_;
  const Line& line_;
  int count_;
  double highest_pa_;
  const HoldingPump* holding_;
};

// What pumps of a feed that hold on take in a period for a squad, J, at least.
double HeldOnEnergy(const PumpFacts& facts, const FedSquad& fed, double strokes,
                    const DirectStrokeBound& stroke) {
  return std::max(strokes * stroke.pump_j, fed.run_s * facts.holding[fed.squad.group].power_w +
                                               strokes * stroke.beyond_holding_j);
}

}  // namespace

const DirectStrokeBound& DirectBounds::StrokeOf(const PumpFacts& facts, const Line& line,
                                                const FedSquad& fed, double highest_pa,
                                                const Candidate* chosen) {
  const int g = fed.squad.group, count = fed.count;
  constexpr std::size_t kKept = 1'000'000;
  if (known_.size() > kKept) known_.clear();
  const auto [entry, fresh] =
      known_.try_emplace({&facts, line.strokes, count, chosen ? 0.0 : highest_pa});
  if (!fresh) return entry->second;
  if (!chosen)
    return entry->second = Stroke(problem_, facts, line, fed, highest_pa)
                               .Run(RiseTarget(problem_, problem_.groups[g]));
  const model::PumpStroke stroke = DirectStroke(problem_, *chosen, g, count);
  if (!stroke.reached) return entry->second = {.rise_s = kUnlimited, .inflate_s = kUnlimited};
  entry->second = {stroke.rise_s, stroke.inflate_s, stroke.pump_energy_j, stroke.node_end_pa};
  if (!facts.holding.empty())
    entry->second.beyond_holding_j =
        stroke.pump_energy_j - stroke.inflate_s * facts.holding[g].power_w;
  return entry->second;
}

std::optional<DirectNeed> DirectBounds::Least(const PumpFacts& facts,
                                              const std::vector<const Line*>& lines,
                                              double highest_pa, const Candidate* chosen) {
  const double slack = chosen ? kQuadrature : kSlack;
  DirectNeed need;
  std::vector<double> on_s(problem_.groups.size(), 0.0);  // of each feed of its own pumps
  for (const FedSquad& fed : squads_) {
    const int g = fed.squad.group;
    const Line& line = *lines[g];
    const double strokes = problem_.groups[g].gait.strokes_per_period;
    const DirectStrokeBound& stroke = StrokeOf(facts, line, fed, highest_pa, chosen);
    if (stroke.inflate_s > fed.turn_s * slack ||
        stroke.rise_s > problem_.groups[g].rise_time_max_s * slack)
      return std::nullopt;
    on_s[fed.feed] += PumpsHoldOn(problem_) ? fed.run_s : strokes * stroke.inflate_s / slack;
    const double pump_j =
        PumpsHoldOn(problem_) ? HeldOnEnergy(facts, fed, strokes, stroke) : strokes * stroke.pump_j;
    need.energy_j += fed.feeds * pump_j / slack;
    const double share = static_cast<double>(fed.squad.count) / problem_.groups[g].count;
    if (line.all_hold && !problem_.groups[g].fed_past_valve && !PumpsHoldOn(problem_))
      need.energy_j += strokes * share * line.coil_power_w * stroke.inflate_s / slack;
    need.node_pa = std::max(need.node_pa, stroke.node_pa / slack);
  }
  need.on_s = *std::max_element(on_s.begin(), on_s.end());
  return need;
}

}  // namespace plenum::optimizer
