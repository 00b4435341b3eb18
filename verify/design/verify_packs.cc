// Whole packs.
#include <algorithm>
#include <cmath>

#include "verify/design/verify_design.h"
#include "verify/design/verify_families.h"

namespace plenum::verify {
namespace {

constexpr double kLengthRounding = 1e-9;  // of a pack

// The part of a row; null: it is none of the catalogue.
const model::PartBasics* PartOf(const Problem& problem, const Choice& row) {
  const int part = FindPart(problem.parts, row.family, row.id);
  return part < 0 ? nullptr : &BasicsOf(problem.parts, row.family, part);
}

double PiecesOfAll(const Design& design, const Choice& row) {
  double pieces = 0.0;
  for (const Choice& other : design.parts)
    if (other.family == row.family && other.id == row.id) pieces += other.quantity;
  return pieces;
}

}  // namespace

double PacksNeeded(double pieces, const model::PartBasics& basics) {
  double packs = std::floor(pieces / basics.pack);
  if (pieces > (packs + kLengthRounding) * basics.pack) packs += 1.0;
  return packs;
}

double CostInPacks(double pieces, const model::PartBasics& basics) {
  if (!basics.cost_eur) return 0.0;
  if (!(basics.pack > 0.0)) return pieces * *basics.cost_eur;
  return PacksNeeded(pieces, basics) * basics.pack * *basics.cost_eur;
}

bool HasPacks(const Problem& problem) {
  for (const FamilySpec& spec : optimizer::Families())
    for (int part = 0; part < optimizer::FamilySize(problem.parts, spec.family); ++part)
      if (spec.basics(problem.parts, part).pack > 0.0) return true;
  return false;
}

bool MaySharePacks(const Problem& problem, int group) {
  return group >= 0 && problem.groups.size() > 1;
}

std::pair<double, double> OpenPacksEur(double pieces, const model::PartBasics& basics) {
  if (!basics.cost_eur || !(basics.pack > 0.0)) return {};
  const double counted = pieces * *basics.cost_eur;
  const double begun = std::floor(pieces / basics.pack) * basics.pack * *basics.cost_eur;
  return {std::max(0.0, CostInPacks(pieces, basics) - counted), std::max(0.0, counted - begun)};
}

double PackedCosts::Sum() const {
  double sum_eur = sum_eur_;
  for (const auto& [part, pieces] : packed_) sum_eur += CostInPacks(pieces, *part);
  return sum_eur;
}

void PackedCosts::AddPacked(const model::PartBasics& part, double pieces) {
  const auto same = std::find_if(packed_.begin(), packed_.end(),
                                 [&](const auto& other) { return other.first == &part; });
  if (same == packed_.end())
    packed_.emplace_back(&part, pieces);
  else
    same->second += pieces;
}

std::vector<optimizer::PackRow> PacksBought(const Problem& problem, const Design& design) {
  std::vector<optimizer::PackRow> packs;
  for (const Choice& row : design.parts) {
    const model::PartBasics* part = PartOf(problem, row);
    if (!part || !part->cost_eur || !(part->pack > 0.0)) continue;
    if (std::any_of(packs.begin(), packs.end(), [&](const optimizer::PackRow& known) {
          return known.family == row.family && known.id == row.id;
        }))
      continue;
    const double pieces = PiecesOfAll(design, row);
    packs.push_back({row.family, row.id, pieces, part->pack, PacksNeeded(pieces, *part),
                     CostInPacks(pieces, *part)});
  }
  return packs;
}

std::vector<std::optional<double>> RowCosts(const Problem& problem, const Design& design) {
  std::vector<std::optional<double>> costs;
  for (const Choice& row : design.parts) {
    const model::PartBasics* part = PartOf(problem, row);
    costs.emplace_back();
    if (!part || !part->cost_eur) continue;
    const double pieces = PiecesOfAll(design, row);
    costs.back() = pieces > 0.0 ? CostInPacks(pieces, *part) * row.quantity / pieces : 0.0;
  }
  return costs;
}

void CheckPacks(const Problem& problem, const Design& design, Findings& findings) {
  const std::vector<optimizer::PackRow> bought = PacksBought(problem, design);
  const bool same = std::equal(
      bought.begin(), bought.end(), design.packs.begin(), design.packs.end(),
      [](const optimizer::PackRow& a, const optimizer::PackRow& b) {
        return a.family == b.family && a.id == b.id && a.packs == b.packs &&
               Near(a.quantity, b.quantity, kSumTolerance) && Near(a.pack, b.pack, kSumTolerance) &&
               Near(a.cost_eur, b.cost_eur, kSumTolerance);
      });
  if (!same) findings.push_back({"amounts", "packs are not what the parts are sold in"});
}

}  // namespace plenum::verify
