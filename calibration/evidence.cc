#include "calibration/evidence.h"

#include <algorithm>
#include <cmath>

#include "calibration/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kReweighed = 6;

}  // namespace

double MemoryOf(std::span<const std::vector<double>> series) {
  const auto covariance = [&](std::size_t lag) {
    double sum = 0.0;
    for (const std::vector<double>& e : series)
      for (std::size_t i = lag; i < e.size(); ++i) sum += e[i] * e[i - lag];
    return sum;
  };
  std::size_t longest = 0;
  for (const std::vector<double>& e : series) longest = std::max(longest, e.size());
  const double variance = covariance(0);
  double memory = 1.0;
  for (std::size_t lag = 1; lag < longest; ++lag) {
    const double share = covariance(lag) / variance;
    if (!(share > 0.0)) break;
    memory += 2.0 * share;
  }
  return memory;
}

double BicWith(const Fit& fit, double memory) {
  const double n = static_cast<double>(fit.rows), worth = n / memory;
  const auto free = std::count_if(fit.coordinates.begin(), fit.coordinates.end(),
                                  [](const Coordinate& coordinate) { return !coordinate.prior; });
  return worth * std::log(fit.chi2_data / n) + fit.chi2_prior +
         static_cast<double>(free) * std::log(std::max(1.0, worth));
}

void Reweigh(const FitData& data, const FitOptions& options, double memory,
             std::vector<Contender>& contenders) {
  for (std::size_t size = 0; size <= kEffectsMax; ++size) {
    std::vector<Contender*> best;
    for (Contender& contender : contenders)
      if (contender.effects.size() == size && contender.fit.Usable()) best.push_back(&contender);
    std::sort(best.begin(), best.end(), [&](const Contender* a, const Contender* b) {
      return BicWith(a->fit, memory) < BicWith(b->fit, memory);
    });
    best.resize(std::min(best.size(), kReweighed));
    for (Contender* contender : best) {
      FitOptions weighed = options;
      weighed.weight = 1.0 / (memory * std::max(1.0, contender->fit.chi2_data /
                                                         static_cast<double>(contender->fit.rows)));
      Fit fit = FitModel(data, contender->fit.state, weighed);
      if (fit.Usable() && BicWith(fit, memory) < BicWith(contender->fit, memory))
        contender->fit = std::move(fit);
    }
  }
}

std::size_t Standing(std::span<const Contender> contenders, double memory) {
  std::vector<std::size_t> best(kEffectsMax + 1, contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::size_t& leader = best[contenders[i].effects.size()];
    if (!contenders[i].fit.Usable()) continue;
    if (leader == contenders.size() ||
        BicWith(contenders[i].fit, memory) < BicWith(contenders[leader].fit, memory))
      leader = i;
  }
  std::size_t standing = best.front();
  for (std::size_t size = 1; size < best.size() && best[size] < contenders.size(); ++size) {
    if (BicWith(contenders[best[size]].fit, memory) >
        BicWith(contenders[standing].fit, memory) - kAccept)
      break;
    standing = best[size];
  }
  return standing;
}

}  // namespace plenum::calibration
