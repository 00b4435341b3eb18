#include "api/design/read/selection.h"

#include <algorithm>
#include <map>
#include <string>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/own_pumps.h"
#include "api/design/read/supply/power.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/request_limits.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "catalog/fields/price.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/joints.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::Family;

// Whether the request leaves a part of the family to choose.
bool HasChoice(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
               Family family) {
  if (optimizer::MadeToMeasureAllowed(problem, family)) return true;
  if (family == Family::kBattery && HasOutsidePower(problem)) return true;
  if (family == Family::kRegulator && HasWallVacuum(problem)) return true;
  return std::any_of(parts.begin(), parts.end(), [&](const catalog::Part& part) {
    return part.family == optimizer::Name(family) && IsAllowed(problem, family, part);
  });
}

// Where to look for the reason why a family is empty.
std::string PointerFor(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                       Family family) {
  const std::string name = optimizer::Name(family);
  if (problem.require.contains(optimizer::CatalogueFamily(family))) return "/require/" + name;
  const bool in_catalogue = std::any_of(
      parts.begin(), parts.end(), [&](const catalog::Part& part) { return part.family == name; });
  if (!in_catalogue && !optimizer::SpecOf(family).made_to_measure) return "";
  return problem.exclude.empty() && problem.orderable_only ? "/supply/parts" : "/exclude";
}

}  // namespace

bool IsAllowed(const optimizer::Problem& problem, Family family, const std::string& id) {
  const auto required = problem.require.find(optimizer::CatalogueFamily(family));
  return !problem.exclude.contains(id) &&
         (required == problem.require.end() || required->second.contains(id));
}

bool SuitsOrder(const optimizer::Problem& problem, const catalog::Part& part) {
  return !problem.orderable_only || part.orderable.value_or(true) || part.family == "manifold";
}

bool HasItsPressure(const optimizer::Problem& problem, const catalog::Part& part) {
  constexpr double kRounding = 1.0 + 1e-9;
  const auto needed = part.numbers.find("supply_pressure_kpa_gauge");
  return part.family != "ejector" || needed == part.numbers.end() ||
         PaFromKpaGauge(needed->second.value, problem.ambient) <=
             problem.compressed_air.pressure_pa * kRounding;
}

bool IsAllowed(const optimizer::Problem& problem, Family family, const catalog::Part& part) {
  return IsAllowed(problem, family, part.id) && SuitsOrder(problem, part) &&
         (!optimizer::Evacuated(problem) || StandsVacuum(part)) && SuitsFeed(problem, part) &&
         HasItsPressure(problem, part) && SuitsVacuumRail(problem, part);
}

void ReadSelection(Reader& request, const std::vector<catalog::Part>& parts,
                   optimizer::Problem& problem) {
  std::map<std::string, std::string> family_of;
  std::vector<std::string> ids;
  for (const catalog::Part& part : parts) {
    family_of[part.id] = part.family;
    ids.push_back(part.id);
  }
  const auto unknown = [&](const std::string& id) {
    const std::string nearest = Nearest(id, ids);
    return "no part " + Quoted(id) + " in the catalogue" +
           (nearest.empty() ? "" : "; nearest id: " + nearest);
  };

  if (auto require = request.OptionalObject("require")) {
    for (const optimizer::FamilySpec& spec : optimizer::Families()) {
      const std::string name = spec.name;
      if (optimizer::CatalogueFamily(spec.family) != spec.family || !require->Has(name)) continue;
      const std::vector<std::string> wanted = require->Texts(name, 1, kExcludedMax);
      for (std::size_t i = 0; i < wanted.size() && !require->Full(); ++i) {
        const std::string& id = wanted[i];
        const std::string place = name + "/" + std::to_string(i);
        if (id.empty() || (spec.made_to_measure && id == kCustomReservoir)) continue;
        const auto found = family_of.find(id);
        if (found == family_of.end())
          require->FailAt(place, unknown(id));
        else if (found->second != name)
          require->FailAt(place, Quoted(id) + " is a " + found->second + ", not a " + name);
      }
      problem.require[spec.family] = {wanted.begin(), wanted.end()};
    }
    require->Finish();
  }

  const auto read = [&](const char* field, bool custom) -> std::set<std::string> {
    if (!request.Has(field)) return {};
    const std::vector<std::string> listed = request.Texts(field, 0, kExcludedMax);
    for (std::size_t i = 0; i < listed.size() && !request.Full(); ++i)
      if (const std::string& id = listed[i];
          !id.empty() && !(custom && id == kCustomReservoir) && !family_of.contains(id))
        request.FailAt(std::string(field) + "/" + std::to_string(i), unknown(id));
    return {listed.begin(), listed.end()};
  };
  problem.exclude = read("exclude", true);
  problem.own = read("own", false);
}

catalog::Part AsCounted(catalog::Part part, const optimizer::Problem& problem) {
  if (problem.own.contains(part.id)) catalog::MakeFree(part);
  return part;
}

std::vector<catalog::Part> AllowedParts(const std::vector<catalog::Part>& parts,
                                        const optimizer::Problem& problem) {
  std::vector<catalog::Part> allowed;
  for (const optimizer::FamilySpec& spec : optimizer::Families())
    for (const catalog::Part& part : parts)
      if (part.family == spec.name && optimizer::CatalogueFamily(spec.family) == spec.family &&
          MayUse(problem, spec) && IsAllowed(problem, spec.family, part))
        allowed.push_back(AsCounted(part, problem));
  return allowed;
}

bool MayUse(const optimizer::Problem& problem, const optimizer::FamilySpec& spec) {
  if (!optimizer::Evacuated(problem))
    return spec.family != Family::kEjector &&
           (spec.family != Family::kVacuumPump || optimizer::PumpsRail(problem));
  return spec.in_line || spec.joins ||
         std::any_of(problem.configurations.begin(), problem.configurations.end(),
                     [&](Configuration one) { return spec.InSourceOf(one); });
}

model::Parts ModelPartsFor(const optimizer::Problem& problem,
                           const std::vector<catalog::Part>& rows) {
  model::Parts parts = optimizer::Evacuated(problem) ? ToVacuumParts(rows, problem.ambient)
                                                     : ToModelParts(rows, problem.ambient);
  optimizer::FollowMission(problem.actuations / problem.frequency_hz, parts);
  optimizer::FitCheckValves(problem, parts);
  return parts;
}

model::Parts AllowedModelParts(const std::vector<catalog::Part>& parts,
                               const optimizer::Problem& problem) {
  model::Parts allowed = ModelPartsFor(problem, AllowedParts(parts, problem));
  ReplaceOutside(problem, allowed);
  return allowed;
}

void CheckFamilies(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                   bool needs_fittings, Errors& errors) {
  std::vector<Family> shared = optimizer::LineFamilies();
  if (!needs_fittings) std::erase(shared, Family::kFitting);
  std::vector<Family> empty;
  for (const Configuration configuration : problem.configurations) {
    bool possible = true;
    std::vector<Family> needed = optimizer::SourceFamilies(problem, configuration);
    needed.insert(needed.begin(), shared.begin(), shared.end());
    for (const Family family : needed) {
      if (optimizer::MayLack(configuration, family) || HasChoice(parts, problem, family)) continue;
      possible = false;
      if (std::find(empty.begin(), empty.end(), family) == empty.end()) empty.push_back(family);
    }
    if (possible) return;
  }
  for (const Family family : empty)
    errors.push_back({PointerFor(parts, problem, family),
                      std::string("no part of the family ") + optimizer::Name(family) +
                          " is left to choose; every allowed configuration lacks a family that "
                          "it needs"});
}

}  // namespace plenum::api
