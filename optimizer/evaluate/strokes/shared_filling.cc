#include "optimizer/evaluate/strokes/shared_filling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/flow/flow_table.h"
#include "model/physics/air.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/strokes/falling_root.h"
#include "optimizer/evaluate/strokes/filling_commands.h"
#include "optimizer/evaluate/strokes/flow_down.h"
#include "optimizer/evaluate/strokes/stiff_stepper.h"

namespace plenum::optimizer {
namespace {

// Of what a step may be off, explicit or implicit: those follow what changes slowly.
constexpr double kTolerance = 1e-8, kStiffTolerance = 2e-7;
constexpr double kEqual = 1e-12;   // nearer to the node's pressure, a chamber is at it
constexpr double kFull = 1e-5;     // the same of the source's pressure
constexpr double kNear = 3e-4;     // of the regulator's drop: nearer, it may go with it
constexpr int kStepsMax = 20'000;  // from one command to the next

bool HasTable(std::span<const model::FlowElement> elements) {
  return std::all_of(elements.begin(), elements.end(), [](const model::FlowElement& element) {
    return element.subsonic_index == 0.5 && element.cracking_pressure_pa == 0.0;
  });
}

enum class Valve { kOpen, kAtNode, kClosed };

struct Group {  // a squad
  int of;       // the problem's group
  model::FlowTable flow;
  const model::Chamber* chamber;
  double count;
  bool holds;
  double rise_pa, operating_pa;
  Valve valve = Valve::kClosed;
  double begin_s = 0.0, rise_s = model::kNever, inflate_s = model::kNever;  // of its stroke
};

class SharedFilling {
 public:
  SharedFilling(const Problem& problem, const Candidate& candidate, double source_pa)
      : source_pa_(source_pa),
        flow_max_(FlowMax(problem, candidate)),
        content_per_volume_(model::kReferencePressurePa * problem.ambient.temperature_k /
                            model::kReferenceTemperatureK),
        problem_(problem),
        stepper_(SquadsOf(problem).size() + 1) {
    const std::vector<Squad> squads = SquadsOf(problem);
    commands_ = CommandsOf(problem, squads);
    state_.assign(squads.size() + 1, problem.ambient.pressure_pa);
    const double factor = FlowFactor(problem, GasOf(candidate.configuration));
    const model::FlowElement share[] = {problem.parts.regulators[candidate.regulator.index].flow};
    regulator_ = model::FlowTable(model::MakeSeries(share, factor));
    groups_.reserve(squads.size());
    for (const auto& [g, count, phase] : squads) {
      const Line& line = *candidate.lines[g];
      groups_.push_back({g, model::FlowTable(model::MakeSeries(line.fill, factor)), &line.chamber,
                         static_cast<double>(count), line.holds,
                         RiseTarget(problem, problem.groups[g]),
                         problem.groups[g].chamber.operating_pressure_pa});
    }
  }

  Strokes Run(const std::function<bool()>& stop) {
    const bool bursts = IsBurst(problem_);
    const std::size_t in_period = commands_.size() / (bursts ? 2 : 2 * kPeriodsMax);
    bool one_period = bursts;
    std::map<int, std::vector<Filled>> periods;
    for (const Command& command : commands_) {
      if (one_period && command.period > 0) continue;
      if (!Advance(command.time_s, stop)) break;
      if (command.opens) {
        // A period that begins with nothing drawn repeats from the first on.
        one_period = one_period || (command.period == 1 && IsQuiet());
        if (one_period && periods[0].size() == in_period) return WorstOf(periods[0]);
        if (command.period == 0 || !one_period) Open(command.group, command.period);
        continue;
      }
      std::vector<Filled>& filled = periods[command.period];
      filled.push_back(Shut(command.group));
      if (!std::isfinite(filled.back().inflate_s) && !bursts) return WorstOf(filled);
      if (filled.size() == in_period &&
          (one_period || (command.period > 0 && SameTimes(filled, periods[command.period - 1]))))
        return WorstOf(filled);
    }
    Strokes failed = WorstOf({});
    failed.failed = true;
    failed.works = false;
    return failed;
  }

 private:
  // To the next command; false where that takes too many steps, or when stopped.
  bool Advance(double end_s, const std::function<bool()>& stop) {
    constexpr double kFirstStep = 1e-3;
    double step_s = kFirstStep * (end_s - now_s_);
    const auto rhs = [this](double, std::span<const double> y, std::span<double> slopes) {
      Slopes(y, slopes);
    };
    const auto norm = [this](std::span<const double> from, std::span<const double>,
                             std::span<const double> error) { return Norm(from, error); };
    bool restart = true;
    for (int i = 0; i < kStepsMax && now_s_ < end_s && AnyDraws(); ++i) {
      if (stop && i % 64 == 0 && stop()) return false;
      if (restart) {
        state_.back() = AnyAtNode() ? node_pa_ : NodePressure(state_);
        stepper_.Start(rhs, now_s_, state_, step_s);
      }
      node_before_pa_ = NodeAt(stepper_.state());
      if (stepper_.Step(rhs, end_s - now_s_, norm) == model::StepResult::kNotFinite) return false;
      restart = Meet(rhs);
      now_s_ = stepper_.time();
      step_s = stepper_.next_step();
      state_.assign(stepper_.state().begin(), stepper_.state().end());
      SetReleased();
      stepper_.CountHeldDown(!restart && AnyHeldDown(), rhs);
    }
    if (now_s_ < end_s && AnyDraws()) return false;
    now_s_ = end_s;
    return true;
  }

  bool AnyHeldDown() const {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].valve == Valve::kOpen &&
          IsHeldDown(stepper_.step(),
                     ApproachRate(stepper_.derivative()[g], node_pa_ - stepper_.state()[g])))
        return true;
    return false;
  }

  void SetReleased() {
    for (const auto& [g, pressure_pa] : released_) state_[g] = pressure_pa;
    released_.clear();
  }

  // Whether nothing is drawn and no stroke of the period has begun.
  bool IsQuiet() const { return opened_ == 0 && !AnyDraws(); }

  void Open(std::size_t g, int period) {
    if (period > opened_) opened_ = period;
    Release(g);
    SetReleased();
    Group& group = groups_[g];
    group.valve = Valve::kOpen;
    group.begin_s = now_s_;
    group.rise_s = group.inflate_s = model::kNever;
    state_[g] = model::RestPa(*group.chamber);
  }

  Filled Shut(std::size_t g) {
    const Group& group = groups_[g];
    const double filled_pa = group.holds ? group.operating_pa
                             : IsFull(g) ? source_pa_
                                         : PressureOf(g);
    if (group.valve != Valve::kClosed) {
      Close(g);
      SetReleased();
    }
    return {group.of, group.rise_s, group.inflate_s, filled_pa};
  }

  // The slowest strokes of each group, and the highest pressure.
  Strokes WorstOf(const std::vector<Filled>& filled) const {
    Strokes strokes = ToBeKept(problem_);
    strokes.works = true;
    for (const Filled& one : filled) {
      Keep(strokes.rise_s[one.of], one.rise_s);
      Keep(strokes.inflate_s[one.of], one.inflate_s);
      Keep(strokes.filled_pa[one.of], one.filled_pa);
      strokes.works = strokes.works && std::isfinite(one.inflate_s);
    }
    return strokes;
  }

  // Close to the source's pressure that which is left to it counts: times go with its root.
  double Norm(std::span<const double> from, std::span<const double> error) const {
    constexpr double kLeast = 1e-4;
    double largest = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
      largest =
          std::max(largest, std::abs(error[i]) / std::max(kLeast * from[i], source_pa_ - from[i]));
    return largest / (stepper_.stiff() ? kStiffTolerance : kTolerance);
  }

  double PressureOf(std::size_t g) const {
    return groups_[g].valve == Valve::kAtNode ? PressureNow(g) : state_[g];
  }
  // Chambers whose valve cannot hold go on filling until they are.
  bool IsFull(std::size_t g) const { return PressureOf(g) >= source_pa_ * (1.0 - kFull); }
  bool AnyDraws() const {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].valve != Valve::kClosed && !(std::isfinite(groups_[g].inflate_s) && IsFull(g)))
        return true;
    return false;
  }
  bool AnyAtNode() const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [](const Group& group) { return group.valve == Valve::kAtNode; });
  }

  double Flow(std::size_t g, double node_pa, double pressure_pa) const {
    return FlowDown(groups_[g].flow, node_pa, pressure_pa);
  }
  // What the regulator passes beyond what the open lines take, and its slope by the node's
  // pressure.
  ValueAndSlope LeftAndSlope(double node_pa, std::span<const double> y) const {
    const FlowAndSlopes regulated = FlowAndSlopesDown(regulator_, source_pa_, node_pa);
    ValueAndSlope left = regulated.flow < flow_max_ ? ValueAndSlope{regulated.flow, regulated.by_to}
                                                    : ValueAndSlope{flow_max_, 0.0};
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].valve != Valve::kOpen || y[g] >= node_pa) continue;
      const FlowAndSlopes line = FlowAndSlopesDown(groups_[g].flow, node_pa, y[g]);
      left.value -= groups_[g].count * line.flow;
      left.slope -= groups_[g].count * line.by_from;
    }
    return left;
  }

  // Where nothing is left; near the node that was found last. Above no pressure at all, also where
  // a step on trial is so long that a chamber's is below.
  double NodePressure(std::span<const double> y) const {
    double lowest_pa = source_pa_;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].valve == Valve::kOpen) lowest_pa = std::min(lowest_pa, y[g]);
    return lowest_pa >= source_pa_
               ? source_pa_
               : FallingRoot([&](double node_pa) { return LeftAndSlope(node_pa, y); },
                             std::max(0.0, lowest_pa), source_pa_, node_pa_);
  }

  double NodeAt(std::span<const double> y) const {
    return AnyAtNode() ? y.back() : NodePressure(y);
  }

  void Slopes(std::span<const double> y, std::span<double> slopes) {
    const bool follows = AnyAtNode();
    node_pa_ = NodeAt(y);
    double room = 0.0, node_slope = 0.0;
    if (follows) {
      for (const Group& group : groups_)
        if (group.valve == Valve::kAtNode)
          room += group.count * model::ContentSlope(*group.chamber, node_pa_);
      node_slope = content_per_volume_ * std::max(0.0, LeftAndSlope(node_pa_, y).value) / room;
    }
    slopes.back() = node_slope;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Group& group = groups_[g];
      slopes[g] = group.valve == Valve::kClosed   ? 0.0
                  : group.valve == Valve::kAtNode ? node_slope
                                                  : content_per_volume_ * Flow(g, node_pa_, y[g]) /
                                                        model::ContentSlope(*group.chamber, y[g]);
    }
  }

  // How far a chamber is behind a node that it goes with: its flow grows with the root of that.
  double Behind(std::size_t g, double node_pa, double node_slope) const {
    const double flow =
        model::ContentSlope(*groups_[g].chamber, node_pa) * node_slope / content_per_volume_;
    constexpr double kProbe = 1e-5;
    const double share = flow / Flow(g, node_pa, node_pa * (1.0 - kProbe));
    return kProbe * node_pa * share * share;
  }
  double Behind(std::size_t g) const {
    return groups_[g].valve == Valve::kAtNode
               ? Behind(g, stepper_.state().back(), stepper_.derivative().back())
               : 0.0;
  }
  // Pressure of a chamber after a share of the last step.
  double PressureAt(std::size_t g, double share) const {
    return groups_[g].valve == Valve::kAtNode ? stepper_.At(share, groups_.size()) - Behind(g)
                                              : stepper_.At(share, g);
  }
  double PressureNow(std::size_t g) const {
    return groups_[g].valve == Valve::kAtNode ? stepper_.state().back() - Behind(g)
                                              : stepper_.state()[g];
  }

  // When in the last step a group's pressure, which only rises, came to this one, as a share of it.
  double ShareAt(std::size_t g, double pressure_pa) const {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 50 && high - low > 1e-12; ++i) {
      const double middle = 0.5 * (low + high);
      (PressureAt(g, middle) < pressure_pa ? low : high) = middle;
    }
    return high;
  }

  // Notes the targets that the last step has come to, and ends it where the first valve closes.
  // True where the equations go on in another way.
  template <class Rhs>
  bool Meet(const Rhs& rhs) {
    double closes = 2.0;
    std::size_t first = groups_.size();
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].holds && groups_[g].valve != Valve::kClosed &&
          PressureNow(g) >= groups_[g].operating_pa)
        if (const double share = ShareAt(g, groups_[g].operating_pa); share < closes) {
          closes = share;
          first = g;
        }
    if (first < groups_.size() && closes < 1.0) stepper_.Shorten(rhs, closes);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].valve == Valve::kClosed) continue;
      if (g == first || PressureNow(g) >= groups_[g].rise_pa)
        Note(g, groups_[g].rise_pa, groups_[g].rise_s);
      if (g == first || PressureNow(g) >= groups_[g].operating_pa)
        Note(g, groups_[g].operating_pa, groups_[g].inflate_s);
    }
    if (first == groups_.size()) return Follow();
    Close(first);
    return true;
  }

  // The node jumps where a valve opens or closes: chambers that went with it are behind their lines
  // again, or ahead of it.
  void Release(std::size_t but) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (g != but && groups_[g].valve == Valve::kAtNode) released_.emplace_back(g, PressureNow(g));
    for (const auto& [g, pressure_pa] : released_) groups_[g].valve = Valve::kOpen;
  }
  void Close(std::size_t first) {
    Release(first);
    groups_[first].valve = Valve::kClosed;
  }

  // Lets chambers that have come up to the node go with it; true where some have.
  bool Follow() {
    node_pa_ = NodeAt(stepper_.state());
    const double slope = std::max(0.0, (node_pa_ - node_before_pa_) / stepper_.step());
    bool changed = false;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].valve != Valve::kOpen) continue;
      const double behind_pa = node_pa_ - stepper_.state()[g];
      if (behind_pa < -kEqual * node_pa_) continue;  // ahead: nothing flows back
      const bool goes_with = behind_pa <= kNear * (source_pa_ - node_pa_) &&
                             behind_pa <= 1.1 * Behind(g, node_pa_, slope);
      if (behind_pa <= kEqual * node_pa_ || goes_with) {
        groups_[g].valve = Valve::kAtNode;
        changed = true;
      }
    }
    return changed;
  }

  void Note(std::size_t g, double pressure_pa, double& time_s) const {
    if (!std::isfinite(time_s))
      time_s =
          stepper_.start_time() + ShareAt(g, pressure_pa) * stepper_.step() - groups_[g].begin_s;
  }

  double source_pa_, flow_max_, content_per_volume_;
  const Problem& problem_;
  std::vector<Command> commands_;
  double now_s_ = 0.0;
  int opened_ = 0;             // the last period of which a stroke has begun
  std::vector<double> state_;  // chambers, node
  model::FlowTable regulator_;
  std::vector<Group> groups_;
  StiffStepper stepper_;
  double node_pa_ = 0.0, node_before_pa_ = 0.0;           // where the last step began
  std::vector<std::pair<std::size_t, double>> released_;  // groups whose pressure is to be set
};

}  // namespace

std::optional<Strokes> FillTogether(const Problem& problem, const Candidate& candidate,
                                    double source_pa) {
  const model::FlowElement regulator[] = {problem.parts.regulators[candidate.regulator.index].flow};
  const bool tables = !Evacuated(problem) && HasTable(regulator) &&
                      std::all_of(candidate.lines.begin(), candidate.lines.end(),
                                  [](const Line* line) { return HasTable(line->fill); });
  if (!tables) return std::nullopt;
  return SharedFilling(problem, candidate, source_pa)
      .Run(candidate.bench != nullptr ? candidate.bench->stop : std::function<bool()>());
}

}  // namespace plenum::optimizer
