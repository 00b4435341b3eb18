#include "calibration/experiment/experiment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "calibration/experiment/proposals.h"
#include "calibration/values/parallel.h"

namespace plenum::calibration {
namespace {

constexpr double kSpread = 0.5;  // a shorter run may be worth this share of the best
constexpr std::size_t kRehearsals = 3;
constexpr double kWorthMore = 0.5;  // of a pair: faster samples and a further channel
constexpr double kEnough = 1e-5;  // change of χ² that ends a rival's fit: a twentieth of BIC or so
constexpr double kBends = 4.0;    // Δχ² to first order over that of a full fit, at the most
constexpr double kRates[] = {1.0, 4.0};  // of sampling, against that of the data
constexpr const char* kPressure = "pressure_kpa_gauge";
constexpr int kProbeSamples = 400;
constexpr double kProbeShortest = 1e-3, kProbeLongest = 100.0;  // in strokes of typical size

struct Rated {
  Proposal proposal;
  RunWorth worth;
};

std::string Joined(const std::vector<std::string>& effects) {
  if (effects.empty()) return "no effect";
  std::string text;
  for (const std::string& effect : effects) text += (text.empty() ? "" : " + ") + effect;
  return text;
}

std::string Fixed(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// The time at which a course first passes a level, straight between the samples.
double Crossing(const std::vector<double>& t_s, const std::vector<double>& pressure_pa,
                double start_pa, double level_pa) {
  const bool rising = level_pa > start_pa;
  double before_s = 0.0, before_pa = start_pa;
  for (std::size_t i = 0; i < pressure_pa.size(); ++i) {
    if ((pressure_pa[i] >= level_pa) == rising)
      return before_s + (level_pa - before_pa) / (pressure_pa[i] - before_pa) * (t_s[i] - before_s);
    before_s = t_s[i];
    before_pa = pressure_pa[i];
  }
  return std::numeric_limits<double>::infinity();
}

class Designer {
 public:
  Designer(const FitData& data, const std::vector<TiedFit>& tied, const FitOptions& options)
      : data_(data), tied_(tied), options_(options) {}

  std::optional<Experiment> Design() {
    for (const TiedFit& one : tied_) {
      std::optional<Eigen::MatrixXd> curvature = Curvature(data_, *one.fit, options_);
      if (!curvature) return {};
      curvatures_.push_back(std::move(*curvature));
      rows_ = static_cast<double>(one.fit->rows);
      noise_scale_ = std::min(noise_scale_, std::max(1.0, one.fit->chi2_data / rows_));
    }
    std::vector<std::vector<Rated>> rated;  // by rate
    std::optional<Experiment> best;
    const auto keep = [&](std::optional<Experiment> found) {
      if (found && (!best || found->expected_delta_bic > best->expected_delta_bic))
        best = std::move(found);
      return Cancelled() || (best && best->expected_delta_bic >= kDecisiveDeltaBic);
    };
    for (const double rate : kRates) {
      rated.push_back(RateAll(rate));
      if (keep(Choose(rated.back(), kPressure, rate))) return best;
    }
    for (std::size_t i = 0; i < rated.size(); ++i)
      if (keep(Choose(rated[i], BestChannel(rated[i]), kRates[i]))) return best;
    if (std::optional<Experiment> found = ThatPartsMost(rated)) best = std::move(found);
    return best;
  }

 private:
  bool Cancelled() const { return options_.cancelled && options_.cancelled(); }
  const Dataset& dataset() const { return data_.forward->dataset(); }

  // The earliest of the models' crossings.
  double TimeOfStroke(Run probe, double level_pa) const {
    const double longest_s = kProbeLongest * data_.sizes.stroke_s;
    for (int i = 1; i <= kProbeSamples; ++i)
      probe.t_s.push_back(longest_s * std::pow(kProbeShortest / kProbeLongest,
                                               1.0 - static_cast<double>(i) / kProbeSamples));
    const ExtendedData extended(dataset(), probe, false);
    const ForwardModel forward(extended.dataset);
    double earliest_s = std::numeric_limits<double>::infinity();
    for (const TiedFit& one : tied_) {
      const Prediction prediction = forward.Predict(extended.run(), extended.With(one.fit->state),
                                                    {}, {.cancelled = options_.cancelled});
      earliest_s = std::min(earliest_s, Crossing(probe.t_s, prediction.reading.pressure_pa,
                                                 *probe.initial_pressure_pa, level_pa));
    }
    return earliest_s;
  }

  std::vector<Rated> RateAll(double rate) const {
    const std::vector<Proposal> proposals = ProposeRuns(
        dataset(), data_.runs, rate, (*data_.observed)[data_.runs.front()].noise.clip_high_pa,
        [&](const Run& stroke, double level) { return TimeOfStroke(stroke, level); });
    std::vector<std::optional<RunWorth>> worths(proposals.size());
    ForAll(proposals.size(), options_.threads, [&](std::size_t i) {
      if (!Cancelled()) worths[i] = WorthOf(data_, tied_, curvatures_, proposals[i].run, options_);
    });
    std::vector<Rated> rated;
    for (std::size_t i = 0; i < proposals.size(); ++i)
      if (worths[i]) rated.push_back({proposals[i], std::move(*worths[i])});
    return rated;
  }

  // By which the rival's BIC would grow with that much more χ², in noise that may be larger than
  // was read from the data.
  double DeltaBic(double chi2, const Run& run) const {
    const double n = rows_ + static_cast<double>(run.t_s.size());
    return n * std::log1p(chi2 / noise_scale_ / n);
  }

  // With a signal beside the pressure and what the data have; 0 where the run does not give it.
  double WorthWith(const Rated& rated, const std::string& signal) const {
    const std::vector<std::string>& names = rated.worth.names;
    const auto found = std::find(names.begin(), names.end(), signal);
    if (found == names.end()) return 0.0;
    return DeltaBic(rated.worth.pairs[found - names.begin()].front().delta_chi2,
                    rated.proposal.run);
  }

  double Best(const std::vector<Rated>& rated, const std::string& signal) const {
    double best = 0.0;
    for (const Rated& one : rated) best = std::max(best, WorthWith(one, signal));
    return best;
  }

  std::string BestChannel(const std::vector<Rated>& rated) const {
    std::string signal = kPressure;
    for (const NamedChannel& channel : NamedChannels())
      if (Best(rated, channel.name) > Best(rated, signal)) signal = channel.name;
    return signal;
  }

  std::optional<Experiment> Choose(const std::vector<Rated>& rated, const std::string& signal,
                                   double rate) const {
    return Rehearse(ShortestNear(rated, signal, Best(rated, signal)), signal, rate);
  }

  // Where no run parts all pairs: the one that parts most of them, rather than the one that comes
  // nearest to parting two that nothing does.
  std::optional<Experiment> ThatPartsMost(const std::vector<std::vector<Rated>>& rated) const {
    const Rated* most = nullptr;
    std::string signal;
    double rate = 1.0, parted = 0.0;
    for (std::size_t i = 0; i < rated.size(); ++i) {
      for (const Rated& one : rated[i]) {
        for (std::size_t s = 0; s < one.worth.names.size(); ++s) {
          const double pairs = PairsParted(one, s);
          if (!(pairs > parted + kWorthMore)) continue;
          parted = pairs, most = &one, signal = one.worth.names[s], rate = kRates[i];
        }
      }
    }
    return most && tied_.size() > 2 ? Rehearsed(*most, signal, rate, -1.0) : std::nullopt;
  }

  // Each counts by how far it is parted, those that are for sure alike.
  double PairsParted(const Rated& rated, std::size_t signal) const {
    double parted = 0.0;
    for (const PairWorth& pair : rated.worth.pairs[signal])
      parted += std::min(1.0, DeltaBic(pair.delta_chi2, rated.proposal.run) / kDecisiveDeltaBic);
    return parted;
  }

  // Those worth at least kSpread of the best, short before long: a few, and the best.
  std::vector<const Rated*> ShortestNear(const std::vector<Rated>& rated, const std::string& signal,
                                         double best) const {
    std::vector<const Rated*> near;
    for (const Rated& one : rated)
      if (WorthWith(one, signal) >= kSpread * best && best > 0.0) near.push_back(&one);
    std::stable_sort(near.begin(), near.end(), [](const Rated* a, const Rated* b) {
      return a->proposal.run.t_s.back() < b->proposal.run.t_s.back();
    });
    if (near.size() > kRehearsals) {
      const auto worth_less = [&](const Rated* a, const Rated* b) {
        return WorthWith(*a, signal) < WorthWith(*b, signal);
      };
      const Rated* largest = *std::max_element(near.begin(), near.end(), worth_less);
      near.resize(kRehearsals);
      if (std::find(near.begin(), near.end(), largest) == near.end()) near.back() = largest;
    }
    return near;
  }

  // One after the other, until one decides; the best otherwise.
  std::optional<Experiment> Rehearse(const std::vector<const Rated*>& order,
                                     const std::string& signal, double rate) const {
    std::optional<Experiment> best;
    for (const Rated* one : order) {
      if (Cancelled()) break;
      const double least_bic = best ? best->expected_delta_bic : -1.0;
      std::optional<Experiment> experiment = Rehearsed(*one, signal, rate, least_bic);
      if (experiment && experiment->expected_delta_bic > least_bic) best = std::move(experiment);
      if (best && best->expected_delta_bic >= kDecisiveDeltaBic) break;
    }
    return best;
  }

  // The pair that a run parts least, the rivals fitted in full: one that bends further than the
  // first order sees may come nearer than the one that seemed nearest. None where it parts
  // one by less than `enough_bic`.
  std::optional<Experiment> Rehearsed(const Rated& rated, const std::string& signal, double rate,
                                      double enough_bic) const {
    const ExtendedData extended(dataset(), rated.proposal.run, false);
    const ForwardModel forward(extended.dataset);
    std::vector<Prediction> shown;
    for (const TiedFit& one : tied_) {
      shown.push_back(forward.Predict(extended.run(), extended.With(one.fit->state), {},
                                      {.cancelled = options_.cancelled}));
      if (shown.back().status != model::SimulateStatus::kDone) return {};
    }
    const std::vector<std::string>& names = rated.worth.names;
    const auto found = std::find(names.begin(), names.end(), signal);
    const std::vector<PairWorth>& pairs = rated.worth.pairs[found - names.begin()];
    const auto far = std::find_if(pairs.begin(), pairs.end(), [&](const PairWorth& pair) {
      return pair.delta_chi2 > kBends * pairs.front().delta_chi2;
    });
    std::vector<std::optional<Experiment>> refitted(far - pairs.begin());
    std::atomic<bool> ended = false;
    ForAll(refitted.size(), options_.threads, [&](std::size_t i) {
      if (ended || Cancelled()) return;
      const int threads = ThreadsWithin(i, refitted.size(), options_.threads);
      refitted[i] = Refitted(rated, pairs[i], shown, signal, rate, threads);
      if (!refitted[i] || refitted[i]->expected_delta_bic < enough_bic) ended = true;
    });
    if (ended || std::find(refitted.begin(), refitted.end(), std::nullopt) != refitted.end())
      return {};
    return std::move(
        *std::min_element(refitted.begin(), refitted.end(), [](const auto& a, const auto& b) {
          return a->expected_delta_bic < b->expected_delta_bic;
        }));
  }

  std::optional<Experiment> Refitted(const Rated& rated, const PairWorth& pair,
                                     const std::vector<Prediction>& shown,
                                     const std::string& signal, double rate, int threads) const {
    const std::size_t truth = pair.truth, rival = pair.rival;
    ExtendedData extended(dataset(), rated.proposal.run, true);
    Run& run = extended.dataset.runs.back();
    std::vector<std::string> seen;
    ObservedRun would = WouldObserve((*data_.observed)[data_.runs.front()], run, shown, seen);
    Experiment experiment;
    for (std::size_t s = would.signals.size(); s-- > 1;) {
      if (seen[s] == signal || InData(data_, seen[s]))
        experiment.measure.insert(experiment.measure.begin(), seen[s]);
      else
        would.signals.erase(would.signals.begin() + static_cast<std::ptrdiff_t>(s));
    }
    run.pressure_pa = shown[truth].reading.pressure_pa;
    run.channels = shown[truth].reading.channels;
    std::vector<ObservedRun> observed = *data_.observed;
    observed.push_back(std::move(would));

    const ForwardModel forward(extended.dataset);
    FitData data = data_;
    data.forward = &forward;
    data.observed = &observed;
    data.runs.push_back(extended.run());
    const Fit& before = *tied_[rival].fit;
    const Fit refit = LeastOf(data, StartsOf(extended.With(before.state)), threads);
    if (!refit.Usable()) return {};
    const Reading answer = Predicted(data, refit.state, extended.run(), options_);
    if (answer.pressure_pa.size() != run.pressure_pa.size()) return {};
    double squares = 0.0;
    for (std::size_t i = 0; i < run.pressure_pa.size(); ++i)
      squares += std::pow(run.pressure_pa[i] - answer.pressure_pa[i], 2);
    const double left = refit.chi2_data + refit.chi2_prior - before.chi2_data - before.chi2_prior;
    experiment.run = rated.proposal.run;
    const double ahead = before.bic - tied_[truth].fit->bic;
    experiment.expected_delta_bic = std::max(0.0, DeltaBic(std::max(0.0, left), run) + ahead);
    experiment.expected_difference_pa =
        std::sqrt(squares / static_cast<double>(run.pressure_pa.size()));
    std::vector<double> rows(observed.back().rows());
    Residuals(run, observed.back(), answer, rows);
    const auto pressure_rows = static_cast<std::ptrdiff_t>(run.pressure_pa.size());
    const auto squared = [](double sum, double e) { return sum + e * e; };
    Parts parts;
    parts.pressure = std::accumulate(rows.begin(), rows.begin() + pressure_rows, 0.0, squared);
    parts.channels = std::accumulate(rows.begin() + pressure_rows, rows.end(), 0.0, squared);
    parts.earlier = left - parts.pressure - parts.channels;
    experiment.why = Why(rated.proposal, experiment, parts, truth, rival, rate);
    return experiment;
  }

  // From where a rival is fitted again: where it is, and where its only effect is usually sought,
  // because with a run more another optimum may be its best.
  std::vector<ModelState> StartsOf(const ModelState& state) const {
    std::vector<ModelState> starts = {state};
    if (state.effects.size() != 1u) return starts;
    for (const model::Effect& effect : EffectStarts(*state.effects.front().spec, data_.sizes)) {
      starts.push_back(state);
      starts.back().effects = {effect};
    }
    return starts;
  }

  // As exactly as a ΔBIC needs.
  Fit LeastOf(const FitData& data, const std::vector<ModelState>& starts, int threads) const {
    const auto chi2 = [](const Fit& fit) { return fit.chi2_data + fit.chi2_prior; };
    FitOptions enough;
    enough.function_tolerance = kEnough;
    enough.steps_max = options_.steps_max;
    enough.cancelled = options_.cancelled;
    std::vector<Fit> fits(starts.size());
    ForAll(starts.size(), threads, [&](std::size_t i) {
      FitOptions each = enough;
      each.threads = ThreadsWithin(i, starts.size(), threads);
      fits[i] = FitModel(data, starts[i], each);
    });
    Fit least;
    for (Fit& fit : fits)
      if (fit.Usable() && (!least.Usable() || chi2(fit) < chi2(least))) least = std::move(fit);
    return least;
  }

  // Where the χ² is that the rival is left with: in the proposed run's pressure, in its channels,
  // or in the runs at hand, which it has to leave to come near the proposed one.
  struct Parts {
    double pressure = 0.0, channels = 0.0, earlier = 0.0;
  };

  std::string Why(const Proposal& proposal, const Experiment& experiment, const Parts& parts,
                  std::size_t truth, std::size_t rival, double rate) const {
    const double noise_pa = (*data_.observed)[data_.runs.front()].signals.front().sigma;
    std::string why = proposal.what;
    if (rate > 1.0) why += ", sampled " + Fixed(rate, "%.0f") + " times as fast";
    why += ": after " + Joined(tied_[rival].effects) + " is fitted again to all data, it and " +
           Joined(tied_[truth].effects) + " still differ by " +
           Fixed(experiment.expected_difference_pa / 1e3, "%.2g") + " kPa (RMS, " +
           Fixed(experiment.expected_difference_pa / noise_pa, "%.2g") + " times the noise)";
    if (parts.channels > std::max(parts.pressure, parts.earlier))
      why += "; " + Joined(experiment.measure) + " parts them";
    else if (parts.earlier > parts.pressure)
      why += "; to come that near it must leave the runs at hand, which parts them";
    why[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(why[0])));
    return why + ".";
  }

  const FitData& data_;
  const std::vector<TiedFit>& tied_;
  const FitOptions& options_;
  std::vector<Eigen::MatrixXd> curvatures_;
  double rows_ = 0.0;
  double noise_scale_ = std::numeric_limits<double>::infinity();  // χ²/n of the best, at least 1
};

}  // namespace

std::optional<Experiment> DesignExperiment(const FitData& data, const std::vector<TiedFit>& tied,
                                           const FitOptions& options) {
  if (tied.size() < 2 || data.runs.empty()) return {};
  return Designer(data, tied, options).Design();
}

}  // namespace plenum::calibration
