// Which cases can be told apart at all: refits every rival set of effects to the readings without
// noise and compares at the case's noise.
//   identify FOLDER [THREADS]
// For each FOLDER/truth/NNNN.json with its perfect/NNNN.json (see make_cases) writes
// FOLDER/identify/NNNN.json with the rival that comes nearest and its distance in BIC
// (`distance_bic`), that of no effect at all (`without_bic`), and the single effects within 10
// (`near`). A case is identifiable if no rival is within 10; the first pair that is ends the
// search. Clean cases, which every set contains, and those outside the list are left out.
//
// Rivals: no effect, every single one, pairs of the best singles; of a pair also either of its
// effects with every other one. Never a set that contains the true one, and no learned term: it is
// no name, and follows many laws. Every start of an effect is tried, of a line alone also the
// lengths that ring in step with the best. Runs are thinned to kSamples each with the noise scaled
// so that they say as much.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "api/measure/measurement.h"
#include "calibration/fit/fit.h"
#include "calibration/fit/start_scan.h"
#include "calibration/search/contenders.h"
#include "tests/support/bench/bench_dataset.h"
#include "tests/support/bench/bench_json.h"

namespace plenum::bench {
namespace {

using api::Json;
using calibration::Dataset;
using calibration::ForwardModel;
using calibration::ModelState;
using Effects = std::vector<model::Effect>;
using Ids = std::set<std::string>;

constexpr std::size_t kSamples = 200;
constexpr double kApart = 10.0;
// A first reading without noise would pass for where the declared initial pressure comes from.
constexpr double kNudgePa = 1e-3;
constexpr std::size_t kBestSingles = 3;
constexpr double kNoiseShare = 0.1;
constexpr int kFirstLook = 10, kIterations = 25;
constexpr double kHopeless = 2e3;  // in BIC: what is as far off after a first look stays apart
constexpr std::chrono::seconds kFitLimit{4};

Ids IdsOf(const Effects& effects) {
  Ids ids;
  for (const model::Effect& effect : effects) ids.insert(std::string(effect.spec->id));
  return ids;
}

bool Contains(const Ids& all, const Ids& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

std::vector<const model::EffectSpec*> NamedEffects() {
  std::vector<const model::EffectSpec*> named;
  for (const model::EffectSpec* spec : model::Effects()) {
    if (!spec->id.starts_with("learned_")) named.push_back(spec);
  }
  return named;
}

class Judge {
 public:
  Judge(Dataset perfect, double noise_pa, const Json& truth)
      : dataset_(std::move(perfect)), truth_(IdsOf(test::ListedOf(truth))) {
    data_.sizes = calibration::SizesOf(dataset_);  // of all readings: what is visible in them
    Thin(noise_pa);
    forward_.emplace(dataset_);
    data_.forward = &*forward_;
    data_.observed = &observed_;
    for (std::size_t r = 0; r < dataset_.runs.size(); ++r) {
      if (!HeldOut(dataset_.runs[r])) data_.runs.push_back(r);
    }
    true_ = forward_->Declared();
    true_.effects = test::ListedOf(truth);
    for (std::size_t n = 0; n < true_.factor.size(); ++n) {
      const auto& numbers = truth["numbers"];
      const auto number = numbers.find(std::string(Name(static_cast<calibration::Declared>(n))));
      if (number != numbers.end()) true_.factor[n] = (*number)["factor"];
    }
    true_bic_ = Bic(true_, kIterations).bic;
  }

  Json Nearest() {
    Consider({});
    const double without = nearest_.bic - true_bic_;
    for (const model::EffectSpec* spec : NamedEffects()) ConsiderFrom({}, *spec);
    ConsiderInStep();
    std::sort(singles_.begin(), singles_.end(),
              [](const Tried& a, const Tried& b) { return a.bic < b.bic; });
    for (std::size_t i = 0; i < std::min(kBestSingles, singles_.size()); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        Effects pair = singles_[i].effects;
        pair.push_back(singles_[j].effects[0]);
        if (IdsOf(pair).size() == 2) Consider(pair);
      }
    }
    if (true_.effects.size() == 2) {
      for (const model::Effect& kept : true_.effects) {
        for (const model::EffectSpec* spec : NamedEffects()) ConsiderFrom({kept}, *spec);
      }
    }
    const double distance = nearest_.bic - true_bic_;
    return {{"identifiable", std::isfinite(true_bic_) && distance > kApart},
            {"distance_bic", std::isfinite(distance) ? Json(distance) : Json(nullptr)},
            {"rival", IdsOf(nearest_.effects)},
            {"without_bic", std::isfinite(without) ? Json(without) : Json(nullptr)},
            {"near", Near()},
            {"fits", fits_},
            {"unusable", unusable_}};
  }

 private:
  struct Tried {
    Effects effects;
    double bic = INFINITY;
    ModelState state = {};
  };

  // The single effects that do as well.
  Ids Near() const {
    Ids near;
    for (const Tried& single : singles_)
      if (single.bic < true_bic_ + kApart) near.merge(IdsOf(single.effects));
    return near;
  }

  bool HeldOut(const calibration::Run& run) const {
    return std::count(dataset_.holdout.begin(), dataset_.holdout.end(), run.id) > 0;
  }

  // A measured source drives the model and stays whole.
  void Thin(double noise_pa) {
    for (calibration::Run& run : dataset_.runs) {
      const bool whole = run.supply == calibration::Supply::kMeasured;
      const std::size_t every = whole ? 1 : std::max<std::size_t>(1, run.t_s.size() / kSamples);
      if (!HeldOut(run)) rows_ += run.t_s.size();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < run.t_s.size(); i += every, ++kept) {
        run.t_s[kept] = run.t_s[i];
        run.pressure_pa[kept] = run.pressure_pa[i];
      }
      run.t_s.resize(kept);
      run.pressure_pa.resize(kept);
      run.pressure_pa.front() += kNudgePa;
      calibration::ObservedSignal signal;
      for (std::size_t i = 0; i < kept; ++i) signal.samples.push_back(i);
      signal.steps.assign(kept, {});
      signal.sigma = noise_pa / std::sqrt(static_cast<double>(every));
      calibration::ObservedRun observed;
      observed.signals.push_back(signal);
      observed_.push_back(observed);
    }
  }

  struct Score {
    double bic = INFINITY;
    ModelState state;
  };

  // χ² with priors, and the penalty of every reading that was thinned out.
  Score Bic(const ModelState& start, int iterations) {
    const auto begun = std::chrono::steady_clock::now();
    calibration::FitOptions options;
    options.noise_share = kNoiseShare;
    options.iterations_max = iterations;
    options.cancelled = [&] { return std::chrono::steady_clock::now() - begun > kFitLimit; };
    const calibration::Fit fit = calibration::FitModel(data_, start, options);
    ++fits_;
    if (!fit.Usable()) {
      ++unusable_;
      return {};
    }
    const auto k = static_cast<double>(fit.coordinates.size());
    return {fit.chi2_data + fit.chi2_prior + k * std::log(static_cast<double>(rows_)), fit.state};
  }

  void Consider(const Effects& effects) {
    if (Contains(IdsOf(effects), truth_) || Found(effects)) return;
    ModelState start = forward_->Declared();
    start.effects = effects;
    Score score = Bic(start, kFirstLook);
    if (score.bic < true_bic_ + kHopeless) {
      start = score.state;
      score = Bic(start, kIterations);
    }
    if (score.bic == INFINITY) return;
    const Tried tried = {score.state.effects, score.bic, score.state};
    if (effects.size() == 1) TakeSingle(tried);
    if (tried.bic < nearest_.bic) nearest_ = tried;
  }

  // One rival is enough, but all single effects are told.
  bool Found(const Effects& effects) const {
    return effects.size() > 1 && nearest_.bic < true_bic_ + kApart;
  }

  void ConsiderFrom(const Effects& kept, const model::EffectSpec& spec) {
    for (const model::Effect& start : calibration::EffectStarts(spec, data_.sizes)) {
      Effects effects = kept;
      effects.push_back(start);
      if (IdsOf(effects).size() == effects.size()) Consider(effects);
    }
  }

  void TakeSingle(const Tried& tried) {
    const auto same = std::find_if(singles_.begin(), singles_.end(), [&](const Tried& other) {
      return other.effects[0].spec == tried.effects[0].spec;
    });
    if (same == singles_.end())
      singles_.push_back(tried);
    else if (tried.bic < same->bic)
      *same = tried;
  }

  // A line rings in step with another one at many lengths, as the diagnosis knows: from the best
  // one again, as long as that does better.
  void ConsiderInStep() {
    double before = INFINITY;
    while (true) {
      const auto line = std::find_if(singles_.begin(), singles_.end(), [](const Tried& tried) {
        return tried.effects[0].spec->id == "line_dynamics";
      });
      if (line == singles_.end() || !(line->bic < before - calibration::kSameOptimum)) return;
      before = line->bic;
      const calibration::Fit fit = calibration::FitModel(data_, line->state, {});
      for (const ModelState& start : calibration::ScannedAgain(data_, fit, {}))
        Consider(start.effects);
    }
  }

  Dataset dataset_;
  Ids truth_;
  std::optional<ForwardModel> forward_;
  std::vector<calibration::ObservedRun> observed_;
  calibration::FitData data_;
  ModelState true_;
  std::size_t rows_ = 0;
  double true_bic_ = INFINITY;
  std::vector<Tried> singles_;
  Tried nearest_;
  int fits_ = 0, unusable_ = 0;
};

Json Read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

void Identify(const std::filesystem::path& folder, const std::filesystem::path& name) {
  const Json truth = Read(folder / "truth" / name);
  if (truth["kind"] == "clean" || truth["kind"] == "outside") return;
  const Json perfect = Read(folder / "perfect" / name);
  const auto dataset = api::ParseMeasurement(perfect["measurement"]);
  const std::string nearest =
      Judge(std::get<Dataset>(dataset), perfect["noise_pa"], truth).Nearest().dump();
  std::ofstream(folder / "identify" / name) << nearest << '\n';
}

}  // namespace
}  // namespace plenum::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: identify FOLDER [THREADS]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int threads = argc > 2 ? std::atoi(argv[2]) : 2;
  std::filesystem::create_directories(folder / "identify");
  std::vector<std::filesystem::path> truths;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "truth")) {
    if (!std::filesystem::exists(folder / "identify" / entry.path().filename())) {
      truths.push_back(entry.path());
    }
  }
  std::sort(truths.begin(), truths.end());
  std::atomic<std::size_t> next = 0;
  std::atomic<int> failed = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < truths.size(); i = next++) {
      try {
        plenum::bench::Identify(folder, truths[i].filename());
      } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", truths[i].c_str(), e.what());
        ++failed;
      }
    }
  };
  std::vector<std::thread> pool;
  for (int k = 0; k < threads; ++k) pool.emplace_back(work);
  for (std::thread& thread : pool) thread.join();
  return failed > 0 ? 3 : 0;
}
