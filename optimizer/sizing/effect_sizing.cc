#include "optimizer/sizing/effect_sizing.h"

#include <algorithm>
#include <optional>

#include "model/physics/storage.h"
#include "optimizer/evaluate/root.h"

namespace plenum::optimizer {
namespace {

constexpr double kPressureTolerance = 1e-5;  // no finer than the simulated cycles
constexpr double kVolumeTolerance = 1e-4;
constexpr double kVolumeStep = 1.25;

class EffectSizing {
 public:
  EffectSizing(const Problem& problem, const Candidate& candidate,
               const std::function<bool()>& stop)
      : problem_(problem),
        candidate_(candidate),
        stop_(stop),
        window_(SourceWindow(problem, candidate)) {}

  Leaf AtVolume(double reservoir_m3) {
    const Trial trial = Try(reservoir_m3);
    return Conclude(trial.excess <= 0.0 ? std::optional(trial) : std::nullopt);
  }

  // Grows or shrinks from a volume until it is bracketed.
  Leaf NearVolume(double start_m3) {
    double low_m3 = start_m3, high_m3 = start_m3;
    Trial trial = Try(start_m3);
    if (trial.excess > 0.0) {
      while (trial.excess > 0.0 && !stopped_ && high_m3 < model::kMadeReservoirLargestM3) {
        low_m3 = high_m3;
        high_m3 = std::min(kVolumeStep * high_m3, model::kMadeReservoirLargestM3);
        trial = Try(high_m3);
      }
      if (trial.excess > 0.0 || stopped_) return Conclude(std::nullopt);
    }
    std::optional<Trial> best = trial;
    const auto excess = [&](double volume_m3) {
      const Trial tried = Try(volume_m3);
      if (!stopped_ && tried.excess <= 0.0) best = tried;
      return stopped_ ? 0.0 : tried.excess;
    };
    while (low_m3 == high_m3 && low_m3 > model::kMadeReservoirSmallestM3 && !stopped_) {
      low_m3 = std::max(low_m3 / kVolumeStep, model::kMadeReservoirSmallestM3);
      if (excess(low_m3) <= 0.0) high_m3 = low_m3;
    }
    if (low_m3 < high_m3) FeasibleBracket(excess, low_m3, high_m3, kVolumeTolerance);
    return Conclude(best);
  }

 private:
  struct Trial {
    OperatingPoint point;
    double excess = kUnlimited;  // −1 times the smallest margin
    double objective = kUnlimited;
  };

  // Evaluations look for the same word, so what one says counts where it was not given since.
  bool Stopped() {
    stopped_ = stopped_ || (stop_ && stop_());
    return stopped_;
  }

  // At the lowest pressure that drives the strokes.
  Trial Try(double reservoir_m3) {
    Trial trial{{0.0, reservoir_m3, reservoir_m3}};
    const auto excess = [&](double source_pa) {
      if (Stopped()) return 0.0;
      trial.point.source_pa = source_pa;
      const Evaluation evaluation = Evaluate(problem_, candidate_, trial.point);
      return Stopped() ? 0.0 : StrokeExcess(problem_, evaluation);
    };
    if (window_.empty() || excess(window_.high_pa) > 0.0) return trial;
    trial.point.source_pa =
        SmallestFeasible(excess, window_.low_pa, window_.high_pa, kPressureTolerance);
    if (stopped_) return trial;
    const Evaluation evaluation = Evaluate(problem_, candidate_, trial.point);
    if (Stopped()) return trial;
    trial.excess = -SmallestMargin(problem_, candidate_, trial.point, evaluation);
    trial.objective = ObjectiveValue(problem_, candidate_, trial.point, evaluation);
    return trial;
  }

  Leaf Conclude(const std::optional<Trial>& best) const {
    Leaf leaf;
    leaf.status = best       ? LeafStatus::kFeasible
                  : stopped_ ? LeafStatus::kUndecided
                             : LeafStatus::kInfeasible;
    if (!best) return leaf;
    leaf.point = best->point;
    leaf.objective = best->objective;
    return leaf;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const std::function<bool()>& stop_;
  Window window_;
  bool stopped_ = false;
};

}  // namespace

Leaf SizeWithEffects(const Problem& problem, const Candidate& candidate, double start_m3,
                     const std::function<bool()>& stop) {
  EffectSizing sizing(problem, candidate, stop);
  const bool custom = candidate.reservoir.index == kCustom;
  return custom ? sizing.NearVolume(std::max(start_m3, model::kMadeReservoirSmallestM3))
                : sizing.AtVolume(ReservoirVolume(problem, candidate));
}

}  // namespace plenum::optimizer
