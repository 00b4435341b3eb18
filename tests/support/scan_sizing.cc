#include "tests/support/scan_sizing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/physics/storage.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::kUnlimited;
using optimizer::Problem;

constexpr int kVolumes = 48, kPressures = 28;
constexpr int kHalvings = 44, kSections = 44;
constexpr double kNear = -0.3;  // a margin below is not worth a closer look

// Where f is least between low and high, if it has one valley there.
template <typename F>
double Valley(const F& f, double low, double high) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < kSections; ++i) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + ratio * (high - low);
      fb = f(b);
    }
  }
  return fa < fb ? a : b;
}

// The border of what `good` accepts, on its side.
template <typename Good>
double Border(const Good& good, double bad_end, double good_end) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (bad_end + good_end);
    (good(middle) ? good_end : bad_end) = middle;
  }
  return good_end;
}

struct Look {
  double pa = 0.0, margin = -kUnlimited, objective = kUnlimited;
};

class Scan {
 public:
  Scan(const Problem& problem, const Candidate& candidate)
      : problem_(problem),
        candidate_(candidate),
        window_(optimizer::SourceWindow(problem, candidate)) {}

  Scanned Run() {
    Scanned result;
    if (window_.empty()) return result;
    const double low = std::log(model::kMadeReservoirSmallestM3);
    const double step = (std::log(model::kMadeReservoirLargestM3) - low) / kVolumes;
    std::vector<Look> looks;
    for (int i = 0; i <= kVolumes; ++i) looks.push_back(Best(std::exp(low + i * step)));
    for (int i = 0; i <= kVolumes; ++i) {
      const double at = low + i * step;
      const double before = i > 0 ? at - step : at, after = i < kVolumes ? at + step : at;
      const bool left = i > 0 && looks[i - 1].margin >= 0.0;
      const bool right = i < kVolumes && looks[i + 1].margin >= 0.0;
      const auto margin = [&](double x) { return Best(std::exp(x)).margin; };
      const auto works = [&](double x) { return margin(x) >= 0.0; };
      const auto objective = [&](double x) { return Best(std::exp(x)).objective; };
      if (looks[i].margin >= 0.0) {
        double edge = before;
        if (!left && i > 0) Offer(edge = Border(works, before, at), result);
        Offer(at, result);
        if (!(problem_.objective.energy_wh > 0.0)) break;  // larger ones are no better
        const double end = right ? after : at;
        const bool lowest = (i == 0 || looks[i].objective <= looks[i - 1].objective) &&
                            (i == kVolumes || looks[i].objective <= looks[i + 1].objective);
        if (lowest) Offer(Valley(objective, left ? before : edge, end), result);
        if (!right && i < kVolumes) Offer(Border(works, after, at), result);
      } else if (!left && !right && looks[i].margin > kNear &&
                 looks[i].margin >= (i > 0 ? looks[i - 1].margin : -kUnlimited) &&
                 looks[i].margin >= (i < kVolumes ? looks[i + 1].margin : -kUnlimited)) {
        const double top = Valley([&](double x) { return -margin(x); }, before, after);
        if (!works(top)) continue;
        const double edge = Border(works, before, top);
        Offer(edge, result);
        if (problem_.objective.energy_wh > 0.0)
          Offer(Valley(objective, edge, Border(works, after, top)), result);
        else
          break;
      }
    }
    result.failed = failed_;
    return result;
  }

 private:
  void Offer(double log_volume, Scanned& result) {
    const double volume_m3 = std::exp(log_volume);
    const Look look = Best(volume_m3);
    if (!(look.margin >= 0.0) || look.objective >= result.objective) return;
    result.feasible = true;
    result.objective = look.objective;
    result.point = {look.pa, volume_m3, volume_m3};
  }

  Look At(double pa, double volume_m3) {
    const optimizer::OperatingPoint point{pa, volume_m3, volume_m3};
    const optimizer::Evaluation evaluation = Evaluate(problem_, candidate_, point);
    failed_ = failed_ || evaluation.failed;
    Look look{pa};
    if (!evaluation.works) return look;
    look.margin = optimizer::SmallestMargin(problem_, candidate_, point, evaluation);
    look.objective = ObjectiveValue(problem_, candidate_, point, evaluation);
    return look;
  }

  // The best pressure at a volume, or the one that comes closest to working.
  Look Best(double volume_m3) {
    const double step = (window_.high_pa - window_.low_pa) / kPressures;
    std::vector<Look> looks;
    for (int i = 0; i <= kPressures; ++i) looks.push_back(At(window_.low_pa + i * step, volume_m3));
    const auto margin = [&](double pa) { return At(pa, volume_m3).margin; };
    const auto works = [&](double pa) { return margin(pa) >= 0.0; };
    const auto end = [&](double pa) { return std::clamp(pa, window_.low_pa, window_.high_pa); };
    const auto most =
        std::max_element(looks.begin(), looks.end(),
                         [](const Look& a, const Look& b) { return a.margin < b.margin; });
    if (most->margin < 0.0) {
      if (most->margin < kNear) return *most;
      looks = {At(Valley([&](double pa) { return -margin(pa); }, end(most->pa - step),
                         end(most->pa + step)),
                  volume_m3)};
      if (looks.front().margin < 0.0)
        return looks.front().margin > most->margin ? looks.front() : *most;
    }
    Look best;
    const auto offer = [&](const Look& look) {
      if (look.margin >= 0.0 && look.objective < best.objective) best = look;
    };
    for (const Look& look : looks) {
      if (look.margin < 0.0) continue;
      offer(look);
      const double before = end(look.pa - step), after = end(look.pa + step);
      const double low = works(before) ? before : Border(works, before, look.pa);
      offer(At(low, volume_m3));
      if (!(problem_.objective.energy_wh > 0.0)) break;
      const double high = works(after) ? after : Border(works, after, look.pa);
      offer(At(high, volume_m3));
      const double here = look.objective;
      if (At(low, volume_m3).objective >= here && At(high, volume_m3).objective >= here)
        offer(At(Valley([&](double pa) { return At(pa, volume_m3).objective; }, low, high),
                 volume_m3));
    }
    return best;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const optimizer::Window window_;
  bool failed_ = false;
};

}  // namespace

Scanned ScanMadeReservoir(const Problem& problem, const Candidate& candidate) {
  return Scan(problem, candidate).Run();
}

}  // namespace plenum::test
