#include "calibration/judge/evidence.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <unsupported/Eigen/FFT>

#include "calibration/values/parallel.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kReweighed = 6;
constexpr double kNear = 20.0;      // of BIC, were the priors free
constexpr int kRounds = 3;          // of subsets, each of the set that stands then
constexpr double kFixedBic = 0.01;  // by how much less the last step may change it

// Σ e_i·e_{i−k} by lag k: the inverse transform of |ê|², with as many zeros behind e that no lag
// wraps around.
std::vector<double> Products(std::vector<double> e) {
  const std::size_t lags = e.size();
  e.resize(std::bit_ceil(2 * lags), 0.0);
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, e);
  for (std::complex<double>& line : spectrum) line = std::norm(line);
  std::vector<double> products;
  fft.inv(products, spectrum);
  products.resize(lags);
  return products;
}

}  // namespace

double MemoryOf(std::span<const std::vector<double>> series) {
  std::vector<double> covariance;  // by lag, of all series
  for (const std::vector<double>& e : series) {
    const std::vector<double> products = Products(e);
    covariance.resize(std::max(covariance.size(), products.size()), 0.0);
    for (std::size_t lag = 0; lag < products.size(); ++lag) covariance[lag] += products[lag];
  }
  double memory = 1.0;
  for (std::size_t lag = 1; lag < covariance.size(); ++lag) {
    const double share = covariance[lag] / covariance.front();
    if (!(share > 0.0)) break;
    memory += 2.0 * share;
  }
  return memory;
}

double BicWith(const Fit& fit, double memory) {
  const double n = static_cast<double>(fit.rows), worth = n / memory;
  return worth * std::log(fit.chi2_data / n) + fit.chi2_prior + Penalty(fit, memory);
}

Fit FitWeighed(const FitData& data, FitOptions options, double memory, const Fit& from,
               const ModelState& start) {
  const double n = static_cast<double>(from.rows);
  options.weight = 1.0 / (memory * std::max(1.0, from.chi2_data / n));
  options.noise_share /= std::sqrt(options.weight);  // readings of less worth need less
  options.function_tolerance = std::max(options.function_tolerance, kFixedBic * memory / n);
  Fit fit = FitModel(data, start, options);
  Narrow(data, options, fit);
  return fit;
}

namespace {

// A subset of the standing set that was fitted from elsewhere may have missed the optimum that is
// there without one of the effects: it is fitted from where the set is.
void FitSubsets(const FitData& data, const FitOptions& options, double memory, std::size_t standing,
                std::vector<Contender>& contenders) {
  const Contender set = contenders[standing];
  for (const model::EffectSpec* out : set.effects) {
    const EffectSet rest = Without(set.effects, out);
    Fit fit = FitWeighed(data, options, memory, set.fit, StateOf(set, rest));
    if (!fit.Usable()) continue;
    const auto known = std::find_if(contenders.begin(), contenders.end(),
                                    [&](const Contender& one) { return one.effects == rest; });
    if (known == contenders.end())
      contenders.push_back({.effects = rest, .fit = std::move(fit), .starts = 1, .found_again = 1});
    else if (!known->fit.Usable() || BicWith(fit, memory) < BicWith(known->fit, memory))
      known->fit = std::move(fit);
  }
}

}  // namespace

void Reweigh(const FitData& data, const FitOptions& options, double memory,
             std::vector<Contender>& contenders) {
  for (std::size_t size = 0; size <= kEffectsMax; ++size) {
    std::vector<Contender*> best;
    for (Contender& contender : contenders)
      if (contender.effects.size() == size && contender.fit.Usable()) best.push_back(&contender);
    // With less weight on the readings priors that are stretched may relax: at best to this.
    const auto reach = [memory](const Contender* contender) {
      return BicWith(contender->fit, memory) - contender->fit.chi2_prior;
    };
    double goal = std::numeric_limits<double>::infinity();
    for (const Contender* contender : best) goal = std::min(goal, BicWith(contender->fit, memory));
    std::sort(best.begin(), best.end(),
              [&](const Contender* a, const Contender* b) { return reach(a) < reach(b); });
    best.resize(std::min(best.size(), kReweighed));
    std::erase_if(best,
                  [&](const Contender* contender) { return reach(contender) > goal + kNear; });
    ForAll(best.size(), options.threads, [&](std::size_t i) {
      Contender& contender = *best[i];
      FitOptions each = options;
      each.threads = ThreadsWithin(i, best.size(), options.threads);
      Fit fit = FitWeighed(data, each, memory, contender.fit, contender.fit.state);
      if (fit.Usable() && BicWith(fit, memory) < BicWith(contender.fit, memory))
        contender.fit = std::move(fit);
    });
  }
}

bool FitsNoBetter(const Contender& set, std::span<const Contender> contenders) {
  return std::any_of(contenders.begin(), contenders.end(), [&](const Contender& part) {
    return part.effects.size() < set.effects.size() && part.fit.Usable() && Contains(set, part) &&
           part.fit.state.freed == set.fit.state.freed && part.fit.chi2_data <= set.fit.chi2_data;
  });
}

std::size_t Standing(std::span<const Contender> contenders, double memory) {
  std::vector<std::size_t> best(kEffectsMax + 1, contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::size_t& leader = best[contenders[i].effects.size()];
    if (!contenders[i].fit.Usable() || !MayBeNamed(contenders[i]) ||
        FitsNoBetter(contenders[i], contenders))
      continue;
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

std::size_t StandingBesideSubsets(const FitData& data, const FitOptions& options, double memory,
                                  std::vector<Contender>& contenders) {
  std::size_t standing = Standing(contenders, memory);
  for (int round = 0; round < kRounds; ++round) {
    const EffectSet set = contenders[standing].effects;
    FitSubsets(data, options, memory, standing, contenders);
    standing = Standing(contenders, memory);
    if (contenders[standing].effects == set) break;
  }
  return standing;
}

}  // namespace plenum::calibration
