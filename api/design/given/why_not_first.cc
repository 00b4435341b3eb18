#include "api/design/given/why_not_first.h"

#include <algorithm>
#include <cmath>

#include "api/design/given/exchanges.h"
#include "api/design/given/requirement_words.h"
#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

using optimizer::Design;
using optimizer::LeafStatus;

constexpr double kMet = -1e-9;          // relative margin from which on a requirement is met
constexpr double kNoDifference = 1e-9;  // of the objective
constexpr std::size_t kPartsTold = 3;   // in words

double ObjectiveOf(const optimizer::Choice* row, const optimizer::Objective& of) {
  if (row == nullptr) return 0.0;
  return of.mass_kg * row->mass_kg + of.volume_l * row->volume_m3 * 1e3 +
         of.cost_eur * row->cost_eur.value_or(0.0);
}

std::vector<optimizer::Margin> MissedBy(const std::optional<Design>& design) {
  std::vector<optimizer::Margin> missed;
  if (design)
    std::copy_if(design->margins.begin(), design->margins.end(), std::back_inserter(missed),
                 [](const optimizer::Margin& margin) { return margin.relative_margin < kMet; });
  return missed;
}

std::string PercentOf(double share) {
  return Decimal(Rounded(std::round(1e3 * share) / 10.0)) + " %";
}

const char* NameOf(LeafStatus status) {
  return status == LeafStatus::kFeasible     ? "feasible"
         : status == LeafStatus::kInfeasible ? "infeasible"
                                             : "undecided";
}

class WhyNot {
 public:
  WhyNot(const optimizer::Problem& problem, const std::vector<catalog::Part>& catalogue,
         const Compared& compared, const std::function<bool()>& stop)
      : problem_(problem),
        of_(problem.objective),
        rows_(RowsOf(catalogue)),
        first_(compared.first),
        as_given_(compared.as_given),
        missed_(MissedBy(as_given_)),
        best_(optimizer::AtBestSettings(optimizer::WithPartsOf(problem, compared.given),
                                        compared.given, stop)),
        mine_(best_.design ? *best_.design
              : as_given_  ? *as_given_
                           : compared.given),
        exchanges_(mine_.configuration == first_.configuration
                       ? Exchanges(problem, catalogue, mine_, first_, stop)
                       : std::vector<Exchange>{}) {}

  Json Document() {
    TellMissed();
    TellSettings();
    const bool known = best_.design || as_given_;
    Json parts = Json::array();
    if (known) parts = TellParts();
    Json document = {
        {"objective", known ? Number(mine_.objective) : Json(nullptr)},
        {"first_objective", Number(first_.objective)},
        {"difference", known ? Number(mine_.objective - first_.objective) : Json(nullptr)},
        {"missed", RenderMissed()},
        {"best_settings", RenderBest()},
        {"parts", std::move(parts)},
        {"energy_difference", known ? Number(EnergyOf(mine_) - EnergyOf(first_)) : Json(nullptr)},
        {"exchanges", RenderExchanges()}};
    TellExchanges();
    document["words"] = words_;
    return document;
  }

 private:
  double EnergyOf(const Design& design) const {
    return of_.energy_wh * design.totals.energy_j / 3600.0;
  }
  std::string Amount(double objective) const { return ObjectiveInWords(objective, of_); }
  std::string Part(const optimizer::Choice& row) const { return PartInWords(row, problem_, rows_); }

  Json RenderMissed() const {
    Json list = Json::array();
    for (const optimizer::Margin& margin : missed_)
      list.push_back({{"requirement", margin.requirement},
                      {"required", Number(margin.required)},
                      {"achieved", Number(margin.achieved)},
                      {"relative_margin", Number(margin.relative_margin)}});
    return list;
  }

  Json RenderBest() const {
    Json best = {{"status", NameOf(best_.status)}};
    if (best_.design) best.update(RenderFigures(*best_.design, problem_));
    return best;
  }

  void TellMissed() {
    if (!as_given_) {
      words_.push_back(
          "At its settings it does not work: a stroke takes longer than half of the period, or its "
          "parts do not stand the source pressure.");
      return;
    }
    for (const optimizer::Margin& margin : missed_)
      words_.push_back("It misses a requirement: " + MarginInWords(margin, problem_) + ".");
  }

  // Pumps without a reservoir have no setting.
  std::string SourceOf(const Design& design) const {
    const auto& settings = design.settings;
    if (optimizer::IsDirect(design.configuration)) return "the pressures of their strokes";
    std::string text;
    for (const double pa : settings.group_pressure_pa)
      text += (text.empty() ? "" : " and ") + Told(optimizer::KpaGauge(problem_, pa));
    if (text.empty()) text = Told(optimizer::KpaGauge(problem_, settings.source_pressure_pa));
    text += " kPa gauge";
    if (optimizer::KeepsReservoir(design.configuration))
      text +=
          " and a reservoir of " + Told(settings.reservoir_volume_m3.value_or(0.0) * 1e6) + " mL";
    return text;
  }

  void TellSettings() {
    const bool meets = as_given_ && missed_.empty();
    if (best_.status == LeafStatus::kInfeasible && !meets) {
      words_.push_back("No settings of its parts meet all requirements.");
    } else if (best_.status == LeafStatus::kUndecided && !meets) {
      words_.push_back("Whether other settings of its parts meet all requirements is not known.");
    } else if (best_.design && !meets) {
      words_.push_back("Its parts meet all requirements at " + SourceOf(*best_.design) + ".");
    } else if (best_.design && as_given_->objective > best_.design->objective * (1.0 + 1e-6)) {
      words_.push_back("At " + SourceOf(*best_.design) + " its parts come to " +
                       Amount(best_.design->objective) + " instead of " +
                       Amount(as_given_->objective) + ".");
    }
  }

  Json RenderRow(const optimizer::Choice* row) const {
    if (row == nullptr) return nullptr;
    return {{"id", row->id},
            {"quantity", Number(row->quantity)},
            {"objective", Number(ObjectiveOf(row, of_))}};
  }

  Json Place(const RowPair& pair) const {
    const optimizer::Choice& row = pair.place();
    return {{"family", optimizer::Name(row.family)},
            {"group", row.group < 0 ? Json(nullptr) : Json(problem_.groups[row.group].name)}};
  }

  // What makes the difference, the most of it first.
  Json TellParts() {
    TellDifference();
    std::vector<std::pair<double, RowPair>> shares;
    for (const RowPair& pair : Differences(mine_, first_))
      shares.emplace_back(ObjectiveOf(pair.given, of_) - ObjectiveOf(pair.other, of_), pair);
    std::stable_sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
      return std::abs(a.first) > std::abs(b.first);
    });
    Json parts = Json::array();
    std::string told;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const auto& [share, pair] = shares[i];
      Json row = Place(pair);
      row["given"] = RenderRow(pair.given);
      row["first"] = RenderRow(pair.other);
      row["difference"] = Number(share);
      parts.push_back(std::move(row));
      if (i >= kPartsTold || std::abs(share) <= kNoDifference * std::abs(first_.objective))
        continue;
      told += (told.empty() ? "" : "; ") + Instead(pair) + " " + Amount(std::abs(share)) +
              (share > 0.0 ? " more" : " less");
    }
    const double energy = EnergyOf(mine_) - EnergyOf(first_);
    if (std::abs(energy) > kNoDifference * std::abs(first_.objective))
      told += (told.empty() ? "" : "; ") + std::string("energy ") + Amount(std::abs(energy)) +
              (energy > 0.0 ? " more" : " less");
    if (!told.empty()) words_.push_back("Of that: " + told + ".");
    return parts;
  }

  // "battery A in place of B"
  std::string Instead(const RowPair& pair) const {
    if (!pair.other) return Part(*pair.given) + ", which the other does without,";
    if (!pair.given) return "no " + Part(*pair.other);
    return SamePart(pair) ? Part(*pair.given)
                          : Part(*pair.given) + " in place of " + Part(*pair.other);
  }

  void TellDifference() {
    const double difference = mine_.objective - first_.objective;
    if (std::abs(difference) <= kNoDifference * std::abs(first_.objective)) {
      words_.push_back("It comes to the same, " + Amount(mine_.objective) +
                       "; what ties goes by mass, cost and ids of parts.");
      return;
    }
    std::string share;
    if (first_.objective > 0.0)
      share = " (" + PercentOf(std::abs(difference) / first_.objective) + ")";
    const std::string by = Amount(std::abs(difference)) + share;
    words_.push_back("It comes to " + Amount(mine_.objective) + ", " + by +
                     (difference > 0.0 ? " more than the first." : " less than the first."));
    if (difference < 0.0 && best_.design)
      words_.push_back(
          "That is better: the list was made with other parts or other requirements, or it was "
          "not proved.");
  }

  Json RenderExchanges() const {
    Json list = Json::array();
    for (const Exchange& exchange : exchanges_) {
      Json parts = Json::array();
      for (const RowPair& pair : exchange.rows) {
        Json row = Place(pair);
        row["given"] = RenderRow(pair.given);
        row["first"] = RenderRow(pair.other);
        parts.push_back(std::move(row));
      }
      const auto& made = exchange.made;
      list.push_back({{"parts", std::move(parts)},
                      {"status", NameOf(made.status)},
                      {"objective", made.design ? Number(made.design->objective) : Json(nullptr)}});
    }
    return list;
  }

  // The exchange that comes out best.
  void TellExchanges() {
    const Exchange* best = nullptr;
    bool decided = true;
    for (const Exchange& exchange : exchanges_) {
      decided = decided && exchange.made.status != LeafStatus::kUndecided;
      if (exchange.made.design &&
          (!best || exchange.made.design->objective < best->made.design->objective))
        best = &exchange;
    }
    const bool wanted = !best_.design;
    if (best &&
        (wanted || best->made.design->objective < mine_.objective * (1.0 - kNoDifference))) {
      std::string parts;
      for (const RowPair& pair : best->rows)
        if (pair.other) parts += (parts.empty() ? "" : " and ") + Part(*pair.other);
      const auto& design = *best->made.design;
      words_.push_back("With the first's " + parts + " it would " +
                       (wanted ? "meet all requirements, and come to " : "come to ") +
                       Amount(design.objective) + ".");
    } else if (wanted && decided && !exchanges_.empty()) {
      words_.push_back("No exchange of one of its parts for that of the first makes up for it.");
    }
  }

  const optimizer::Problem& problem_;
  const optimizer::Objective& of_;
  const Rows rows_;
  const Design& first_;
  const std::optional<Design>& as_given_;
  const std::vector<optimizer::Margin> missed_;
  const optimizer::Remade best_;
  const Design& mine_;
  const std::vector<Exchange> exchanges_;
  std::vector<std::string> words_;
};

}  // namespace

Json WhyNotFirst(const optimizer::Problem& problem, const std::vector<catalog::Part>& catalogue,
                 const Compared& compared, const std::function<bool()>& stop) {
  return WhyNot(problem, catalogue, compared, stop).Document();
}

}  // namespace plenum::api
