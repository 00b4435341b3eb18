#include "optimizer/evaluate/strokes/reservoir_filling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/physics/air.h"
#include "model/strokes/stroke.h"
#include "optimizer/evaluate/strokes/stiff_stepper.h"

namespace plenum::optimizer {
namespace {

// Of what a step may be off, explicit or implicit: those follow what changes slowly.
constexpr double kTolerance = 1e-9, kStiffTolerance = 2e-8;
constexpr double kEqual = 1e-9;        // nearer to the reservoir's pressure, a chamber is at it
constexpr double kNearlyEqual = 1e-5;  // nearer, it may rise with it
constexpr double kSettled = 3e-7;      // where it is no further off from what it then is behind
constexpr int kStepsMax = 3'000;       // until a window is over
constexpr double kFirstStep = 1e-4;    // of that time

enum class Valve { kOpen, kFollows, kClosed };

// When in the last step what only rises came to a value, as a share of the step.
template <class At>
double ShareAt(const At& at, double value) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50 && high - low > 1e-13; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle) < value ? low : high) = middle;
  }
  return high;
}

// The equations while valves stay as they are. A state: the chambers' pressures and the
// reservoir's.
struct Balance {
  explicit Balance(std::span<const StrokeOfMany> all)
      : strokes(all),
        in(all.front().line),
        content_per_volume(model::kReferencePressurePa * in.temperature_k /
                           model::kReferenceTemperatureK),
        valves(all.size(), Valve::kOpen) {}

  std::size_t size() const { return strokes.size(); }
  const model::ReservoirStrokeInput& line(std::size_t g) const { return strokes[g].line; }
  bool holds(std::size_t g) const { return line(g).open_s == 0.0; }
  bool AnyOpen() const {
    return std::any_of(valves.begin(), valves.end(),
                       [](Valve valve) { return valve != Valve::kClosed; });
  }
  bool AnyFollows() const {
    return std::any_of(valves.begin(), valves.end(),
                       [](Valve valve) { return valve == Valve::kFollows; });
  }
  // Nothing changes any more until a window is over.
  bool AtRest() const {
    return full && std::none_of(valves.begin(), valves.end(),
                                [](Valve valve) { return valve == Valve::kOpen; });
  }

  // Up to and including the highest pressure, which a pump still reaches.
  double Delivered(double reservoir_pa) const {
    const model::MonotoneCurve& flow = in.compressor->free_air_m3_per_s;
    if (flow.empty()) return 0.0;
    const double highest_pa = std::min(reservoir_pa, model::HighestPressure(*in.compressor));
    return in.compressors * flow(std::max(flow.front(), highest_pa));
  }
  double Drawn(std::size_t g, double reservoir_pa, double chamber_pa) const {
    return chamber_pa < reservoir_pa ? line(g).count * line(g).fill->Flow(reservoir_pa, chamber_pa)
                                     : 0.0;
  }
  double Drawn(std::span<const double> y, double reservoir_pa) const {
    double drawn = 0.0;
    for (std::size_t g = 0; g < size(); ++g)
      if (valves[g] == Valve::kOpen) drawn += Drawn(g, reservoir_pa, y[g]);
    return drawn;
  }

  // Room of the chambers that rise with the reservoir.
  double Room(std::span<const double> y) const {
    double room_m3 = 0.0;
    for (std::size_t g = 0; g < size(); ++g)
      if (valves[g] == Valve::kFollows)
        room_m3 += line(g).count * model::ContentSlope(*line(g).chamber, y[g]);
    return room_m3;
  }
  // The reservoir's pressure that holds what reservoir and followers do at a state, where they are
  // behind it as their flow asks; in the state they stay as far behind as they came.
  double Settled(std::span<const double> y, double slope) const {
    double missing = 0.0;
    for (std::size_t g = 0; g < size(); ++g)
      if (valves[g] == Valve::kFollows)
        missing += line(g).count * model::ContentSlope(*line(g).chamber, y[g]) *
                   (Behind(g, y[size()], slope) - (y[size()] - y[g]));
    return y[size()] + missing / (in.volume_rising_m3 + Room(y));
  }
  double ReservoirSlope(double delivered, double drawn, double room_m3) const {
    const double net = delivered - drawn;
    return content_per_volume * net /
           (net < 0.0 ? in.volume_falling_m3 : in.volume_rising_m3 + room_m3);
  }

  void Slopes(std::span<const double> y, std::span<double> slopes) const {
    double reservoir_pa = y[size()], drawn = Drawn(y, reservoir_pa);
    const double room_m3 = full ? 0.0 : Room(y);
    if (room_m3 > 0.0) {
      reservoir_pa = Settled(y, ReservoirSlope(Delivered(reservoir_pa), drawn, room_m3));
      drawn = Drawn(y, reservoir_pa);
    }
    slopes[size()] = full ? 0.0 : ReservoirSlope(Delivered(reservoir_pa), drawn, room_m3);
    for (std::size_t g = 0; g < size(); ++g)
      slopes[g] = valves[g] == Valve::kClosed ? 0.0
                  : valves[g] == Valve::kFollows
                      ? slopes[size()]
                      : content_per_volume * Drawn(g, reservoir_pa, y[g]) /
                            (line(g).count * model::ContentSlope(*line(g).chamber, y[g]));
  }

  // The reservoir's slope if an open chamber rose with it, which its flow near rest hardly tells.
  double SlopeWith(std::size_t g, std::span<const double> y, double reservoir_pa) const {
    const double drawn = Drawn(y, reservoir_pa) - Drawn(g, reservoir_pa, y[g]);
    const double room_m3 = line(g).count * model::ContentSlope(*line(g).chamber, y[g]);
    return ReservoirSlope(Delivered(reservoir_pa), drawn, Room(y) + room_m3);
  }

  // How far a chamber that rises with the reservoir is behind: its flow grows with the root of
  // that.
  double Behind(std::size_t g, double reservoir_pa, double slope) const {
    constexpr double kSmall = 1e-8;
    const model::ReservoirStrokeInput& of = line(g);
    const double flow = model::ContentSlope(*of.chamber, reservoir_pa) * slope / content_per_volume;
    const double head_pa = std::abs(reservoir_pa - model::MirrorPa(*of.chamber));
    const double flow_per_root = head_pa * (*of.fill)(1.0 - kSmall) / std::sqrt(kSmall);
    return head_pa * std::pow(std::max(0.0, flow) / flow_per_root, 2);
  }

  std::span<const StrokeOfMany> strokes;
  const model::ReservoirStrokeInput& in;  // of the reservoir and its pumps
  double content_per_volume;
  std::vector<Valve> valves;
  bool full = false;  // and the pumps cover the draw
};

class ReservoirFilling {
 public:
  explicit ReservoirFilling(std::span<const StrokeOfMany> strokes)
      : rig_(strokes), state_(strokes.size() + 1, 0.0), stepper_(state_.size()) {
    for (std::size_t g = 0; g < rig_.size(); ++g) state_[g] = rig_.line(g).from_pa;
    state_[rig_.size()] = rig_.in.start_pa > 0.0 ? rig_.in.start_pa : rig_.in.stop_pa;
    found_.rise_s.assign(rig_.size(), model::kNever);
    found_.inflate_s = found_.rise_s;
    found_.chamber_end_pa.assign(rig_.size(), 0.0);
    rig_.full = state_[rig_.size()] >= rig_.in.stop_pa &&
                rig_.Drawn(state_, rig_.in.stop_pa) <= rig_.Delivered(rig_.in.stop_pa);
  }

  ReservoirStrokes Run(const std::function<bool()>& stop) {
    while (rig_.AnyOpen()) {
      double end_s = model::kNever;
      for (std::size_t g = 0; g < rig_.size(); ++g)
        if (rig_.valves[g] != Valve::kClosed) end_s = std::min(end_s, rig_.strokes[g].window_s);
      if (!Advance(end_s, stop)) return {};
      if (AllKnown()) return Found();
      for (std::size_t g = 0; g < rig_.size(); ++g)
        if (rig_.valves[g] != Valve::kClosed && rig_.strokes[g].window_s <= now_s_) {
          if (std::isinf(found_.inflate_s[g])) return Found();
          Close(g);
        }
    }
    return Found();
  }

 private:
  // Of rises, where only they are asked for: one is late, or all have come.
  bool AllKnown() const {
    bool all_have_come = true;
    for (std::size_t g = 0; g < rig_.size(); ++g) {
      const double limit_s = rig_.strokes[g].rise_limit_s;
      const bool risen = std::isfinite(found_.rise_s[g]);
      if (!risen && limit_s < now_s_) return true;
      all_have_come = all_have_come && risen && std::isfinite(limit_s);
    }
    return all_have_come;
  }

  ReservoirStrokes Found() {
    found_.done = true;
    found_.end_s = now_s_;
    found_.reservoir_end_pa = state_[rig_.size()];
    return std::move(found_);
  }

  double Norm(std::span<const double> from, std::span<const double> error) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i)
      largest = std::max(largest, std::abs(error[i]) / from[i]);
    return largest / (stepper_.stiff() ? kStiffTolerance : kTolerance);
  }

  // To the end of the next window; false where that takes too many steps, or when stopped.
  bool Advance(double end_s, const std::function<bool()>& stop) {
    const auto rhs = [this](double, std::span<const double> y, std::span<double> slopes) {
      rig_.Slopes(y, slopes);
    };
    const auto norm = [this](std::span<const double> from, std::span<const double>,
                             std::span<const double> error) { return Norm(from, error); };
    double step_s = kFirstStep * (end_s - now_s_);
    bool restart = true;
    SetReleased();
    for (int i = 0; now_s_ < end_s && rig_.AnyOpen() && !rig_.AtRest() && !AllKnown(); ++i) {
      if (i == kStepsMax || (stop && i % 64 == 0 && stop())) return false;
      if (restart) stepper_.Start(rhs, now_s_, state_, step_s);
      if (stepper_.Step(rhs, end_s - now_s_, norm) == model::StepResult::kNotFinite) return false;
      restart = Meet(rhs);
      now_s_ = stepper_.time();
      step_s = stepper_.next_step();
      state_.assign(stepper_.state().begin(), stepper_.state().end());
      SetReleased();
      if (rig_.full) state_[rig_.size()] = rig_.in.stop_pa;
      stepper_.CountHeldDown(!restart && AnyHeldDown(), rhs);
    }
    if (rig_.AnyOpen() && !AllKnown()) now_s_ = end_s;
    return true;
  }

  // A small reservoir comes closer to what it fills faster than that to it.
  bool AnyHeldDown() const {
    const double reservoir_pa = ReservoirAt(1.0);
    const double volume_m3 = Slope() < 0.0 ? rig_.in.volume_falling_m3 : rig_.in.volume_rising_m3;
    double chamber_per_s = 0.0, reservoir_per_s = 0.0;
    for (std::size_t g = 0; g < rig_.size(); ++g) {
      if (rig_.valves[g] != Valve::kOpen) continue;
      const double chamber_pa = stepper_.state()[g], behind_pa = reservoir_pa - chamber_pa;
      chamber_per_s = std::max(chamber_per_s, ApproachRate(stepper_.derivative()[g], behind_pa));
      reservoir_per_s += ApproachRate(
          rig_.content_per_volume * rig_.Drawn(g, reservoir_pa, chamber_pa) / volume_m3, behind_pa);
    }
    return IsHeldDown(stepper_.step(), chamber_per_s + reservoir_per_s);
  }

  void SetReleased() {
    for (const auto& [g, pressure_pa] : set_) state_[g] = pressure_pa;
    set_.clear();
  }

  // The reservoir's pressure after a share of the last step.
  double ReservoirAt(double share) const {
    if (rig_.full) return rig_.in.stop_pa;
    return rig_.AnyFollows() ? rig_.Settled(StateAt(share), Slope())
                             : stepper_.At(share, rig_.size());
  }
  std::vector<double> StateAt(double share) const {  // in the last step
    std::vector<double> y(rig_.size() + 1);
    for (std::size_t i = 0; i <= rig_.size(); ++i) y[i] = stepper_.At(share, i);
    return y;
  }
  double Slope() const { return rig_.full ? 0.0 : stepper_.derivative()[rig_.size()]; }
  // Pressure of a chamber after a share of the last step.
  double PressureAt(std::size_t g, double share) const {
    if (rig_.valves[g] != Valve::kFollows) return stepper_.At(share, g);
    const double reservoir_pa = ReservoirAt(share);
    return reservoir_pa - rig_.Behind(g, reservoir_pa, Slope());
  }
  // Time, energy and air of the pumps in the last step, by the rule of Gauss.
  void CountPumps() {
    constexpr double kAside = 0.3872983346207417;  // half of √0.6
    constexpr double kShares[] = {0.5 - kAside, 0.5, 0.5 + kAside};
    constexpr double kWeights[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    for (int i = 0; i < 3; ++i) {
      const double reservoir_pa = ReservoirAt(kShares[i]), delivered = rig_.Delivered(reservoir_pa);
      double on_s = kWeights[i] * stepper_.step();
      if (rig_.full) {  // they cover the draw
        const double drawn = rig_.Drawn(StateAt(kShares[i]), reservoir_pa);
        on_s *= drawn > 0.0 ? drawn / delivered : 0.0;
      }
      found_.pump_on_s += on_s;
      found_.pump_energy_j +=
          on_s * rig_.in.compressors * model::ElectricalPower(*rig_.in.compressor, reservoir_pa);
      found_.pump_air_m3 += on_s * delivered;
    }
  }
  double PressureNow(std::size_t g) const { return PressureAt(g, 1.0); }

  double ShareOf(std::size_t g, double pressure_pa) const {
    return ShareAt([&](double share) { return PressureAt(g, share); }, pressure_pa);
  }

  // Ends the last step where the reservoir is full or the first valve closes, and notes what it has
  // come to. True where the equations go on in another way.
  template <class Rhs>
  bool Meet(const Rhs& rhs) {
    double share = 1.0;
    bool fills = false;
    std::size_t closes = rig_.size();
    if (!rig_.full && stepper_.state()[rig_.size()] >= rig_.in.stop_pa &&
        stepper_.derivative()[rig_.size()] > 0.0) {
      fills = true;
      share = ShareAt([&](double at) { return stepper_.At(at, rig_.size()); }, rig_.in.stop_pa);
    }
    for (std::size_t g = 0; g < rig_.size(); ++g) {
      if (!rig_.holds(g) || rig_.valves[g] == Valve::kClosed ||
          PressureNow(g) < rig_.line(g).operating_pa)
        continue;
      const double at = ShareOf(g, rig_.line(g).operating_pa);
      if (at > share || (at == share && closes < rig_.size())) continue;
      closes = g;
      fills = fills && at == share;
      share = at;
    }
    if (share < 1.0) stepper_.Shorten(rhs, share);
    CountPumps();
    for (std::size_t g = 0; g < rig_.size(); ++g) {
      if (rig_.valves[g] == Valve::kClosed) continue;
      Note(g, rig_.line(g).target_pa, g == closes, found_.rise_s[g]);
      Note(g, rig_.line(g).operating_pa, g == closes, found_.inflate_s[g]);
    }
    if (fills) Release();
    rig_.full = rig_.full || fills;
    if (closes < rig_.size()) {
      Close(closes);
      return true;
    }
    return fills || Follow();
  }

  void Note(std::size_t g, double pressure_pa, bool surely, double& time_s) const {
    if (!std::isinf(time_s) || !(surely || PressureNow(g) >= pressure_pa)) return;
    time_s = stepper_.start_time() + ShareOf(g, pressure_pa) * stepper_.step();
  }

  // The reservoir goes on at another pace: chambers that rose with it are behind again, or ahead.
  void Release() {
    if (!rig_.AnyFollows()) return;
    for (std::size_t g = 0; g < rig_.size(); ++g)
      if (rig_.valves[g] == Valve::kFollows) set_.emplace_back(g, PressureNow(g));
    set_.emplace_back(rig_.size(), ReservoirAt(1.0));
    std::replace(rig_.valves.begin(), rig_.valves.end(), Valve::kFollows, Valve::kOpen);
  }
  void Close(std::size_t g) {
    found_.chamber_end_pa[g] = rig_.holds(g) ? rig_.line(g).operating_pa : PressureOf(g);
    Release();
    rig_.valves[g] = Valve::kClosed;
  }
  double PressureOf(std::size_t g) const {
    return rig_.valves[g] != Valve::kFollows ? state_[g]
           : rig_.AtRest()                   ? rig_.in.stop_pa
                                             : PressureNow(g);
  }

  // Lets chambers that have come up to the reservoir rise with it; true where some do, or where it
  // falls again.
  bool Follow() {
    const double reservoir_pa = ReservoirAt(1.0);
    const bool follows = rig_.AnyFollows();
    if (Slope() < 0.0) {
      if (follows) Release();
      return follows;
    }
    bool changed = false;
    for (std::size_t g = 0; g < rig_.size(); ++g) {
      const double behind_pa = reservoir_pa - stepper_.state()[g];
      if (rig_.valves[g] != Valve::kOpen || behind_pa > kNearlyEqual * reservoir_pa) continue;
      const double slope = rig_.full ? 0.0 : rig_.SlopeWith(g, stepper_.state(), reservoir_pa);
      const double settled_pa = rig_.Behind(g, reservoir_pa, slope);
      // A step may have taken it past the reservoir by what it may be off.
      const double near_pa = behind_pa < 0.0 ? model::kNever : 0.1 * settled_pa;
      const double off_pa = std::clamp(near_pa, kEqual * reservoir_pa, kSettled * reservoir_pa);
      if (slope < 0.0 || settled_pa > kNearlyEqual * reservoir_pa ||
          std::abs(behind_pa - settled_pa) > off_pa)
        continue;
      rig_.valves[g] = Valve::kFollows;
      changed = true;
    }
    return changed;
  }

  Balance rig_;
  std::vector<double> state_;  // chambers, and what is beside them
  StiffStepper stepper_;
  double now_s_ = 0.0;
  std::vector<std::pair<std::size_t, double>> set_;  // chambers whose pressure is to be set
  ReservoirStrokes found_;
};

}  // namespace

ReservoirStrokes FillFromReservoir(std::span<const StrokeOfMany> strokes,
                                   const std::function<bool()>& stop) {
  const model::ReservoirStrokeInput& in = strokes.front().line;
  if (in.volume_falling_m3 > 0.0 && in.volume_rising_m3 > 0.0)
    return ReservoirFilling(strokes).Run(stop);
  ReservoirStrokes none;
  none.done = true;
  none.rise_s.assign(strokes.size(), model::kNever);
  none.inflate_s = none.rise_s;
  return none;
}

}  // namespace plenum::optimizer
