#include "optimizer/evaluate/shared_filling.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "model/flow/flow_table.h"
#include "model/integrate/dormand_prince.h"
#include "model/physics/air.h"
#include "model/strokes/stroke.h"

namespace plenum::optimizer {
namespace {

constexpr double kTolerance = 1e-8;  // of what a step may be off
constexpr double kEqual = 1e-12;     // nearer to the node's pressure, a chamber is at it
constexpr double kFull = 1e-8;       // the same of the source's pressure
constexpr double kNear = 1e-5;       // of the regulator's drop: nearer, it may go with it
constexpr int kStepsMax = 20'000;

bool HasTable(std::span<const model::FlowElement> elements) {
  return std::all_of(elements.begin(), elements.end(), [](const model::FlowElement& element) {
    return element.subsonic_index == 0.5 && element.cracking_pressure_pa == 0.0;
  });
}

enum class Valve { kOpen, kAtNode, kClosed };

struct Group {
  model::FlowTable flow;
  const model::Chamber* chamber;
  double count;
  bool holds;
  double rise_pa, operating_pa;
  Valve valve = Valve::kOpen;
};

class SharedFilling {
 public:
  SharedFilling(const Problem& problem, const Candidate& candidate, double source_pa)
      : source_pa_(source_pa),
        flow_max_(FlowMax(problem, candidate)),
        content_per_volume_(model::kReferencePressurePa * problem.ambient.temperature_k /
                            model::kReferenceTemperatureK),
        end_s_(HalfPeriod(problem)),
        from_pa_(problem.ambient.pressure_pa),
        stepper_(candidate.lines.size() + 1) {
    const double factor = FlowFactor(problem, GasOf(candidate.configuration));
    const model::FlowElement share[] = {problem.parts.regulators[candidate.regulator.index].flow};
    regulator_ = model::FlowTable(model::MakeSeries(share, factor));
    groups_.reserve(candidate.lines.size());
    for (std::size_t g = 0; g < candidate.lines.size(); ++g) {
      const Line& line = *candidate.lines[g];
      const ActuatorGroup& group = problem.groups[g];
      groups_.push_back({model::FlowTable(model::MakeSeries(line.fill, factor)), &line.chamber,
                         static_cast<double>(group.count), line.holds, RiseTarget(problem, group),
                         group.chamber.operating_pressure_pa});
    }
    strokes_.rise_s.assign(groups_.size(), model::kNever);
    strokes_.inflate_s.assign(groups_.size(), model::kNever);
  }

  Strokes Run(const std::function<bool()>& stop) {
    constexpr double kFirstStep = 1e-5;
    std::vector<double> state(groups_.size() + 1, from_pa_);
    double now_s = 0.0, step_s = kFirstStep * end_s_;
    const auto rhs = [this](double, std::span<const double> y, std::span<double> slopes) {
      Slopes(y, slopes);
    };
    const auto norm = [this](std::span<const double> from, std::span<const double>,
                             std::span<const double> error) { return Norm(from, error); };
    bool restart = true;
    for (int i = 0; i < kStepsMax && now_s < end_s_ && !Done(); ++i) {
      if (stop && i % 64 == 0 && stop()) break;
      if (restart) stepper_.Start(rhs, now_s, state, step_s);
      node_before_pa_ = NodeAt(stepper_.state());
      if (stepper_.Step(rhs, end_s_ - now_s, norm) == model::StepResult::kNotFinite) break;
      restart = Meet(rhs);
      now_s = stepper_.time();
      step_s = stepper_.next_step();
      state.assign(stepper_.state().begin(), stepper_.state().end());
      for (const auto& [g, pressure_pa] : released_) state[g] = pressure_pa;
      released_.clear();
      if (restart) state.back() = AnyAtNode() ? node_pa_ : NodePressure(state);
    }
    strokes_.failed = now_s < end_s_ && !Done();
    strokes_.works = !strokes_.failed && AllReached();
    for (std::size_t g = 0; g < groups_.size(); ++g)
      strokes_.filled_pa.push_back(groups_[g].holds ? groups_[g].operating_pa
                                   : IsFull(g)      ? source_pa_
                                                    : PressureNow(g));
    return strokes_;
  }

 private:
  // Close to the source's pressure that which is left to it counts: times go with its root.
  double Norm(std::span<const double> from, std::span<const double> error) const {
    constexpr double kLeast = 1e-4;
    double largest = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
      largest =
          std::max(largest, std::abs(error[i]) / std::max(kLeast * from[i], source_pa_ - from[i]));
    return largest / kTolerance;
  }

  bool AllReached() const {
    return std::all_of(strokes_.inflate_s.begin(), strokes_.inflate_s.end(),
                       [](double s) { return std::isfinite(s); });
  }
  // Chambers whose valve cannot hold go on filling until they are.
  bool IsFull(std::size_t g) const { return PressureNow(g) >= source_pa_ * (1.0 - kFull); }
  bool Done() const {
    if (!AllReached()) return false;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!groups_[g].holds && !IsFull(g)) return false;
    return true;
  }
  bool AnyAtNode() const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [](const Group& group) { return group.valve == Valve::kAtNode; });
  }

  // Straight to zero close to equal pressures, as the simulator has it.
  static double Flow(const model::FlowTable& flow, double from_pa, double to_pa) {
    constexpr double kLinear = 1e-9;
    const double drop = 1.0 - to_pa / from_pa;
    return drop >= kLinear ? from_pa * flow(1.0 - drop)
                           : from_pa * flow(1.0 - kLinear) * std::max(0.0, drop / kLinear);
  }
  double Flow(std::size_t g, double node_pa, double pressure_pa) const {
    return Flow(groups_[g].flow, node_pa, pressure_pa);
  }
  // What the regulator passes beyond what the open lines take.
  double Left(double node_pa, std::span<const double> y) const {
    double left = std::min(Flow(regulator_, source_pa_, node_pa), flow_max_);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].valve == Valve::kOpen) left -= groups_[g].count * Flow(g, node_pa, y[g]);
    return left;
  }

  // Where nothing is left, by the method of Illinois.
  double NodePressure(std::span<const double> y) const {
    constexpr double kWidth = 1e-13;
    double low = from_pa_, high = source_pa_;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].valve == Valve::kOpen) low = std::max(low, y[g]);
    if (low >= high) return high;
    double f_low = Left(low, y), f_high = Left(high, y);
    if (f_low <= 0.0) return low;
    if (f_high >= 0.0) return high;
    for (int side = 0; high - low > kWidth * high;) {
      const double middle = (low * f_high - high * f_low) / (f_high - f_low);
      if (!(middle > low && middle < high)) break;
      const double f = Left(middle, y);
      if (f == 0.0) return middle;
      if (f > 0.0) {
        low = middle, f_low = f;
        if (side == 1) f_high *= 0.5;
        side = 1;
      } else {
        high = middle, f_high = f;
        if (side == -1) f_low *= 0.5;
        side = -1;
      }
    }
    return 0.5 * (low + high);
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
      node_slope = content_per_volume_ * std::max(0.0, Left(node_pa_, y)) / room;
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
    const double share = flow / Flow(g, node_pa, node_pa * (1.0 - kNear));
    return kNear * node_pa * share * share;
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
      if (g == first || PressureNow(g) >= groups_[g].rise_pa)
        Note(g, groups_[g].rise_pa, strokes_.rise_s[g]);
      if (g == first || PressureNow(g) >= groups_[g].operating_pa)
        Note(g, groups_[g].operating_pa, strokes_.inflate_s[g]);
    }
    if (first == groups_.size()) return Follow();
    Close(first);
    return true;
  }

  // The node jumps where a valve closes: chambers that went with it are behind their lines again.
  void Close(std::size_t first) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (g != first && groups_[g].valve == Valve::kAtNode)
        released_.emplace_back(g, PressureNow(g));
    for (const auto& [g, pressure_pa] : released_) groups_[g].valve = Valve::kOpen;
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
      time_s = stepper_.start_time() + ShareAt(g, pressure_pa) * stepper_.step();
  }

  double source_pa_, flow_max_, content_per_volume_, end_s_, from_pa_;
  model::FlowTable regulator_;
  std::vector<Group> groups_;
  model::DormandPrince stepper_;
  double node_pa_ = 0.0, node_before_pa_ = 0.0;           // where the last step began
  std::vector<std::pair<std::size_t, double>> released_;  // groups whose pressure is to be set
  Strokes strokes_;
};

}  // namespace

std::optional<Strokes> FillTogether(const Problem& problem, const Candidate& candidate,
                                    double source_pa) {
  const model::FlowElement regulator[] = {problem.parts.regulators[candidate.regulator.index].flow};
  const bool tables =
      HasTable(regulator) && std::all_of(candidate.lines.begin(), candidate.lines.end(),
                                         [](const Line* line) { return HasTable(line->fill); });
  if (!tables) return std::nullopt;
  return SharedFilling(problem, candidate, source_pa)
      .Run(candidate.bench != nullptr ? candidate.bench->stop : std::function<bool()>());
}

}  // namespace plenum::optimizer
